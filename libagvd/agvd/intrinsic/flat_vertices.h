//! \file
//! Removes vertices without curvature. Private.
#pragma once

#include "agvd/intrinsic/operations.h"

namespace agvd::detail {

//! An inner vertex whose angles sum to 2 pi can be removed without changing the surface. Removes
//! those with an edge shorter than `min_length`, as far as possible, in rounds without two
//! neighbours. Edges at the vertex are flipped until three are left, or four of which two are one
//! straight line. Then the faces around it merge.
//!
//! To be called before all other operations: flips add errors to angles, and if needles were
//! flipped first, points would pass four times as many operations. Removed faces and edges leave
//! gaps: see compact_faces().
//! \param history  records the operations.
//! \return the number of vertices removed. Cost: O(#F), and O(log n) for each vertex removed.
Index remove_flat_vertices(Surface& surface, FaceCharts& charts, FaceHistory& history,
                           double min_length, int num_threads, Poller& poller);

//! Closes gaps: the last faces and edges get the numbers of removed ones. Charts become invalid.
void compact_faces(Surface& surface, FaceHistory& history);

}  // namespace agvd::detail
