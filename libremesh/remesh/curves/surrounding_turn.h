//! \file
//! How much a surface turns around its creases.
#pragma once

#include <vector>

#include "remesh/curves/crease_chains.h"

namespace remesh::detail {

//! For each edge of the set: how much the surface around it turns, radians; 0 for other edges. It
//! is the root of the sum of angle squared times length over all edges outside the set within
//! `reach`, on both sides, per length of the set's edge. So the many small turns of round faces and
//! fillets count little, noise counts about as much as the noisy edge itself, and edges between
//! coplanar faces do not count. The reach is the length of the set's edges if that is longer, but
//! at most four times `reach`.
//!
//! \param angles  #E, radians.
//! \return #E.
//! Cost: O(#V + k log k), k = edges within reach.
[[nodiscard]] std::vector<double> surrounding_turn(const CreaseSet& set,
                                                   const std::vector<double>& angles, double reach,
                                                   Poller& poller);

}  // namespace remesh::detail
