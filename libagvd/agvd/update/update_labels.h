//! \file
//! Labels the vertices and edges that a change touches.
#pragma once

#include "agvd/diagram/label_edges.h"
#include "agvd/update/kept_diagram.h"
#include "agvd/update/touched_parts.h"

namespace agvd {

//! Gives the vertices that islands relabelled their own labels again.
//! \return these vertices.
std::vector<Index> restore_labels(const Surface& surface, KeptDiagram& kept);

//! Lists the mixed faces and labels the touched vertices. Clears those in `touched` that have the
//! labels and distances that they had.
void update_vertices(const StageInput& input, TouchedParts& touched, DiagramParts& parts);

//! Replaces the labels on the edges on which they need not hold, and settles these in `touched`.
//! \param faces   faces_with_stale_edges().
void update_edges(const StageInput& input, std::span<const Index> faces, TouchedParts& touched,
                  DiagramParts& parts);

//! Ascending: the mixed faces that have edges on which labels need not hold.
[[nodiscard]] std::vector<Index> faces_with_stale_edges(const TouchedParts& touched,
                                                        const EdgeLabels& labels);

}  // namespace agvd
