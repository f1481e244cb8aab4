//! \file
//! Parts of cells that are not connected to their site.
#pragma once

#include "agvd/diagram/cell_set.h"
#include "agvd/diagram/diagram_parts.h"
#include "agvd/diagram/stage_input.h"

namespace agvd {

//! What the label of a point was.
struct OldLabel {
    Index point;
    Index site;
};

//! The cells that may have islands: all others are bounded by one loop, which each part would need
//! for itself, and own the place of their site.
//! \param displaced  the sites that do not.
//! \param num_loops  by site, boundary loops of its cell.
[[nodiscard]] CellSet cells_in_doubt(const CellSet& displaced, std::span<const Index> num_loops);

//! What giving islands to other cells changed.
struct RelabelledIslands {
    std::vector<OldLabel> points;  //!< Those with another label, each once.
    //! Ascending: the mixed faces around changed labels, whose arcs are those of the old ones.
    //! Empty: there are no islands.
    std::vector<Index> faces;
};

//! Finds the parts of cells in doubt that are not connected to their site and gives each to a cell
//! that it borders on. Changes the labels, and the tally for rows but not for points.
//! Cost: nearly linear in the points and crossings of the faces that these cells reach into, and
//! O(#V + crossings) quick steps.
[[nodiscard]] RelabelledIslands relabel_islands(const StageInput& input, const CellSet& in_doubt,
                                                DiagramParts& parts);

}  // namespace agvd
