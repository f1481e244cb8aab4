//! \file
//! Paths over surfaces, and a test whether one is locally shortest.
#pragma once

#include <span>

#include "agvd/paths/geodesic_path.h"

namespace geodesics {

//! A path from one point to another over faces chosen at random, through the middles of edges; both
//! points must lie on one component. Its length is not set.
[[nodiscard]] agvd::GeodesicPath random_path(const agvd::Surface& surface,
                                             const agvd::SurfacePoint& from,
                                             const agvd::SurfacePoint& to, std::uint64_t seed);

//! The sum of the straight lines from point to point, each of which must lie in one face.
[[nodiscard]] double length(const agvd::Surface& surface,
                            std::span<const agvd::SurfacePoint> points);

//! How far below pi the narrowest side of a path is at the points between its ends; a side with a
//! boundary counts as wide. 0 if none is below. Points that nearly coincide count as one.
[[nodiscard]] double largest_bend(const agvd::Surface& surface,
                                  std::span<const agvd::SurfacePoint> points);

}  // namespace geodesics
