#include "sites.h"

#include "agvd/core/error.h"
#include "agvd/mesh/closest_point.h"

namespace npm {
namespace {

using agvd::FaceId;
using agvd::Index;
using agvd::InvalidSites;
using agvd::SurfacePoint;

// The lowest face of each vertex, and its corner there.
std::vector<SurfacePoint> at_vertices(std::span<const Index> vertices, const agvd::MeshView& mesh) {
    constexpr std::size_t none = ~std::size_t{0};
    std::vector<std::size_t> corner_of(mesh.positions.size(), none);
    for (std::size_t c = 3 * mesh.triangles.size(); c-- > 0;) {
        const Index vertex = mesh.triangles[c / 3][c % 3];
        if (vertex < corner_of.size()) corner_of[vertex] = c;
    }
    std::vector<SurfacePoint> points;
    for (const Index vertex : vertices) {
        if (vertex >= corner_of.size()) {
            throw InvalidSites("site " + std::to_string(points.size()) + " names vertex " +
                               std::to_string(vertex) + ", but the mesh has only " +
                               std::to_string(corner_of.size()) +
                               " vertices, counted from 0; correct or delete the site");
        }
        const std::size_t corner = corner_of[vertex];
        if (corner == none) {
            throw InvalidSites("vertex " + std::to_string(vertex) +
                               " is in no face; use a vertex of a face");
        }
        SurfacePoint point{FaceId(static_cast<Index>(corner / 3)), {0, 0, 0}};
        point.barycentric[corner % 3] = 1;
        points.push_back(point);
    }
    return points;
}

std::vector<SurfacePoint> nearest(std::span<const double> coordinates, const agvd::MeshView& mesh,
                                  Run& run) {
    const agvd::ClosestPointTree tree(mesh, run.of("sample"));
    std::vector<SurfacePoint> points;
    for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
        const agvd::Vec3 place(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
        if (!place.allFinite()) {
            throw InvalidSites("site " + std::to_string(points.size()) +
                               " has a coordinate that is not finite; correct or delete the site");
        }
        points.push_back(tree.query(place).point);
    }
    return points;
}

}  // namespace

std::vector<SurfacePoint> sites_of(const Request& request, const std::string& name,
                                   const agvd::MeshView& mesh, Run& run) {
    if (request.has_array((name + ".points").c_str())) {
        return nearest(request.array<double>(name + ".points"), mesh, run);
    }
    if (!request.has_array((name + ".faces").c_str())) {
        return at_vertices(request.array<Index>(name), mesh);
    }
    const auto faces = request.array<Index>(name + ".faces");
    const auto places = request.array<double>(name + ".barycentric");
    std::vector<SurfacePoint> points;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        points.push_back({FaceId(faces[i]), {places[3 * i], places[3 * i + 1], places[3 * i + 2]}});
    }
    return points;
}

}  // namespace npm
