//! \file
//! Refuses sites that are not on the surface.
#pragma once

#include <span>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

//! \throw InvalidSites naming the site when its face does not exist or it is off the face.
void check_sites(const Surface& surface, std::span<const SurfacePoint> sites);

}  // namespace agvd
