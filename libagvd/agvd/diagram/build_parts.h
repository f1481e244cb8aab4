//! \file
//! All stages of a diagram but drawing.
#pragma once

#include "agvd/diagram/diagram_parts.h"
#include "agvd/diagram/stage_input.h"

namespace agvd {

//! Labels vertices and edges, traces the arcs in the faces and joins them. Cells may still
//! have parts that are not connected to their site: see absorb_islands.h.
//! \throw Cancelled  the progress callback returned false.
[[nodiscard]] DiagramParts build_parts(const StageInput& input);

}  // namespace agvd
