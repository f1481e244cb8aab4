//! \file
//! Areas and Euler characteristics of cells.
#pragma once

#include "agvd/diagram/arc_store.h"
#include "agvd/diagram/diagram.h"
#include "agvd/diagram/cell_set.h"

namespace agvd {

//! Replaces cell_area and cell_euler of the cells asked for. Sums run in the order of the faces,
//! whatever is asked.
//! \param faces  all that those cells reach into.
//! Cost: O(faces + #V).
void measure_cells(const Surface& surface, const EdgeLabels& labels, const ArcStore& arcs,
                   const FaceList& faces, const CellSet& asked, Diagram& diagram);

}  // namespace agvd
