//! \file
//! Makes cells connected. Exact cells are: a geodesic to the nearest site stays in its cell. With
//! approximate distances they may have several parts where two sites nearly tie.
#pragma once

#include "agvd/diagram/islands.h"

namespace agvd {

//! What absorbing islands changed.
struct AbsorbedIslands {
    std::vector<OldLabel> points;  //!< With the labels that they had, in the order of the changes.
    std::vector<Index> faces;      //!< Traced again; maybe some of them twice.
    CellSet in_doubt;              //!< Cells that may still have islands.
};

//! Gives every part of a cell that is not connected to its site to a cell that it borders on, and
//! traces and joins the faces around it again, until nothing changes. This ends, since label
//! changes only vanish. Islands are searched in the cells that CellTally::take_changed() returns,
//! and in those in doubt.
//!
//! An island is found only when its arcs are joined, so the faces around it are traced and joined
//! twice: 2 to 14 of the thousands of mixed faces of a diagram, in 7 of 20 diagrams with E = 1e-3
//! (ten meshes, 100 and 2000 random sites), 2 of 20 with 1e-4, none with exact distances.
//! \param displaced  the sites whose place belongs to another cell.
//! \param in_doubt   the cells that an earlier call returned as in doubt.
//! Cost: that of count_loops() for most diagrams; on the others that of the cells with islands.
AbsorbedIslands absorb_islands(const StageInput& input, const CellSet& displaced,
                               const CellSet& in_doubt, DiagramParts& parts);

//! Corrects the tally for a vertex that has another label: the vertex, the first intervals of edges
//! from it, and the unlisted faces around it.
void recount_vertex(const Surface& surface, Index vertex, Index old_site, DiagramParts& parts);

}  // namespace agvd
