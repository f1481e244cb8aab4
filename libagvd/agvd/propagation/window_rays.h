//! \file
//! Small geometry that windows share.
#pragma once

#include "agvd/core/types.h"

namespace agvd {

//! A ray this close to a window's end (relative to the edge, or to the image where that is nearer)
//! is not bent.
inline constexpr double grazing = 1e-10;

//! Of the edge: nearer to a vertex than this, rounding may hide which faces a site sees past it. Of
//! 470 000 sites, most of them on edges, those up to 7e-6 away missed a vertex behind now and then.
inline constexpr double beside_vertex = 1e-4;

//! A vector in the frame whose x axis is the unit vector `axis`.
[[nodiscard]] inline Vec2 into(const Vec2& axis, const Vec2& v) {
    return {axis.x() * v.x() + axis.y() * v.y(), axis.x() * v.y() - axis.y() * v.x()};
}

}  // namespace agvd
