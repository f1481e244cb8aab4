//! \file
//! Quick upper bounds for the distance from the nearest site, by which windows die.
#pragma once

#include <span>

#include "agvd/mesh/surface_point.h"
#include "agvd/propagation/arc_graph.h"

namespace agvd {

struct DistanceBounds {
    std::vector<float> distance;  //!< #V; infinity where no site reaches.
    std::vector<Index> site;      //!< #V: whose path it is; no_index where none reaches.
    std::size_t peak_bytes = 0;   //!< Most bytes held at once, result included.
};

//! Shortest paths along the arcs of a graph. Rounded up, so that no rounding of an exact distance
//! lies above. Unique, so that the order in which threads relax does not matter.
//!
//! \param graph      ArcGraph of the surface.
//! \param mean_edge  > 0, mesh units; a matter of speed only.
//! Cost: about that of one Dijkstra sweep over the edges.
[[nodiscard]] DistanceBounds distance_bounds(const Surface& surface, const ArcGraph& graph,
                                             double mean_edge, std::span<const SurfacePoint> sites,
                                             int num_threads);

}  // namespace agvd
