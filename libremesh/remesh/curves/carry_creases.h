//! \file
//! Continues creases along weak edges: across gaps and beyond open ends.
#pragma once

#include "remesh/curves/crease_chains.h"

namespace remesh::detail {

//! The edges along which a crease may continue.
struct CarryRules {
    double least_angle = 0;  //!< Radians.
    double most_gap = 0;     //!< Mesh units.
};

//! Joins open ends to vertices ahead of them by the shortest path of weak edges, shortest paths
//! first. No gap is longer than the chain that ends there.
//!
//! \param angles  #E, radians.
//! Cost: O(#E + k log k), k = weak edges within reach of an end.
void close_gaps(CreaseSet& set, const std::vector<double>& angles, const CarryRules& rules,
                Poller& poller);

//! Extends chains at open ends along weak edges that turn by less than 45 degrees, by at most their
//! own length.
//!
//! Cost: O(#E).
void extend_ends(CreaseSet& set, const std::vector<double>& angles, const CarryRules& rules,
                 Poller& poller);

}  // namespace remesh::detail
