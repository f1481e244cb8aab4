//! \file
//! The diagram seen cell by cell: boundary loops and neighbours.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/diagram/diagram.h"

namespace agvd {

//! A directed edge of the complex with the cell on its left.
struct DirectedEdge {
    Index edge = no_index;  //!< Of Diagram::edges.
    bool reversed = false;  //!< True: walked from head to tail.
};

//! Cell s has the loops [cell_loops[s], cell_loops[s + 1]); loop l has the directed edges
//! [loop_edges[l], loop_edges[l + 1]) of `edges`, head to tail, the cell on their left. A cell that
//! covers a whole closed component has no loop.
struct Cells {
    std::vector<Index> cell_loops;         //!< #sites + 1 offsets into loops.
    std::vector<Index> loop_edges;         //!< #loops + 1 offsets into edges.
    std::vector<DirectedEdge> edges;       //!< Loop by loop.
    std::vector<Index> neighbour_offsets;  //!< #sites + 1 offsets into neighbours.
    std::vector<SiteId> neighbours;        //!< Ascending, without repetition.
};

//! Cost: O(size of the complex).
[[nodiscard]] Cells build_cells(const Diagram& diagram, Ticker ticker = {});

}  // namespace agvd
