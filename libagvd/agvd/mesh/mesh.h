//! \file
//! A triangle mesh as plain arrays, as a view and as an owner, and points on it: nothing is checked
//! or copied unasked. Held by TriangleMesh.ConvertsToAViewByItself in tests/agvd/mesh.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/types.h"

namespace agvd {

//! #V x 3 positions and #F x 3 vertex indices, not owned.
struct MeshView {
    std::span<const Vec3> positions;      //!< #V x 3, mesh units.
    std::span<const Triangle> triangles;  //!< #F x 3, vertices.
};

//! #V x 3 positions and #F x 3 vertex indices.
struct TriangleMesh {
    std::vector<Vec3> positions;      //!< #V x 3, mesh units.
    std::vector<Triangle> triangles;  //!< #F x 3, vertices.

    //! Must not outlive the mesh.
    [[nodiscard]] MeshView view() const { return {positions, triangles}; }
    //! Every function of a MeshView takes a TriangleMesh. The view must not outlive the mesh.
    operator MeshView() const { return view(); }
};

//! A face and barycentric coordinates (>= 0, sum 1; coordinate k belongs to corner k of the face).
//! A coordinate that is exactly 0 puts the point on the opposite edge; two put it on a vertex.
struct SurfacePoint {
    FaceId face;                                 //!< In which it lies.
    std::array<double, 3> barycentric{1, 0, 0};  //!< Of the face's corners.

    //! The same face and the same coordinates; a point of an edge has another name in each face.
    bool operator==(const SurfacePoint&) const = default;
};

//! The point in space.
[[nodiscard]] inline Vec3 position(const MeshView& mesh, const SurfacePoint& point) {
    const Triangle& t = mesh.triangles[point.face.value()];
    return point.barycentric[0] * mesh.positions[t[0]] +
           point.barycentric[1] * mesh.positions[t[1]] +
           point.barycentric[2] * mesh.positions[t[2]];
}

//! The corners of a face in space.
[[nodiscard]] inline std::array<Vec3, 3> corners_of(const MeshView& mesh, Index face) {
    const auto& [a, b, c] = mesh.triangles[face];
    return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

//! The normal of a triangle, twice its area long.
[[nodiscard]] inline Vec3 doubled_normal(std::span<const Vec3> positions, const Triangle& t) {
    return (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]);
}

//! #V unit vectors: the mean of the normals of the faces around each vertex, weighted by their
//! angles there ([thurmer1998]). Zero where there is no face, or none with area.
//! Cost: O(n).
[[nodiscard]] std::vector<Vec3> vertex_normals(const MeshView& mesh);

}  // namespace agvd
