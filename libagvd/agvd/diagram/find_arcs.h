//! \file
//! Traces arcs of bisectors inside the mixed faces, between the label changes on their edges.
#pragma once

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/face_arcs.h"
#include "agvd/diagram/stage_input.h"

namespace agvd {

//! Finds the arcs of mixed faces. Most faces have two or three label changes, and their own relays
//! suffice. Where these contradict the labels on the edges or each other, the relays that are the
//! nearest on the edges are used instead.
//! \param out  replaced, face after face; its memory is used again.
void find_arcs(const StageInput& input, const EdgeLabels& labels, std::span<const Index> mixed,
               FaceArcs& out);

}  // namespace agvd
