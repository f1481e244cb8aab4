//! \file
//! Takes out of a set of crease edges what looks like noise at a scale.
#pragma once

#include "remesh/features/crease_chains.h"

namespace remesh::detail {

//! What may stay, mesh units. The merit of a chain is the sum of its edges' lengths times weights.
struct PruningRules {
    double least_spur = 0;    //!< Merit of a chain with one end in nothing.
    double least_island = 0;  //!< Merit of a chain with both ends in nothing.
    //! Merit of chains that hang together with no other, or of a closed one. Short chains count in
    //! proportion to their length.
    double least_network = 0;
    double short_chain = 0;  //!< Length below which chains are short.
    double least_worth = 0;  //!< A network's merit, so counted, per length.
};

//! \param weights  #E, >= 0.
//! Cost: O(#E + k log k), k = edges of the set.
void prune(CreaseSet& set, const std::vector<double>& weights, const PruningRules& rules,
           agvd::Poller& poller);

}  // namespace remesh::detail
