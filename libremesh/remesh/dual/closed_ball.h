//! \file
//! The closed-ball property: when it holds, the dual is homeomorphic to the surface.
#pragma once

#include "agvd/diagram/cells.h"
#include "remesh/dual/build_dual.h"

namespace remesh {

//! One violation of the property, and points at which more sites help.
struct ClosedBallViolation {
    SiteId site;   //!< The cell.
    SiteId other;  //!< The second cell, if there are two.
    SiteReason reason = SiteReason::NoDisc;
    std::vector<SurfacePoint> remedies;  //!< Where to add sites.
    bool is_at_boundary = false;         //!< A cell meets the boundary twice, as in narrow strips.
};

//! Finds all violations of these conditions ([edelsbrunner1997]). Each cell is a disc with one
//! loop. Two cells meet in nothing or in one arc. No two Voronoi vertices have the same three
//! cells. A cell meets the boundary in nothing or in one arc. No single arc cuts the surface apart.
//! Degenerate Voronoi edges count as points.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(#V + size of the complex) and a sort.
[[nodiscard]] std::vector<ClosedBallViolation> find_closed_ball_violations(
    const Surface& surface, const Diagram& diagram, const Progress& progress = {});

}  // namespace remesh
