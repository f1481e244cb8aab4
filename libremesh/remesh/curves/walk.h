//! \file
//! Moves of points along the surface.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Least barycentric coordinate of a point inside a face. It keeps points off edges by more than
//! the rounding of any position, and biases the density by no more than this share.
inline constexpr double interior_margin = 1e-6;

//! Moves a point of a face off its edges by at least that, where it is nearer.
inline void keep_inside(std::array<double, 3>& barycentric) {
    double sum = 0;
    for (double& b : barycentric) sum += b = std::max(b, interior_margin);
    for (double& b : barycentric) b /= sum;
}

//! The unit normal of the surface at a point.
[[nodiscard]] inline Vec3 facing_at(const Surface& surface, const SurfacePoint& point) {
    const Triangle& t = surface.mesh.triangles[point.face.value()];
    return doubled_normal(surface.mesh.positions, t).normalized();
}

struct Walk {
    SurfacePoint end;
    int num_crossings = 0;    //!< From face to face.
    bool is_cut_off = false;  //!< After 2000 crossings: at a spike it may circle for ever.
};

//! Walks the straightest geodesic ([polthier1998]) from a point along `step`, from face to face,
//! never through a wall, and stops short of the boundary. The end lies strictly inside a face,
//! unless `step` is nearly normal to the first one: then the point stays.
//! \param step  mesh units; its component in the plane of the face gives the direction.
//! Cost: O(faces crossed).
[[nodiscard]] Walk walk_straight(const Surface& surface, const SurfacePoint& from,
                                 const Vec3& step);

//! The boundary half-edge that a point lies on, if any; at a vertex the one that leaves it.
[[nodiscard]] std::optional<Index> boundary_half_edge(const Surface& surface,
                                                      const SurfacePoint& point);

//! The end of a walk along the boundary, strictly inside a boundary edge. Its length is that of the
//! component of `step` along the half-edge, in its direction or against it.
//! \param from  a point of boundary half-edge h.
//! Cost: O(edges passed).
[[nodiscard]] SurfacePoint walk_boundary(const Surface& surface, const SurfacePoint& from, Index h,
                                         const Vec3& step);

}  // namespace remesh::detail
