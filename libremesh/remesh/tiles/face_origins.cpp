#include "remesh/tiles/face_origins.h"

#include <algorithm>
#include <numeric>

namespace remesh {
namespace {

// As a share of the polygon: what is left when a triangle is cut off has more area than this.
constexpr double least_rest = 1e-12;

}  // namespace

std::vector<Triangle> triangulate_part(const std::array<Vec3, 3>& corners,
                                       std::span<const PartPoint> polygon) {
    // In the plane of the face.
    const Vec3 x = (corners[1] - corners[0]).normalized();
    const Vec3 up = corners[2] - corners[0];
    const Vec2 apex{x.dot(up), x.cross(up).norm()};
    const double base = (corners[1] - corners[0]).norm();
    std::vector<Vec2> at;
    at.reserve(polygon.size());
    for (const PartPoint& p : polygon) {
        at.push_back(p.weights[1] * Vec2(base, 0) + p.weights[2] * apex);
    }
    const auto doubled_area = [&](Index a, Index b, Index c) {
        return cross(at[b] - at[a], at[c] - at[a]);
    };
    std::vector<Index> left(polygon.size());
    std::iota(left.begin(), left.end(), Index{0});
    double area = 0;
    for (std::size_t i = 2; i < left.size(); ++i) area += doubled_area(0, left[i - 1], left[i]);
    const double least = least_rest * area;
    // The triangle between a corner that is left and those beside it.
    const auto ear_at = [&](std::size_t i) -> Triangle {
        const std::size_t n = left.size();
        return {left[(i + n - 1) % n], left[i], left[(i + 1) % n]};
    };
    std::vector<Triangle> triangles;
    while (left.size() > 3) {
        std::size_t best = 0;
        double most = -1;
        for (std::size_t i = 0; i < left.size(); ++i) {
            const auto [a, b, c] = ear_at(i);
            const double cut = doubled_area(a, b, c);
            if (!(area - cut > least)) continue;
            const double longest =
                std::max({(at[b] - at[a]).squaredNorm(), (at[c] - at[b]).squaredNorm(),
                          (at[a] - at[c]).squaredNorm()});
            const double quality = cut / longest;
            if (quality <= most) continue;
            most = quality;
            best = i;
        }
        const auto [a, b, c] = triangles.emplace_back(ear_at(best));
        area -= doubled_area(a, b, c);
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    }
    triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

}  // namespace remesh
