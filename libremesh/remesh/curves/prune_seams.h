//! \file
//! Leaves out the texture seams that a mesh of a given spacing cannot follow.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

//! Seams part the surface into charts. Those around a chart narrower than 2.5 spacings, as twice
//! its area over the length of its seams tells, are left out, the narrowest first; then chains with
//! a free end that are shorter than two spacings.
//!
//! \param is_crease  #E: a chain that ends on these, or on the boundary, has no free end there;
//!                   empty: there are none.
//! \param spacing    of the sites, mesh units.
//! \param is_seam    #E; edited in place.
//! Cost: O(#E).
void prune_seams(const Surface& surface, std::span<const std::uint8_t> is_crease, double spacing,
                 std::vector<std::uint8_t>& is_seam, Ticker ticker = {});

}  // namespace remesh
