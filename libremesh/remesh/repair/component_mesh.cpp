#include "remesh/repair/component_mesh.h"

#include <algorithm>
#include <array>

#include "agvd/core/poller.h"
#include "agvd/mesh/refine.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;

// Each round halves the edges that are longer than this share of the longest.
constexpr double shrinking = 0.7;
// Barycentric coordinates of edge points in their face, up to rounding.
constexpr double on_edge = 1e-9;

SurfacePoint point_in_face(const Surface& surface, Index face, const Vec3& position) {
    const agvd::Triangle& t = surface.mesh.triangles[face];
    const auto& p = surface.mesh.positions;
    const Vec3 normal = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
    SurfacePoint point{agvd::FaceId(face), {0, 0, 0}};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& a = p[t[(k + 1) % 3]];
        const Vec3& b = p[t[(k + 2) % 3]];
        const double share = (a - position).cross(b - position).dot(normal) / normal.squaredNorm();
        point.barycentric[k] = share > on_edge ? share : 0;
        sum += point.barycentric[k];
    }
    for (double& b : point.barycentric) b /= sum;
    return point;
}

}  // namespace

SurfaceMesh component_mesh(const Surface& surface, const std::vector<Index>& faces,
                           Index least_vertices, const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    agvd::Ticker ticker(poller);
    agvd::TriangleMesh mesh;
    std::vector<Index> number(surface.num_vertices(), no_index);
    double longest = 0;
    for (const Index f : faces) {
        ticker.tick();
        agvd::Triangle t = surface.mesh.triangles[f];
        for (Index& v : t) {
            if (number[v] == no_index) {
                number[v] = static_cast<Index>(mesh.positions.size());
                mesh.positions.push_back(surface.mesh.positions[v]);
            }
            v = number[v];
        }
        mesh.triangles.push_back(t);
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            longest = std::max(longest, surface.length_of(h));
        }
    }
    std::vector<Index> origin = faces;
    while (mesh.positions.size() < least_vertices) {
        longest *= shrinking;
        agvd::RefinedMesh refined = agvd::split_long_edges(mesh.view(), longest, progress);
        mesh = std::move(refined.mesh);
        for (Index& f : refined.face_origin) f = origin[f];
        origin = std::move(refined.face_origin);
    }

    SurfaceMesh result{std::vector<SurfacePoint>(mesh.positions.size()), std::move(mesh.triangles)};
    for (Index f = 0; f < result.triangles.size(); ++f) {
        ticker.tick();
        for (const Index v : result.triangles[f]) {
            result.points[v] = point_in_face(surface, origin[f], mesh.positions[v]);
        }
    }
    return result;
}

}  // namespace remesh
