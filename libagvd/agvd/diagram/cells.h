//! \file
//! The diagram seen cell by cell: boundary loops and neighbours.
#pragma once

#include "agvd/core/poller.h"
#include "agvd/diagram/diagram.h"

namespace agvd {

//! A directed edge of the complex with the cell on its left.
struct DirectedEdge {
    Index edge = no_index;
    bool reversed = false;  //!< True: walked from head to tail.
};

//! Cell s has the loops [cell_loops[s], cell_loops[s + 1]); loop l has the directed edges
//! [loop_edges[l], loop_edges[l + 1]) of `edges`, head to tail, the cell on their left. A cell that
//! covers a whole closed component has no loop.
struct Cells {
    std::vector<Index> cell_loops;
    std::vector<Index> loop_edges;
    std::vector<DirectedEdge> edges;
    std::vector<Index> neighbour_offsets;  //!< #sites + 1 offsets into neighbours.
    std::vector<SiteId> neighbours;        //!< Ascending, without repetition.
};

//! Cost: O(size of the complex).
[[nodiscard]] Cells build_cells(const Diagram& diagram, Ticker ticker = {});

}  // namespace agvd
