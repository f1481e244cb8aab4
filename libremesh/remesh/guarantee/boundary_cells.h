//! \file
//! Which sites have to move onto the boundary so that the dual keeps it.
#pragma once

#include <span>

#include "agvd/diagram/diagram.h"

namespace remesh {

//! Moves and new sites after which fewer cells meet the boundary from inside.
struct BoundaryFixes {
    std::vector<std::pair<agvd::Index, agvd::SurfacePoint>> moved;  //!< Site and place, ascending.
    std::vector<agvd::SurfacePoint> added;
};

//! The boundary's vertices in the dual are the sites of the cells that meet it. So that they lie on
//! it, a site inside whose cell meets the boundary moves to the middle of its longest arc there. So
//! that corners stay, the site nearest to a corner moves to it, or, if it is at another corner, a
//! new site is placed there. Nothing to do: both are empty.
//!
//! Each move makes a boundary site of an inner one or fills a corner, and neither is undone.
//! \param corners  boundary vertices.
//! Cost: O(size of the complex + #sites).
[[nodiscard]] BoundaryFixes find_boundary_fixes(const agvd::Surface& surface,
                                                const agvd::Diagram& diagram,
                                                std::span<const agvd::SurfacePoint> sites,
                                                std::span<const agvd::Index> corners);

}  // namespace remesh
