//! \file
//! Geometry and tolerances that the passes on windows share.
#pragma once

#include "agvd/core/types.h"

namespace agvd {

//! A ray that passes the end of a window by at most this, relative to the length of the edge or to
//! the distance of the image if that is less, counts as straight.
inline constexpr double grazing = 1e-10;

//! A share of the edge: if a site is nearer to a vertex than this, rounding may hide which faces it
//! sees past the vertex. Of
//! 470 000 sites, most of them on edges, those up to 7e-6 away missed a vertex behind now and then.
inline constexpr double near_vertex = 1e-4;

//! A vector in the frame whose x axis is the unit vector `axis`.
[[nodiscard]] inline Vec2 into(const Vec2& axis, const Vec2& v) {
    return {axis.x() * v.x() + axis.y() * v.y(), axis.x() * v.y() - axis.y() * v.x()};
}

}  // namespace agvd
