#include "remesh/quality/area_samples.h"

#include <algorithm>

#include "agvd/core/random.h"
#include "agvd/mesh/uniform_points.h"

namespace remesh::detail {

using agvd::Index;
using agvd::Vec3;

AreaSamples::AreaSamples(const agvd::MeshView& mesh) {
    area_up_to_.reserve(mesh.triangles.size());
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3& p = mesh.positions[a];
        area += (mesh.positions[b] - p).cross(mesh.positions[c] - p).norm() / 2;
        area_up_to_.push_back(area);
    }
}

agvd::SurfacePoint AreaSamples::at(Index i, Index n) const {
    const double area = (i + agvd::random_unit(0, 0, i)) / n * area_up_to_.back();
    const auto face = std::upper_bound(area_up_to_.begin(), area_up_to_.end() - 1, area);
    return {agvd::FaceId(static_cast<Index>(face - area_up_to_.begin())),
            agvd::uniform_barycentric(agvd::random_unit(0, 1, i), agvd::random_unit(0, 2, i))};
}

}  // namespace remesh::detail
