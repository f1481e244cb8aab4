//! \file
//! Random points spread evenly over a surface.
#pragma once

#include <cstdint>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

//! `count` independent points in face interiors, uniform by area; point i depends on the surface,
//! the seed and i only. Cost: O(n + count log n).
[[nodiscard]] std::vector<SurfacePoint> uniform_points(const Surface& surface, Index count,
                                                       std::uint64_t seed);

}  // namespace agvd
