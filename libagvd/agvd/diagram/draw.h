//! \file
//! Draws a diagram: numbers for its edges and vertices, and where their points lie.
#pragma once

#include "agvd/diagram/diagram.h"
#include "agvd/diagram/diagram_parts.h"

namespace agvd {

//! \param faces  ascending: all that have arcs.
//! \throw Cancelled
//! Cost: O(#V + points of the edges).
[[nodiscard]] Diagram draw_diagram(const Surface& surface, const DiagramParts& parts,
                                   std::span<const Index> faces, Ticker ticker);

//! Sets nearest_site and nearest_distance. Cost: O(#V).
void draw_nearest(const Surface& surface, const EdgeLabels& labels, Diagram& diagram);

}  // namespace agvd
