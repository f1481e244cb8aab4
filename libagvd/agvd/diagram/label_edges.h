//! \file
//! Labels the mesh edges.
#pragma once

#include "agvd/diagram/diagram_parts.h"
#include "agvd/diagram/stage_input.h"

namespace agvd {

//! Whether an edge may have label changes: all of its faces are mixed. One half-edge says so for
//! the edge, the one with the lower index.
[[nodiscard]] bool is_labelled(const Surface& surface, const EdgeLabels& labels, Index half_edge);

//! The label changes on some edges, before they are stored.
struct FoundRows {
    struct Row {
        Index edge;
        Block crossings;  //!< Not empty.
    };
    std::vector<Row> rows;  //!< In the order of the half-edges; none for an edge of one label.
    std::vector<Crossing> crossings;

    [[nodiscard]] std::span<const Crossing> of(const Row& row) const {
        return std::span(crossings).subspan(row.crossings.begin, row.crossings.count);
    }
};

//! Finds the lower envelope along edges of the relays of both sides and of the edge's ends.
//! \param half_edges  is_labelled().
//! \return chunk after chunk of the half-edges.
//! Parallel. Cost: O(relays) an edge, O(relays) and a few square roots a crossing.
[[nodiscard]] std::vector<FoundRows> find_rows(const StageInput& input,
                                               std::span<const Index> half_edges,
                                               const EdgeLabels& labels);

//! Stores the label changes on all edges, none of which has any so far.
void label_edges(const StageInput& input, DiagramParts& parts);

}  // namespace agvd
