// What needs CGAL, for a build without it: these functions return nothing.
#include "remesh/clean/hole_triangles.h"
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

std::optional<std::vector<agvd::Triangle>> detail::triangulate_hole(std::span<const agvd::Vec3>,
                                                                    std::span<const agvd::Vec3>) {
    return std::nullopt;
}

}  // namespace remesh
