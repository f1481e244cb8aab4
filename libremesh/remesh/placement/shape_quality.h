//! \file
//! The quality of a triangle as one number.
#pragma once

#include <algorithm>
#include <numbers>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Triangles of lower quality are improved: of those with two equal angles, the ones with an angle
//! above 92 degrees.
inline constexpr double low_quality = 0.7;
//! Factor of the sine of the smallest angle: 36.6 degrees count as `low_quality`.
inline constexpr double sine_weight = low_quality / 0.597;

//! 6 / sqrt(3) * S / (p h) ([frey1999]): S area, p half the perimeter, h the longest edge; lower if
//! an angle is small. 0 to 1.
[[nodiscard]] inline double shape_quality(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
    const double doubled_area = (b - a).cross(c - a).norm();
    if (!(doubled_area > 0)) return 0;
    const double longest = std::max({ab, bc, ca});
    // The smallest angle is the one between the longest sides.
    const double sine = doubled_area * std::min({ab, bc, ca}) / (ab * bc * ca);
    return std::min(2 * std::numbers::sqrt3 * doubled_area / ((ab + bc + ca) * longest),
                    sine_weight * sine);
}

}  // namespace remesh::detail
