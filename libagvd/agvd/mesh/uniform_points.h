//! \file
//! Random points spread evenly over a surface.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

//! Uniform in a triangle for u and v uniform in [0, 1]: u is the share of the area cut off at
//! corner 0, v runs across.
[[nodiscard]] inline std::array<double, 3> uniform_barycentric(double u, double v) {
    const double root = std::sqrt(u);
    return {1 - root, root * (1 - v), root * v};
}

//! `count` independent points in face interiors, uniform by area; point i depends on the surface,
//! the seed and i only. Cost: O(n + count log n).
[[nodiscard]] std::vector<SurfacePoint> uniform_points(const Surface& surface, Index count,
                                                       std::uint64_t seed);

}  // namespace agvd
