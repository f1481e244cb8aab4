#include "remesh/curves/crease_chains.h"

#include <array>

#include "agvd/core/union_find.h"
#include "agvd/mesh/surface.h"

namespace remesh {
namespace {

// In spacings. Narrower patches have few vertices that are not on their border, and the result lies
// far from the surface there.
constexpr double least_width = 2.5;
// Specks go first, so that their borders do not make the charts around them narrow.
constexpr std::array width_shares = {0.125, 0.25, 0.5, 1.0};
constexpr double least_seam_spur = 2;  // In spacings, as for junctions.

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
    const auto& p = surface.mesh.positions;
    std::vector<double> area(surface.num_faces(), 0), length(surface.num_faces(), 0);  // At roots.
    for (Index f = 0; f < surface.num_faces(); ++f) {
        ticker.tick();
        const Index chart = charts.root(f);
        const auto& [a, b, c] = surface.mesh.triangles[f];
        area[chart] += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
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

// Removes short chains with a free end, one after the other.
void drop_spurs(const Surface& surface, std::span<const std::uint8_t> is_crease,
                double least_length, std::vector<std::uint8_t>& is_seam, Ticker& ticker) {
    detail::CreaseSet seams(surface);
    std::vector<bool> is_anchor(surface.num_vertices(), false);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        if (is_seam[e] != 0) seams.add(e);
        if (surface.twin[h] != no_index && (is_crease.empty() || is_crease[e] == 0)) continue;
        is_anchor[surface.tail(h)] = is_anchor[surface.head(h)] = true;
    }
    const auto is_free = [&](Index v) { return seams.degree(v) == 1 && !is_anchor[v]; };
    std::vector<Index> ends;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (is_free(v)) ends.push_back(v);
    }
    while (!ends.empty()) {
        Index at = ends.back();
        ends.pop_back();
        if (!is_free(at)) continue;
        double length = 0;
        std::vector<Index> chain;
        do {
            Index edge = no_index;
            for_each_edge_at(surface, at, [&](Index h, Index) {
                const Index e = surface.edge[h];
                if (seams.has(e) && (chain.empty() || e != chain.back())) edge = e;
            });
            if (edge == no_index) break;
            at = other_end(surface, edge, at);
            chain.push_back(edge);
            length += surface.length[edge];
        } while (seams.degree(at) == 2 && !is_anchor[at]);
        ticker.tick(chain.size() + 1);
        if (!(length < least_length)) continue;
        for (const Index e : chain) seams.remove(e);
        if (is_free(at)) ends.push_back(at);
    }
    is_seam = seams.take_flags();
}

}  // namespace

void prune_seams(const Surface& surface, std::span<const std::uint8_t> is_crease, double spacing,
                 std::vector<std::uint8_t>& is_seam, Ticker ticker) {
    for (const double share : width_shares) {
        drop_narrow_charts(surface, share * least_width * spacing, is_seam, ticker);
    }
    drop_spurs(surface, is_crease, least_seam_spur * spacing, is_seam, ticker);
}

}  // namespace remesh
