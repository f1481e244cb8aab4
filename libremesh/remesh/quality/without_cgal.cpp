// What needs CGAL, for a build without it: these functions return nothing.
#include "remesh/clean/soup.h"
#include "remesh/quality/evaluate.h"

namespace remesh {

std::optional<SurfaceDistance> surface_distance(const MeshView&, const MeshView&,
                                                const EvaluationOptions&) {
    return std::nullopt;
}

std::optional<std::vector<std::pair<Index, Index>>> find_self_intersections(const MeshView&, int,
                                                                            const Progress&) {
    return std::nullopt;
}

std::optional<std::vector<Triangle>> detail::triangulate_hole(std::span<const Vec3>,
                                                              std::span<const Vec3>) {
    return std::nullopt;
}

}  // namespace remesh
