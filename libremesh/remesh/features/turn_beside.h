//! \file
//! How much a surface turns beside its creases.
#pragma once

#include <vector>

#include "remesh/features/crease_chains.h"

namespace remesh::detail {

//! For each edge of the set: the angle by which the surface beside it turns within `reach` of it,
//! on both sides together and on whatever edges outside the set, radians; 0 for other edges. That
//! is about 2 reach / R beside a crease of a part of radius R, and as much as the crease's own
//! angle on a scan's noise. Where the set's edges are longer than `reach`, as far as these.
//!
//! \param angles  #E, radians.
//! \return #E.
//! Cost: O(#V + k log k), k = edges within reach.
[[nodiscard]] std::vector<double> turn_beside(const CreaseSet& set,
                                              const std::vector<double>& angles, double reach,
                                              agvd::Poller& poller);

}  // namespace remesh::detail
