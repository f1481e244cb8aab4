// Removes the vertices that thinning leaves besides the sites.
#include <algorithm>
#include <array>
#include <optional>

#include "remesh/curves/glue.h"
#include "remesh/dual/reduce_vertices.h"

namespace remesh {
namespace {

// Of the points and the extra vertices.
std::vector<Vec3> positions_of(const Surface& surface, std::span<const SurfacePoint> points,
                               const SimplifiedMesh& patch) {
    std::vector<Vec3> positions;
    for (const auto some : {points, std::span<const SurfacePoint>(patch.extra)}) {
        for (const SurfacePoint& p : some) positions.push_back(position(surface.mesh.view(), p));
    }
    return positions;
}

// The corner of a triangle that has the directed edge (a, b).
struct Wing {
    Index triangle, apex;
};

std::optional<Wing> find_wing(const std::vector<Triangle>& triangles, Index a, Index b) {
    for (Index i = 0; i < triangles.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Triangle& t = triangles[i];
            if (t[k] == a && t[(k + 1) % 3] == b) return Wing{i, t[(k + 2) % 3]};
        }
    }
    return std::nullopt;
}

// Flips the inner edge between a and b if there is one and its apexes are not joined.
void flip_between(Index a, Index b, std::vector<Triangle>& triangles) {
    const auto left = find_wing(triangles, a, b), right = find_wing(triangles, b, a);
    if (!left || !right || left->apex == right->apex) return;
    if (find_wing(triangles, left->apex, right->apex)) return;
    if (find_wing(triangles, right->apex, left->apex)) return;
    triangles[left->triangle] = {left->apex, right->apex, b};
    triangles[right->triangle] = {right->apex, left->apex, a};
}

// Removes one vertex of the boundary, if that is possible.
bool remove_vertex(Index v, const DirectedEdge& neighbours, const std::vector<Vec3>& positions,
                   Index num_vertices, std::vector<Triangle>& triangles) {
    std::vector<Triangle> fewer = triangles;
    flip_between(neighbours.first, neighbours.second, fewer);
    std::vector<std::uint8_t> keep(positions.size(), 1);
    keep[v] = 0;
    const std::vector<Index> gone = reduce_vertices(positions, fewer, num_vertices - 1, keep);
    if (gone.size() != 1 || gone.front() != v) return false;
    triangles = std::move(fewer);
    return true;
}

}  // namespace

void free_rim(const Surface& surface, std::span<const SurfacePoint> points, SimplifiedMesh& patch) {
    if (patch.extra.empty()) return;
    const std::vector<Vec3> positions = positions_of(surface, points, patch);
    std::vector<bool> is_gone(patch.extra.size(), false);
    auto num_vertices = static_cast<Index>(positions.size());
    for (Index i = 0; i < is_gone.size(); ++i) {
        const auto v = static_cast<Index>(points.size()) + i;
        std::array<Index, 2> neighbours{no_index, no_index};
        for (const auto& [from, to] : rim_of(patch.triangles)) {
            if (to == v) neighbours[0] = from;
            if (from == v) neighbours[1] = to;
        }
        if (neighbours[0] == no_index) continue;
        is_gone[i] = remove_vertex(v, {neighbours[0], neighbours[1]}, positions, num_vertices,
                                   patch.triangles);
        if (is_gone[i]) --num_vertices;
    }
    std::vector<Index> number(points.size());
    for (Index v = 0; v < number.size(); ++v) number[v] = v;
    std::vector<SurfacePoint> left;
    for (Index i = 0; i < is_gone.size(); ++i) {
        number.push_back(static_cast<Index>(points.size() + left.size()));
        if (!is_gone[i]) left.push_back(patch.extra[i]);
    }
    patch.extra = std::move(left);
    for (Triangle& t : patch.triangles) {
        for (Index& v : t) v = number[v];
    }
}

SimplifiedMesh thin_patch(const Surface& surface, std::span<const Index> faces,
                          std::span<const SurfacePoint> points) {
    SimplifiedMesh patch = simplify(surface, faces, points);
    if (patch.extra.empty()) return patch;
    const std::vector<Vec3> positions = positions_of(surface, points, patch);
    std::vector<std::uint8_t> keep(points.size(), 1);
    keep.resize(positions.size(), 0);
    std::vector<Triangle> triangles = patch.triangles;
    const std::vector<Index> gone =
        reduce_vertices(positions, triangles, static_cast<Index>(points.size()), keep);
    const bool are_extra =
        std::all_of(gone.begin(), gone.end(), [&](Index v) { return v >= points.size(); });
    if (are_extra && gone.size() == patch.extra.size()) {
        patch.triangles = std::move(triangles);
        patch.extra.clear();
    }
    return patch;
}

}  // namespace remesh
