//! \file
//! Strong edges carry weak ones: where a crease fades for a while, or ends.
#pragma once

#include "remesh/features/crease_chains.h"

namespace remesh::detail {

//! Which edges a crease may go on along.
struct CarryRules {
    double least_angle = 0;  //!< Radians.
    double most_gap = 0;     //!< Mesh units.
};

//! Joins ends in nothing to what lies ahead of them, by the shortest path of weak edges, shortest
//! paths first. No gap is longer than the chain that ends there.
//!
//! \param angles  #E, radians.
//! Cost: O(#E + k log k), k = weak edges within reach of an end.
void close_gaps(CreaseSet& set, const std::vector<double>& angles, const CarryRules& rules,
                agvd::Poller& poller);

//! Lets chains that end in nothing go on along weak edges as long as these turn by less than 45
//! degrees, by at most their own length.
//!
//! Cost: O(#E).
void extend_ends(CreaseSet& set, const std::vector<double>& angles, const CarryRules& rules,
                 agvd::Poller& poller);

}  // namespace remesh::detail
