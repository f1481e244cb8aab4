#include "support/crease_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "agvd/mesh/closest_point.h"

namespace crease_checks {
namespace {

using agvd::Index;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec3;

constexpr int points_per_edge = 8;

Vec3 normal_of(const TriangleMesh& mesh, Index face) {
    const auto& [a, b, c] = mesh.triangles[face];
    const auto& p = mesh.positions;
    return (p[b] - p[a]).cross(p[c] - p[a]);
}

double distance(const Vec3& point, const Segment& segment) {
    const Vec3 along = segment.second - segment.first;
    const double t = std::clamp((point - segment.first).dot(along) / along.squaredNorm(), 0., 1.);
    return (segment.first + t * along - point).norm();
}

}  // namespace

std::vector<Segment> creases(const TriangleMesh& mesh, double degrees) {
    std::map<std::pair<Index, Index>, Index> face_at;  // By edge: the first of its faces.
    std::vector<Segment> result;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const Index a = mesh.triangles[f][k], b = mesh.triangles[f][(k + 1) % 3];
            const auto [it, is_new] = face_at.try_emplace(std::minmax({a, b}), f);
            if (is_new) continue;
            const Vec3 m = normal_of(mesh, it->second), n = normal_of(mesh, f);
            if (std::atan2(m.cross(n).norm(), m.dot(n)) * 180 / std::numbers::pi > degrees) {
                result.emplace_back(mesh.positions[a], mesh.positions[b]);
            }
        }
    }
    return result;
}

std::vector<Vec3> junctions(const TriangleMesh& mesh, double degrees) {
    std::map<std::array<double, 3>, int> num_creases;
    for (const auto& [a, b] : creases(mesh, degrees)) {
        for (const Vec3& end : {a, b}) ++num_creases[{end.x(), end.y(), end.z()}];
    }
    std::vector<Vec3> result;
    for (const auto& [at, count] : num_creases) {
        if (count >= 3) result.emplace_back(at[0], at[1], at[2]);
    }
    return result;
}

double coverage(const TriangleMesh& input, const TriangleMesh& output, double tolerance) {
    const std::vector<Segment> wanted = creases(input, 40), found = creases(output, 25);
    double length = 0, covered = 0;
    for (const auto& [a, b] : wanted) {
        const double part = (b - a).norm() / points_per_edge;
        for (int i = 0; i < points_per_edge; ++i) {
            const Vec3 point = a + (i + 0.5) / points_per_edge * (b - a);
            length += part;
            const bool is_covered = std::any_of(found.begin(), found.end(), [&](const Segment& s) {
                return distance(point, s) <= tolerance;
            });
            if (is_covered) covered += part;
        }
    }
    return length > 0 ? covered / length : 1;
}

double farthest_from_vertices(std::span<const Vec3> points, const TriangleMesh& mesh) {
    double farthest = 0;
    for (const Vec3& point : points) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vec3& v : mesh.positions) nearest = std::min(nearest, (v - point).norm());
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

double farthest_from_surface(const TriangleMesh& mesh, const TriangleMesh& surface) {
    const agvd::ClosestPointTree tree(surface.view());
    constexpr int n = 6;
    double farthest_sq = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto& p = mesh.positions;
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; i + j <= n; ++j) {
                const Vec3 point = (i * p[a] + j * p[b] + (n - i - j) * p[c]) / n;
                farthest_sq = std::max(farthest_sq, tree.query(point).distance_sq);
            }
        }
    }
    return std::sqrt(farthest_sq);
}

}  // namespace crease_checks
