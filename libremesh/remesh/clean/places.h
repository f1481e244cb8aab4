//! \file
//! Boundary vertices that lie at one place. Private to cleaning.
#pragma once

#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh::detail {

//! For each wanted vertex the first one at its place; no_index for the others.
//!
//! Equal positions are one place. So are positions that differ by a millionth of the mesh's longest
//! side at most, and by a hundredth of each edge there: programs that write coordinates with six or
//! seven digits leave such gaps. A grid finds them; vertices with less than an eighth of the reach
//! that most have would crowd its cells, so these have to be equal.
//!
//! \param is_wanted  #V: vertices of the boundary.
//! \param tolerance  above 0: the limits are this length, if that is more, and half of each edge.
//! Cost: O(#F + #wanted).
[[nodiscard]] std::vector<Index> find_places(const MeshView& mesh,
                                             const std::vector<bool>& is_wanted, Ticker& ticker,
                                             double tolerance = 0);

}  // namespace remesh::detail
