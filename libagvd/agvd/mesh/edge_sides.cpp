#include "agvd/mesh/edge_sides.h"

#include <algorithm>

#include "agvd/core/bucket_sort.h"
#include "agvd/core/edge_key.h"

namespace agvd {

std::vector<EdgeSide> sort_edge_sides(const std::vector<EdgeSide>& sides, Index num_vertices,
                                      Ticker ticker) {
    return sort_in_buckets(
        sides, num_vertices, [](const EdgeSide& side) { return side.low(); },
        [](const EdgeSide& a, const EdgeSide& b) {
            return a.ends != b.ends ? a.ends < b.ends : a.half_edge < b.half_edge;
        },
        ticker);
}

std::vector<EdgeSide> sorted_edge_sides(std::span<const Triangle> triangles, Ticker ticker) {
    std::vector<EdgeSide> sides;
    sides.reserve(3 * triangles.size());
    Index num_vertices = 0;
    for (Index f = 0; f < triangles.size(); ++f) {
        ticker.tick();
        for (Index k = 0; k < 3; ++k) {
            const Index a = triangles[f][k];
            const Index b = triangles[f][(k + 1) % 3];
            num_vertices = std::max(num_vertices, a + 1);
            sides.push_back({edge_key(a, b), 3 * f + k, a < b});
        }
    }
    return sort_edge_sides(sides, num_vertices, ticker);
}

}  // namespace agvd
