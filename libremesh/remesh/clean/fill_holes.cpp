// Closes boundary loops of few edges.
#include <algorithm>
#include <unordered_set>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/types.h"
#include "remesh/clean/soup.h"

namespace remesh::detail {
namespace {

class HoleFiller {
public:
    HoleFiller(Soup& soup, std::span<const EdgeSide> sides)
        : soup_(soup), next_(soup.mesh.positions.size(), no_index) {
        for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
            soup.ticker.tick();
            edges_.push_back(edge[0].ends);
            if (edge.size() == 1) next_[soup.head(edge[0].half_edge)] = edge[0].half_edge;
        });
        std::sort(edges_.begin(), edges_.end());
    }

    void fill(Index most_edges) {
        for (Index start = 0; start < next_.size(); ++start) {
            soup_.ticker.tick();
            std::vector<Index> loop;
            for (Index v = start; next_[v] != no_index; v = soup_.tail(loop.back())) {
                loop.push_back(std::exchange(next_[v], no_index));
            }
            if (loop.size() >= 3 && loop.size() <= most_edges) fill_loop(loop);
        }
    }

private:
    // \param loop  half-edges, each of which ends where the one before begins.
    void fill_loop(const std::vector<Index>& loop) {
        soup_.ticker.poll();
        std::vector<Vec3> rim, beyond;
        for (const Index h : loop) {
            rim.push_back(soup_.mesh.positions[soup_.head(h)]);
            beyond.push_back(soup_.mesh.positions[soup_.apex(h)]);
        }
        const auto triangles = triangulate_hole(rim, beyond);
        if (!triangles) {
            throw InvalidOption(
                "holes are filled by CGAL, and this build is without it; fill no holes, or build "
                "with "
                "AGVD_WITH_CGAL=ON");
        }
        std::vector<Triangle> faces;
        std::vector<Index> origins;
        std::vector<std::uint64_t> chords;
        for (const Triangle& t : *triangles) {
            faces.push_back(
                {soup_.head(loop[t[0]]), soup_.head(loop[t[1]]), soup_.head(loop[t[2]])});
            origins.push_back(soup_.face_origin[loop[t[0]] / 3]);
            for (std::size_t k = 0; k < 3; ++k) {
                const Index i = t[k], j = t[(k + 1) % 3];
                const bool is_on_rim = (i + 1) % loop.size() == j || (j + 1) % loop.size() == i;
                if (!is_on_rim)
                    chords.push_back(edge_key(faces.back()[k], faces.back()[(k + 1) % 3]));
            }
        }
        if (!fits(faces, chords, loop)) return;
        soup_.mesh.triangles.insert(soup_.mesh.triangles.end(), faces.begin(), faces.end());
        soup_.face_origin.insert(soup_.face_origin.end(), origins.begin(), origins.end());
        ++soup_.counts.filled_holes;
    }

    // Whether the faces close the loop, have an area, and join no vertices that are joined already.
    bool fits(const std::vector<Triangle>& faces, std::vector<std::uint64_t>& chords,
              const std::vector<Index>& loop) {
        if (faces.size() + 2 != loop.size()) return false;
        for (const Triangle& t : faces) {
            if (!(smallest_doubled_area(soup_.mesh.positions, t) > 0)) return false;
        }
        if (loop.size() == 3 && loop[0] / 3 == loop[1] / 3) return false;  // A triangle alone.
        chords = distinct(std::move(chords));
        const auto has = [](const std::vector<std::uint64_t>& edges, std::uint64_t edge) {
            return std::binary_search(edges.begin(), edges.end(), edge);
        };
        for (const std::uint64_t chord : chords) {
            if (has(edges_, chord) || added_.contains(chord)) return false;
        }
        added_.insert(chords.begin(), chords.end());
        return true;
    }

    Soup& soup_;
    std::vector<Index> next_;           // By its head: the half-edge of the boundary.
    std::vector<std::uint64_t> edges_;  // Ascending.
    std::unordered_set<std::uint64_t> added_;
};

}  // namespace

void fill_holes(Soup& soup, Index most_edges) {
    HoleFiller(soup, sorted_edge_sides(soup.mesh.triangles, soup.ticker)).fill(most_edges);
}

}  // namespace remesh::detail
