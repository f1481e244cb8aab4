//! \file
//! Points on surfaces, for sites and targets.
#pragma once

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "support/dice.h"

namespace points {

//! Points in face interiors, inside edges and at vertices in turn, on random faces.
[[nodiscard]] std::vector<agvd::SurfacePoint> scattered(const agvd::Surface& surface,
                                                        agvd::Index count, std::uint64_t seed);

//! Anywhere on a face: inside, on an edge, at a vertex, or close to one of these.
[[nodiscard]] agvd::SurfacePoint anywhere(Dice& dice, agvd::Index face);

//! One site, a few, or more than there are faces (up to 120); some share a face or a position.
[[nodiscard]] std::vector<agvd::SurfacePoint> random_sites(Dice& dice, agvd::Index num_faces);

}  // namespace points
