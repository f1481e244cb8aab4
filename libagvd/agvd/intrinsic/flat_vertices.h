//! \file
//! Takes away vertices that the surface does not need. Private to intrinsic.
#pragma once

#include "agvd/core/poller.h"
#include "agvd/intrinsic/face_history.h"

namespace agvd::detail {

struct RemovalCounts {
    Index vertices = 0;
    std::size_t flips = 0;
};

//! A vertex inside whose angles sum to 2 pi is a point like any other: without it the surface is
//! the same. Those with an edge shorter than `min_length` go, none with a neighbour at a time,
//! until no such edge is left where that can be done: edges at a vertex are flipped until three are
//! left, or four of which two are one straight line, and the faces around it merge.
//!
//! Before all other operations: flips blur angles, and where needles were flipped first, points
//! passed four times as many operations. Faces and edges that go leave gaps: see compact_faces().
//! \param history  is told.
//! \param is_kept  by edge: 1 for edges that stay; or empty.
//! Cost: O(#F), and O(log n) for each vertex removed.
RemovalCounts remove_flat_vertices(Surface& surface, FaceCharts& charts, FaceHistory& history,
                                   const std::vector<std::uint8_t>& is_kept, double min_length,
                                   int num_threads, Poller& poller);

}  // namespace agvd::detail
