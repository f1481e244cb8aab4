//! \file
//! Limits how fast target lengths grow.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

//! Paths that lengths are measured along.
enum class Paths {
    Edges,  //!< Up to twice as long as geodesics.
    Lines  //!< Along for_each_line, too: a few per cent longer in most directions, at most a fifth.
};

//! Lowers lengths until length[u] <= length[v] + slope * d for all vertices u and v, where d is the
//! length of the shortest path. Lengths that keep this already stay.
//!
//! \param joined  pairs of vertices that are one, such as copies on both sides of a cut.
//! \param slope   >= 0.
//! \param length  #V, > 0; edited in place.
//! Cost: O(n log n) for the vertices that change.
void limit_growth(const Surface& surface, std::span<const std::pair<Index, Index>> joined,
                  double slope, Paths paths, std::span<double> length, Ticker& ticker);

}  // namespace remesh
