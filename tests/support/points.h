//! \file
//! Points on surfaces, for sites and targets.
#pragma once

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace points {

[[nodiscard]] agvd::SurfacePoint at_vertex(const agvd::Surface& surface, agvd::Index vertex);

//! Points in face interiors, inside edges and at vertices in turn, on random faces.
[[nodiscard]] std::vector<agvd::SurfacePoint> scattered(const agvd::Surface& surface,
                                                        agvd::Index count, std::uint64_t seed);

}  // namespace points
