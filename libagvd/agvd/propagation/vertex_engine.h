//! \file
//! One image of a site per vertex: coarse distances and labels at the cost of a few sweeps.
#pragma once

#include "agvd/propagation/propagate.h"

namespace agvd {

//! propagate() with checked options. max_error must be unset.
//! Cost: O(n log n) time, O(n) space.
[[nodiscard]] Propagation propagate_vertices(const Surface& surface,
                                             std::span<const SurfacePoint> sites,
                                             const PropagationOptions& options);

}  // namespace agvd
