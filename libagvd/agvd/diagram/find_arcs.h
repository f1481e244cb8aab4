//! \file
//! Second half of the diagram: the arcs inside the mixed faces, between the label changes on edges.
#pragma once

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/face_arcs.h"
#include "agvd/diagram/relay_groups.h"
#include "agvd/diagram/stage_input.h"

namespace agvd {

//! Finds the arcs of mixed faces. Most faces have two or three label changes, and there the face's
//! own relays settle all; where they do not agree with each other, what the edges hand on does.
//! \param out  replaced, face after face; its memory is used again.
void find_arcs(const StageInput& input, const RelayGroups& groups, const EdgeLabels& labels,
               std::span<const Index> mixed, FaceArcs& out);

}  // namespace agvd
