#include "remesh/curves/prune_seams.h"

#include <array>

#include "agvd/core/union_find.h"
#include "agvd/mesh/surface.h"

namespace remesh {
namespace {

// In spacings. Narrower patches have few vertices that are not on their border: at 1.5, spot's
// remesh with 500 vertices is 4 % of the diagonal off its surface, at 2.5 as far as without seams,
// 1 %.
constexpr double least_width = 2.5;
// Specks go first, so that their borders do not make the charts around them narrow.
constexpr std::array width_shares = {0.125, 0.25, 0.5, 1.0};
constexpr double least_seam_spur = 2;  // In spacings, as for junctions.

double area_of(const Surface& surface, Index face) {
    const auto& [a, b, c] = surface.mesh.triangles[face];
    const auto& p = surface.mesh.positions;
    return (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
}

void drop_narrow_charts(const Surface& surface, double width, std::vector<std::uint8_t>& is_seam,
                        Ticker& ticker) {
    UnionFind charts(surface.num_faces());
    for (Index e = 0; e < surface.num_edges(); ++e) {
        ticker.tick();
        const Index h = surface.edge_half[e], twin = surface.twin[h];
        if (is_seam[e] == 0 && twin != no_index) {
            charts.unite(Surface::face(h), Surface::face(twin));
        }
    }
    std::vector<double> area(surface.num_faces(), 0), length(surface.num_faces(), 0);  // At roots.
    for (Index f = 0; f < surface.num_faces(); ++f) {
        ticker.tick();
        const Index chart = charts.root(f);
        area[chart] += area_of(surface, f);
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            if (is_seam[surface.edge[h]] != 0) length[chart] += surface.length[surface.edge[h]];
        }
    }
    const auto is_narrow = [&](Index half_edge) {
        const Index chart = charts.root(Surface::face(half_edge));
        return 2 * area[chart] < width * length[chart];
    };
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        if (is_seam[e] != 0 && (is_narrow(h) || is_narrow(surface.twin[h]))) is_seam[e] = 0;
    }
}

// Removes chains with a free end, one after the other.
class SpurPruner {
public:
    SpurPruner(const Surface& surface, std::span<const std::uint8_t> is_crease,
               std::vector<std::uint8_t>& is_seam)
        : surface_(surface),
          is_seam_(is_seam),
          degree_(surface.num_vertices(), 0),
          is_anchor_(surface.num_vertices(), 0) {
        for (Index e = 0; e < surface.num_edges(); ++e) {
            const Index h = surface.edge_half[e];
            const bool anchors =
                surface.twin[h] == no_index || (!is_crease.empty() && is_crease[e] != 0);
            for (const Index v : {surface.tail(h), surface.head(h)}) {
                if (anchors) is_anchor_[v] = 1;
                if (is_seam[e] != 0) ++degree_[v];
            }
        }
    }

    void run(double least_length, Ticker& ticker) {
        std::vector<Index> ends;
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            if (is_free(v)) ends.push_back(v);
        }
        while (!ends.empty()) {
            const Index end = ends.back();
            ends.pop_back();
            if (!is_free(end)) continue;
            double length = 0;
            std::vector<Index> chain;
            const Index last = follow(end, chain, length);
            ticker.tick(chain.size() + 1);
            if (!(length < least_length)) continue;
            for (const Index e : chain) is_seam_[e] = 0;
            degree_[end] = 0;
            --degree_[last];
            if (is_free(last)) ends.push_back(last);
        }
    }

private:
    [[nodiscard]] bool is_free(Index v) const { return degree_[v] == 1 && is_anchor_[v] == 0; }

    // The chain from a vertex up to one where not exactly two edges meet. \return that vertex.
    Index follow(Index from, std::vector<Index>& chain, double& length) const {
        Index at = from, last = no_index;
        do {
            Index edge = no_index;
            for_each_outgoing(surface_, at, [&](Index h) {
                for (const Index side : {h, Surface::previous(h)}) {
                    const Index e = surface_.edge[side];
                    if (is_seam_[e] != 0 && e != last) edge = e;
                }
            });
            if (edge == no_index) break;
            const Index h = surface_.edge_half[edge];
            at = surface_.tail(h) == at ? surface_.head(h) : surface_.tail(h);
            chain.push_back(edge);
            length += surface_.length[edge];
            last = edge;
        } while (degree_[at] == 2 && is_anchor_[at] == 0);
        return at;
    }

    const Surface& surface_;
    std::vector<std::uint8_t>& is_seam_;
    std::vector<Index> degree_;            // #V: seams.
    std::vector<std::uint8_t> is_anchor_;  // #V
};

}  // namespace

void prune_seams(const Surface& surface, std::span<const std::uint8_t> is_crease, double spacing,
                 std::vector<std::uint8_t>& is_seam, Ticker ticker) {
    for (const double share : width_shares) {
        drop_narrow_charts(surface, share * least_width * spacing, is_seam, ticker);
    }
    SpurPruner(surface, is_crease, is_seam).run(least_seam_spur * spacing, ticker);
}

}  // namespace remesh
