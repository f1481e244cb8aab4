#include "remesh/pipeline/crossing_places.h"

#include <algorithm>
#include <cmath>

namespace remesh::detail {
namespace {

using Corners = std::array<Vec3, 3>;

Corners corners_of(const MeshView& mesh, Index face) {
    const Triangle& t = mesh.triangles[face];
    return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

Vec3 normal_of(const Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

double longest_edge(const Corners& t) {
    return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
}

// The part of a triangle in the plane of another; empty if there is none or if it is all of it.
std::vector<Vec3> segment_in_plane(const Corners& t, const Corners& plane) {
    const Vec3 normal = normal_of(plane);
    std::array<double, 3> height{};
    for (std::size_t i = 0; i < 3; ++i) height[i] = normal.dot(t[i] - plane[0]);
    std::vector<Vec3> ends;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if (height[i] == 0) ends.push_back(t[i]);
        if ((height[i] < 0 && height[j] > 0) || (height[i] > 0 && height[j] < 0)) {
            ends.emplace_back(t[i] + height[i] / (height[i] - height[j]) * (t[j] - t[i]));
        }
    }
    if (ends.size() == 1) ends.push_back(ends[0]);
    if (ends.size() != 2) ends.clear();
    return ends;
}

TriangleMesh mesh_of_places(const MeshView& mesh, const FacePairs& pairs) {
    TriangleMesh places;
    for (const auto& [f, g] : pairs) {
        const auto first = static_cast<Index>(places.positions.size());
        for (const Vec3& p : crossing_place(corners_of(mesh, f), corners_of(mesh, g))) {
            places.positions.push_back(p);
        }
        places.triangles.push_back({first, first + 1, first + 2});
    }
    return places;
}

}  // namespace

Corners crossing_place(const Corners& a, const Corners& b) {
    std::vector<Vec3> of_a = segment_in_plane(a, b), of_b = segment_in_plane(b, a);
    if (of_a.empty()) std::swap(of_a, of_b);
    // In one plane, or apart by rounding.
    if (of_a.empty()) return normal_of(a).norm() < normal_of(b).norm() ? a : b;
    const bool is_b_shorter =
        !of_b.empty() && (of_b[1] - of_b[0]).norm() < (of_a[1] - of_a[0]).norm();
    const std::vector<Vec3>& ends = is_b_shorter ? of_b : of_a;
    return {ends[0], ends[1], ends[1]};
}

CrossingPlaces::CrossingPlaces(const MeshView& mesh, const FacePairs& pairs,
                               const Progress& progress)
    : places_(mesh_of_places(mesh, pairs).view(), progress) {}

FacePairs CrossingPlaces::pairs_elsewhere(const MeshView& mesh, const FacePairs& pairs) const {
    FacePairs elsewhere;
    for (const auto& [f, g] : pairs) {
        const Corners a = corners_of(mesh, f), b = corners_of(mesh, g);
        const Corners place = crossing_place(a, b);
        const double reach = std::max(longest_edge(a), longest_edge(b));
        const Vec3 middle = (place[0] + place[1]) / 2;
        if (!places_.is_within(middle, reach)) elsewhere.emplace_back(f, g);
    }
    return elsewhere;
}

}  // namespace remesh::detail
