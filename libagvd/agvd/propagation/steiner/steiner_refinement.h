//! \file
//! The Steiner engine with an error bound: points are inserted where paths are too long.
#pragma once

#include "agvd/propagation/propagation_options.h"
#include "agvd/propagation/relays.h"

namespace agvd {

//! propagate_steiner() for a given max_error > 0, the other options checked.
//!
//! The window engine gives the exact distances of the vertices. Each round propagates over the
//! Steiner points, and inserts points along the paths of the vertices whose distance is off by more
//! than max_error. The rounds end when there is no such vertex. All points are kept until a round
//! ends, since paths are followed back.
//! \throw ConstraintUnmet  1000 points on an edge do not suffice, or will foreseeably not suffice.
//! Cost: the window engine once, and one propagation a round; there are at most 20.
[[nodiscard]] Propagation propagate_steiner_within(const Surface& surface,
                                                   std::span<const SurfacePoint> sites,
                                                   const PropagationOptions& options);

}  // namespace agvd
