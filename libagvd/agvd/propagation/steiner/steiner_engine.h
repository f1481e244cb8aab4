//! \file
//! The paper's engine: multi-source propagation over Steiner points.
#pragma once

#include "agvd/propagation/propagate.h"

namespace agvd {

//! propagate() with checked options.
//! \throw ConstraintUnmet  for max_error 1000 points on an edge do not suffice, or will foreseeably
//!                         not suffice.
//! Cost with max_error: the window engine once, and one propagation a round; there are at most 20.
[[nodiscard]] Propagation propagate_steiner(const Surface& surface,
                                            std::span<const SurfacePoint> sites,
                                            const PropagationOptions& options);

}  // namespace agvd
