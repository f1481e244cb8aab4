#include "remesh/dual/thin_patch.h"

#include <algorithm>

#include "remesh/dual/reduce_vertices.h"

namespace remesh {

SimplifiedMesh thin_patch(const Surface& surface, std::span<const Index> faces,
                          std::span<const SurfacePoint> points) {
    SimplifiedMesh patch = simplify(surface, faces, points);
    if (patch.extra.empty()) return patch;
    std::vector<Vec3> positions;
    for (const SurfacePoint& p : points) {
        positions.push_back(position(surface.mesh.view(), p));
    }
    for (const SurfacePoint& p : patch.extra) {
        positions.push_back(position(surface.mesh.view(), p));
    }
    std::vector<std::uint8_t> keep(points.size(), 1);
    keep.resize(positions.size(), 0);
    std::vector<Triangle> triangles = patch.triangles;
    const std::vector<Index> gone =
        reduce_vertices(positions, triangles, static_cast<Index>(points.size()), keep);
    const bool are_extra =
        std::all_of(gone.begin(), gone.end(), [&](Index v) { return v >= points.size(); });
    if (are_extra && gone.size() == patch.extra.size()) {
        patch.triangles = std::move(triangles);
        patch.extra.clear();
    }
    return patch;
}

}  // namespace remesh
