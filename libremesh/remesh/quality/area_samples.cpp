#include "remesh/quality/area_samples.h"

#include <algorithm>

#include "agvd/core/random.h"
#include "agvd/mesh/surface_points.h"

namespace remesh::detail {

AreaSamples::AreaSamples(const MeshView& mesh) {
    area_up_to_.reserve(mesh.triangles.size());
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3& p = mesh.positions[a];
        area += (mesh.positions[b] - p).cross(mesh.positions[c] - p).norm() / 2;
        area_up_to_.push_back(area);
    }
}

SurfacePoint AreaSamples::at(Index i, Index n) const {
    const double area = (i + random_unit(0, 0, i)) / n * area_up_to_.back();
    const auto face = std::upper_bound(area_up_to_.begin(), area_up_to_.end() - 1, area);
    return {FaceId(static_cast<Index>(face - area_up_to_.begin())),
            uniform_barycentric(random_unit(0, 1, i), random_unit(0, 2, i))};
}

}  // namespace remesh::detail
