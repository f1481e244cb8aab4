//! \file
//! Stretches of one label as nodes of a graph.
#pragma once

#include "agvd/diagram/edge_labels.h"

namespace agvd {

//! Nodes are the points of EdgeLabels and then, by crossing, the intervals after crossings: those
//! that end at no point. Calls callback(crossing, before, site_before, after, site_after) for each
//! crossing of a row with the nodes on its two sides.
//! \param from, to  the points at the row's ends.
template <typename Callback>
void for_each_crossing(const EdgeLabels& labels, const Block& row, Index from, Index to,
                       const Callback& callback) {
    const auto num_points = static_cast<Index>(labels.point_site.size());
    Index before = from;
    for (Index c = row.begin; c < row.end(); ++c) {
        const Index after = c + 1 == row.end() ? to : num_points + c;
        const Crossing& crossing = labels.crossings[c];
        callback(c, before, crossing.site_before, after, crossing.site_after);
        before = after;
    }
}

}  // namespace agvd
