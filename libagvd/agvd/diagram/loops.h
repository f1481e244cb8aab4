//! \file
//! The boundaries of cells, by joined arcs.
#pragma once

#include "agvd/diagram/cell_set.h"
#include "agvd/diagram/diagram_parts.h"

namespace agvd {

//! \return by site: the number of loops that bound each of these cells; 0 for the others.
//! Cost: O(edges + boundary).
[[nodiscard]] std::vector<Index> count_loops(const Surface& surface, const DiagramParts& parts,
                                             const CellSet& cells);

//! \return for each Voronoi edge that bounds one of these cells a face that it passes, in any
//! order.
[[nodiscard]] std::vector<Index> faces_on_borders(const DiagramParts& parts, const CellSet& cells);

}  // namespace agvd
