//! \file
//! Repairs starts that are far from even.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/surface_point.h"
#include "agvd/propagation/surface_layout.h"

namespace remesh::detail {

//! Moves sites whose cells are tiny to random places of cells that are many times larger than the
//! mean, so that each gets about as many as belong there: what relaxation does in a number of steps
//! that grows with the number of sites. Even starts stay as they are. Returns the number of sites
//! moved.
//!
//! \param is_fixed  #sites: 1 for sites that stay; or empty.
//! Cost: a few sweeps over the edges.
agvd::Index even_out(const agvd::Surface& surface, const agvd::SurfaceLayout& layout,
                     std::vector<agvd::SurfacePoint>& sites, std::span<const std::uint8_t> is_fixed,
                     int num_threads);

}  // namespace remesh::detail
