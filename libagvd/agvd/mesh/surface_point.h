//! \file
//! A point on the surface: a site, or the place of a result on the input.
#pragma once

#include "agvd/mesh/mesh_view.h"

namespace agvd {

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

}  // namespace agvd
