//! \file
//! Removes vertices without curvature. Private to intrinsic.
#pragma once

#include "agvd/core/poller.h"
#include "agvd/intrinsic/face_history.h"

namespace agvd::detail {

struct RemovalCounts {
    Index vertices = 0;
    std::size_t flips = 0;
};

//! An inner vertex whose angles sum to 2 pi can be removed without changing the surface. Removes
//! those with an edge shorter than `min_length`, as far as possible, in rounds without two
//! neighbours. Edges at the vertex are flipped until three are left, or four of which two are one
//! straight line. Then the faces around it merge.
//!
//! To be called before all other operations: flips add errors to angles, and if needles were
//! flipped first, points would pass four times as many operations. Removed faces and edges leave
//! gaps: see compact_faces().
//! \param history  records the operations.
//! \param is_kept  by edge: 1 for edges that stay; or empty.
//! Cost: O(#F), and O(log n) for each vertex removed.
RemovalCounts remove_flat_vertices(Surface& surface, FaceCharts& charts, FaceHistory& history,
                                   const std::vector<std::uint8_t>& is_kept, double min_length,
                                   int num_threads, Poller& poller);

}  // namespace agvd::detail
