//! \file
//! Distances between points of one face, from its lengths alone.
#pragma once

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

//! The length of the straight segment within the face, in mesh units. The face need not lie in
//! space.
//! \param a, b  of one face.
[[nodiscard]] inline double face_distance(const Surface& surface, const SurfacePoint& a,
                                          const SurfacePoint& b) {
    const std::size_t h = std::size_t{3} * a.face.value();
    const double head = b.barycentric[1] - a.barycentric[1];
    const double apex = b.barycentric[2] - a.barycentric[2];
    return (apex * surface.apex[h] + Vec2(head * surface.length[surface.edge[h]], 0)).norm();
}

}  // namespace agvd
