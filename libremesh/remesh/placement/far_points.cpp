// The triangle is cut into convex parts. One is near enough if its middle is, with its radius
// added, or if its corners are near one triangle of the surface: the distance from a convex set is
// largest at a corner. Else the part is cut at the edge of that triangle beyond which its farthest
// corner lies, so that there are about as many parts as triangles that lie below.
#include "remesh/placement/far_points.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "agvd/core/parallel.h"

namespace remesh::detail {
namespace {

constexpr std::size_t query_steps = 64;
constexpr Index face_grain = 256;
// As a share of the radius: a cut that takes no more than that off is none.
constexpr double least_cut = 1e-6;

using Polygon = std::vector<Vec3>;

// A plane by a point and a normal of length 1.
struct CutPlane {
    Vec3 at, normal;
    [[nodiscard]] double side(const Vec3& p) const { return normal.dot(p - at); }
};

// Both parts of a polygon, with corners on both sides.
std::pair<Polygon, Polygon> cut(const Polygon& polygon, const CutPlane& plane) {
    std::pair<Polygon, Polygon> parts;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double from = plane.side(p), to = plane.side(q);
        if (from <= 0) parts.first.push_back(p);
        if (from >= 0) parts.second.push_back(p);
        if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
            const Vec3 between = p + from / (from - to) * (q - p);
            parts.first.push_back(between);
            parts.second.push_back(between);
        }
    }
    return parts;
}

// The plane at right angles to a triangle through the edge beyond which a point lies farthest; the
// one through the middle of the part if that does not divide it.
CutPlane find_plane(const Polygon& part, const Vec3& middle, double radius, const Vec3& farthest,
                    const std::array<Vec3, 3>& triangle) {
    const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    CutPlane best{middle, (farthest - middle).normalized()};
    double most = least_cut * radius;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 outwards = (triangle[(k + 1) % 3] - triangle[k]).cross(normal);
        if (!(outwards.squaredNorm() > 0)) continue;
        const CutPlane plane{triangle[k], outwards.normalized()};
        const double beyond = plane.side(farthest);
        const bool divides = std::ranges::any_of(
            part, [&](const Vec3& p) { return plane.side(p) < -least_cut * radius; });
        if (!(beyond > most) || !divides) continue;
        most = beyond;
        best = plane;
    }
    return best;
}

}  // namespace

std::optional<FarPoint> find_far(const std::array<Vec3, 3>& triangle, const SearchedMesh& other,
                                 double limit, Ticker& ticker) {
    // The corner that is farthest from a triangle, if it is beyond the limit.
    const auto find_farthest = [&](const Polygon& part, FaceId face) {
        const auto corners = corners_of(other.mesh, face.value());
        std::optional<Vec3> farthest;
        double most = limit * limit;
        for (const Vec3& corner : part) {
            const double from_it = closest_point_on_triangle(corners, face, corner).distance_sq;
            if (!(from_it > most)) continue;
            most = from_it;
            farthest = corner;
        }
        return farthest;
    };
    std::vector<Polygon> parts{{triangle.begin(), triangle.end()}};
    while (!parts.empty()) {
        ticker.tick(query_steps);
        const Polygon part = std::move(parts.back());
        parts.pop_back();
        Vec3 middle = Vec3::Zero();
        for (const Vec3& corner : part) middle += corner / static_cast<double>(part.size());
        const ClosestPoint nearest = other.tree.query(middle);
        const double distance = std::sqrt(nearest.distance_sq);
        if (distance > provable_share * limit) return FarPoint{middle, nearest};
        double radius = 0;
        for (const Vec3& corner : part) radius = std::max(radius, (corner - middle).norm());
        if (distance + radius <= limit) continue;
        const FaceId face = nearest.point.face;
        const std::optional<Vec3> farthest = find_farthest(part, face);
        if (!farthest) continue;
        const auto corners = corners_of(other.mesh, face.value());
        auto [inside, beyond] = cut(part, find_plane(part, middle, radius, *farthest, corners));
        if (find_farthest(inside, face)) parts.push_back(std::move(inside));
        parts.push_back(std::move(beyond));
    }
    return std::nullopt;
}

std::vector<std::pair<Index, FarPoint>> find_far_faces(const MeshView& mesh,
                                                       const SearchedMesh& other, double limit,
                                                       int num_threads, Poller& poller) {
    const auto count = static_cast<Index>(mesh.triangles.size());
    using FarFace = std::pair<Index, FarPoint>;
    const auto find = [&](Index f, std::vector<FarFace>& found) {
        Ticker ticker(poller);
        const auto far = find_far(corners_of(mesh, f), other, limit, ticker);
        if (far) found.emplace_back(f, *far);
    };
    return parallel_collect<FarFace>(count, face_grain, num_threads, find, poller);
}

}  // namespace remesh::detail
