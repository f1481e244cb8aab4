//! \file
//! The closed-ball property: when it holds, the dual is homeomorphic to the surface.
#pragma once

#include <string>

#include "agvd/diagram/cells.h"

namespace remesh {

//! One way in which a cell breaks the property, and a point where one more site helps.
struct ClosedBallViolation {
    agvd::SiteId site;           //!< The cell named.
    const char* reason = "";     //!< A fixed text: "is not a disc", "meets a neighbour twice", ...
    agvd::SurfacePoint remedy;   //!< Where to add a site.
};

//! All violations, by cell: every cell is a disc; two cells meet in nothing or one arc; a cell meets
//! the boundary in nothing or one arc ([edelsbrunner1997]).
//! Cost: O(size of the complex) and a sort.
[[nodiscard]] std::vector<ClosedBallViolation> find_closed_ball_violations(
    const agvd::Surface& surface, std::span<const agvd::SurfacePoint> sites,
    const agvd::Diagram& diagram, const agvd::Cells& cells);

}  // namespace remesh
