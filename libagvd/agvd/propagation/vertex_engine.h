//! \file
//! One image of a site per vertex: coarse distances and labels at the cost of a few sweeps.
#pragma once

#include "agvd/propagation/corners.h"
#include "agvd/propagation/propagation_options.h"
#include "agvd/propagation/relays.h"

namespace agvd {

//! propagate() with checked options. max_error must be unset.
//!
//! \param corners  Corners(surface).
//! Cost: O(n log n) time, O(n) space.
[[nodiscard]] Propagation propagate_vertices(const Surface& surface, const Corners& corners,
                                             std::span<const SurfacePoint> sites,
                                             const PropagationOptions& options);

}  // namespace agvd
