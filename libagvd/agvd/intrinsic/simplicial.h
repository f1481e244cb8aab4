//! \file
//! Tests of Delta-complexes for being simplicial. Private to intrinsic.
#pragma once

#include <vector>

#include "agvd/mesh/surface.h"

namespace agvd::detail {

//! Whether two vertices have a common edge. Cost: O(edges of the one that has fewer).
[[nodiscard]] bool has_edge(const Surface& surface, Index a, Index b);

//! Ascending: edges to cut so that the complex comes closer to a simplicial one: loops, and all but
//! one of several edges with the same ends; if there are none, one of every face but one with the
//! same corners. Empty where the complex is simplicial. If all of them are cut at their middles,
//! none is left after a few rounds. Cost: O(n log n).
[[nodiscard]] std::vector<Index> edges_to_cut(const Surface& surface);

}  // namespace agvd::detail
