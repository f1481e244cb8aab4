//! \file
//! Surfaces that unroll into the plane, and the distances of segments on them by formula.
#pragma once

#include "agvd/propagation/propagate.h"

namespace developable {

//! The side of a prism or of a pyramid.
struct Unrolled {
    agvd::Surface surface;
    std::vector<std::array<agvd::Vec2, 3>> corners;  //!< Of each face, in the plane.
    agvd::Vec2 shift{0, 0};  //!< Once around leads back to the same place, moved so far;
    double angle = 0;        //!< or turned by so much about the origin.

    //! Where a point lies in the plane, in one of several places.
    [[nodiscard]] agvd::Vec2 place(const agvd::SurfacePoint& point) const;
    //! The distance of a point from the edges of a shape.
    [[nodiscard]] double distance(const agvd::SiteShape& shape,
                                  const agvd::SurfacePoint& point) const;
    //! The chain of edges through these vertices.
    [[nodiscard]] agvd::SiteShape line(const std::vector<agvd::Index>& vertices,
                                       agvd::Index site = 0) const;
};

//! A prism of radius 1 and height 2 with n sides, each of m quads. Vertex j n + k is on ring j and
//! ridge k.
[[nodiscard]] Unrolled prism(agvd::Index n, agvd::Index m);

//! A pyramid of radius and height 1 with n sides. Vertex 0 is the apex, vertex 1 + j n + k on ring
//! j of m, the last one the base, and on ridge k.
[[nodiscard]] Unrolled pyramid(agvd::Index n, agvd::Index m);

}  // namespace developable
