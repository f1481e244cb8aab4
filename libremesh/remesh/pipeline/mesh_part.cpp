#include "remesh/pipeline/mesh_part.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "agvd/core/groups.h"
#include "agvd/mesh/closest_point.h"

namespace remesh::detail {

std::vector<Index> rings_around(std::span<const Triangle> triangles, std::size_t num_vertices,
                                std::span<const Index> vertices, Index most,
                                std::span<const std::uint8_t> is_left_out) {
    const Groups around = triangles_by_vertex(triangles, num_vertices);
    std::vector<Index> ring(num_vertices, no_index), now(vertices.begin(), vertices.end());
    for (const Index v : now) ring[v] = 0;
    for (Index r = 1; r <= most; ++r) {
        std::vector<Index> next;
        for (const Index v : now) {
            for (const Index t : around.of(v)) {
                if (!is_left_out.empty() && is_left_out[t] != 0) continue;
                for (const Index w : triangles[t]) {
                    if (ring[w] != no_index) continue;
                    ring[w] = r;
                    next.push_back(w);
                }
            }
        }
        now = std::move(next);
    }
    return ring;
}

std::vector<Index> faces_around(const Surface& surface, std::span<const SurfacePoint> points,
                                double radius) {
    const MeshView mesh = surface.mesh.view();
    std::vector<std::pair<Index, Vec3>> open;  // Face, where the way began.
    std::unordered_set<Index> seen;
    for (const SurfacePoint& point : points) {
        const Index f = point.face.value();
        if (seen.insert(f).second) open.emplace_back(f, position(mesh, point));
    }
    for (std::size_t i = 0; i < open.size(); ++i) {
        const Index face = open[i].first;
        const Vec3 start = open[i].second;
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (surface.twin[h] == no_index) continue;
            const Index next = Surface::face(surface.twin[h]);
            if (seen.contains(next)) continue;
            const ClosestPoint nearest =
                closest_point_on_triangle(corners_of(mesh, next), FaceId(next), start);
            if (nearest.distance_sq > radius * radius) continue;
            seen.insert(next);
            open.emplace_back(next, start);
        }
    }
    std::vector<Index> faces(seen.begin(), seen.end());
    std::sort(faces.begin(), faces.end());
    return faces;
}

}  // namespace remesh::detail
