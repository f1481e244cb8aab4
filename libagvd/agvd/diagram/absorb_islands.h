//! \file
//! Cells are connected: a geodesic to the nearest site stays in its cell. Approximate distances may
//! break that where two sites nearly tie; here it is mended.
#pragma once

#include "agvd/diagram/islands.h"

namespace agvd {

//! What islands were absorbed.
struct AbsorbedIslands {
    std::vector<OldLabel> points;  //!< With the labels that they had, in the order of the changes.
    std::vector<Index> faces;      //!< Traced again; maybe some of them twice.
    CellSet in_doubt;              //!< Cells that islands may be left of.
};

//! Gives every part of a cell that does not hang together with its site to a cell that it borders
//! on, and traces and joins the faces around anew, until nothing changes. It ends, since label
//! changes only vanish. Only cells are asked that the tally has been told of since its last
//! take_changed(), and those in doubt.
//! \param displaced  the sites whose place belongs to another cell.
//! \param in_doubt   of the cells that the tally was not told of.
//! Cost: that of loops.h for most diagrams; on the others that of the cells with islands.
AbsorbedIslands absorb_islands(const StageInput& input, const CellSet& displaced,
                               const CellSet& in_doubt, DiagramParts& parts);

//! Counts a vertex that has another label: the vertex, the edges that it speaks for and the
//! unlisted faces.
void recount_vertex(const Surface& surface, Index vertex, Index old_site, DiagramParts& parts);

}  // namespace agvd
