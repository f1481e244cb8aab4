//! \file
//! Limits how fast target lengths grow.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "agvd/core/poller.h"
#include "agvd/mesh/surface.h"

namespace remesh {

//! Lowers lengths until length[u] <= length[v] + slope * d for all vertices u and v, where d is the
//! length of the shortest path along the lines of for_each_line. Lengths that keep this already stay.
//!
//! \param joined  pairs of vertices that are one, such as copies on both sides of a cut.
//! \param slope   >= 0.
//! \param length  #V, > 0; edited in place.
//! Cost: O(n log n) for the vertices that change.
void limit_growth(const agvd::Surface& surface,
                  std::span<const std::pair<agvd::Index, agvd::Index>> joined, double slope,
                  std::span<double> length, agvd::Ticker& ticker);

}  // namespace remesh
