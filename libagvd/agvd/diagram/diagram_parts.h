//! \file
//! What the stages of a diagram make, before it is drawn.
#pragma once

#include "agvd/diagram/cell_tally.h"
#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/joined_edges.h"

namespace agvd {

//! A diagram in pieces that keep their names while others are replaced.
struct DiagramParts {
    //! Without any labels.
    //! \param surface  outlives this.
    DiagramParts(const Surface& surface, Index num_sites)
        : boundary_loops(agvd::boundary_loops(surface)), arcs(surface), tally(surface) {
        tally.resize(num_sites);
    }

    std::vector<std::vector<Index>> boundary_loops;  //!< Of the surface: half-edges.
    EdgeLabels labels;
    ArcStore arcs;
    JoinedEdges joined;
    CellTally tally;
};

}  // namespace agvd
