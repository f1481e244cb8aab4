//! \file
//! The closed-ball property: when it holds, the dual is homeomorphic to the surface.
#pragma once

#include "agvd/diagram/cells.h"
#include "remesh/guarantee/site_reason.h"

namespace remesh {

//! One way in which cells break the property, and points where more sites help.
struct ClosedBallViolation {
    agvd::SiteId site;   //!< The cell named.
    agvd::SiteId other;  //!< The second cell, if two are concerned.
    SiteReason reason = SiteReason::NoDisc;
    std::vector<agvd::SurfacePoint> remedies;  //!< Where to add sites.
    bool is_at_boundary = false;  //!< A cell that meets the boundary twice, as in narrow strips.
};

//! All violations: every cell is a disc with one loop; two cells meet in nothing or one arc, and no
//! two Voronoi vertices have the same three cells; a cell meets the boundary in nothing or one arc,
//! and no single arc cuts the surface apart ([edelsbrunner1997]). Degenerate Voronoi edges count as
//! points.
//! \throw agvd::Cancelled  the progress callback returned false.
//! Cost: O(#V + size of the complex) and a sort.
[[nodiscard]] std::vector<ClosedBallViolation> find_closed_ball_violations(
    const agvd::Surface& surface, const agvd::Diagram& diagram,
    const agvd::Progress& progress = {});

}  // namespace remesh
