// Measures that need CGAL, for a build without it: they return nothing.
#include "remesh/quality/self_intersections.h"
#include "remesh/quality/surface_distance.h"

namespace remesh {

std::optional<SurfaceDistance> surface_distance(const agvd::MeshView&, const agvd::MeshView&,
                                                const DistanceOptions&) {
    return std::nullopt;
}

std::optional<std::vector<std::pair<agvd::Index, agvd::Index>>> find_self_intersections(
    const agvd::MeshView&, int, const agvd::Progress&) {
    return std::nullopt;
}

}  // namespace remesh
