//! \file
//! Diagrams that are built once and updated again and again.
#pragma once

#include <optional>

#include "agvd/diagram/diagram.h"
#include "agvd/diagram/stage_input.h"
#include "agvd/update/kept_diagram.h"

namespace agvd {

//! Builds `diagram` as build_diagram() does.
//! \throw Cancelled  `diagram` is as it was.
[[nodiscard]] KeptDiagram build_kept_diagram(const StageInput& input, Diagram& diagram);

//! Makes `diagram` that of these sites, byte for byte as build_diagram() would.
//! \param changed_faces  those whose relays, or the distances of whose corners, have changed since
//!                       the last call.
//! \param kept           of the last call.
//! \param diagram        as the last call left it.
//! \throw Cancelled  `diagram` is as it was; `kept` is of no use any more.
void update_diagram(const StageInput& input, std::span<const Index> changed_faces,
                    KeptDiagram& kept, Diagram& diagram);

}  // namespace agvd
