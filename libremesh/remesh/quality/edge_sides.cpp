#include "remesh/quality/edge_sides.h"

#include <algorithm>

#include "agvd/core/bucket_sort.h"

namespace remesh {

using agvd::Index;

std::vector<EdgeSide> sorted_edge_sides(const agvd::MeshView& mesh) {
    std::vector<EdgeSide> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        for (Index k = 0; k < 3; ++k) {
            const Index a = mesh.triangles[f][k];
            const Index b = mesh.triangles[f][(k + 1) % 3];
            sides.push_back(
                {std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), 3 * f + k, a < b});
        }
    }
    return agvd::sort_in_buckets(
        sides, static_cast<Index>(mesh.positions.size()),
        [](const EdgeSide& side) { return side.low(); },
        [](const EdgeSide& a, const EdgeSide& b) {
            return a.ends != b.ends ? a.ends < b.ends : a.half_edge < b.half_edge;
        });
}

}  // namespace remesh
