// Sites on a straight curve may be neighbours in pairs: three of them then form a triangle without
// area, the middle one on the edge between the others.
#include "remesh/placement/placement.h"

#include <algorithm>

#include "remesh/dual/fan_mesh.h"

namespace remesh {
namespace {

using detail::FanMesh;

// Height over length: coordinates are rounded by a few times 1e-16 of the mesh, and edges are
// rarely shorter than a hundred-thousandth of it.
constexpr double most_flat = 1e-10;

Index longest_side(const FanMesh& mesh, std::span<const Vec3> positions, Index face) {
    const auto length_sq = [&](Index h) {
        return (positions[mesh.tail(h)] - positions[mesh.head(h)]).squaredNorm();
    };
    Index longest = 3 * face;
    for (const Index h : {3 * face + 1, 3 * face + 2}) {
        if (length_sq(h) > length_sq(longest)) longest = h;
    }
    return longest;
}

// Flips the edge unless one of the two triangles that it leaves is flat.
bool try_flip(FanMesh& mesh, std::span<const Vec3> positions, Index h) {
    if (mesh.is_hard(h) || !mesh.can_flip(h)) return false;
    const Index a = mesh.tail(h), b = mesh.head(h), c = mesh.apex(h), d = mesh.apex(mesh.twin(h));
    if (is_flat(positions, {c, a, d}) || is_flat(positions, {d, b, c})) return false;
    mesh.flip(h);
    return true;
}

}  // namespace

bool is_flat(std::span<const Vec3> positions, const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    const Vec3 ab = positions[b] - positions[a], ac = positions[c] - positions[a];
    const double longest_sq =
        std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    return !(ab.cross(ac).norm() > most_flat * longest_sq);
}

void flip_flat_faces(std::span<const Vec3> positions, PlacedMesh& placed) {
    std::vector<Index> flat;
    for (Index f = 0; f < placed.triangles.size(); ++f) {
        if (is_flat(positions, placed.triangles[f])) flat.push_back(f);
    }
    if (flat.empty()) return;
    FanMesh mesh(placed.triangles, static_cast<Index>(positions.size()));
    mesh.label_edges(placed.hard, [](Index, Index) { return Index{0}; });
    // A flip frees the next of several flat triangles in a row.
    for (bool is_changed = true; is_changed;) {
        is_changed = false;
        std::erase_if(flat, [&](Index f) {
            const bool is_done = try_flip(mesh, positions, longest_side(mesh, positions, f));
            is_changed |= is_done;
            return is_done;
        });
    }
    placed.triangles = mesh.triangles();
}

}  // namespace remesh
