//! \file
//! Removes from a set of crease edges what looks like noise at a scale.
#pragma once

#include "remesh/curves/crease_chains.h"

namespace remesh::detail {

//! The least values of what stays, mesh units. The merit of a chain is the sum of length times
//! weight over its edges.
struct PruningRules {
    double least_spur = 0;    //!< Merit of a chain with one open end.
    double least_island = 0;  //!< Merit of a chain with two open ends.
    //! Merit of a connected network, which may be a single closed chain. Short chains count in
    //! proportion to their length.
    double least_network = 0;
    double short_chain = 0;    //!< Length below which chains are short.
    double least_density = 0;  //!< A network's merit, counted in this way, per length.
};

//! Removes chains with open ends, then networks, that fall short of the rules.
//!
//! \param weights  #E, >= 0.
//! Cost: O(#E + k log k), k = edges of the set.
void prune(CreaseSet& set, const std::vector<double>& weights, const PruningRules& rules,
           Poller& poller);

}  // namespace remesh::detail
