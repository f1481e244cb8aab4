//! \file
//! Traces faces into the store of arcs.
#pragma once

#include "agvd/diagram/diagram_parts.h"
#include "agvd/diagram/stage_input.h"

namespace agvd {

//! Gives mixed faces their arcs, which are not joined yet.
//! \param mixed   faces that have no arcs.
//! Parallel.
void trace_faces(const StageInput& input, std::span<const Index> mixed, DiagramParts& parts);

//! Takes the arcs of a face away, if it has any, and the edges through them apart.
void remove_arcs(Index face, DiagramParts& parts);

}  // namespace agvd
