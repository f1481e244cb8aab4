//! \file
//! Moves sites onto the boundary so that the dual keeps it.
#pragma once

#include <span>

#include "agvd/diagram/diagram.h"
#include "remesh/names.h"

namespace remesh {

//! Moves and new sites. After these fewer cells of inner sites meet the boundary.
struct BoundaryFixes {
    std::vector<std::pair<Index, SurfacePoint>> moved;  //!< Site and place, ascending.
    std::vector<SurfacePoint> added;
};

//! The boundary vertices of the dual are the sites whose cells meet the boundary. They must lie on
//! it: an inner site whose cell meets the boundary moves to the middle of its longest arc there.
//! Corners must stay: the site nearest to a corner moves to it; if that site is at another corner,
//! a new site is placed at this one. Both lists are empty if nothing is to be done.
//!
//! Each move turns an inner site into a boundary site or fills a corner, and neither is undone.
//! \param corners  boundary vertices.
//! Cost: O(size of the complex + #sites).
[[nodiscard]] BoundaryFixes find_boundary_fixes(const Surface& surface, const Diagram& diagram,
                                                std::span<const SurfacePoint> sites,
                                                std::span<const Index> corners);

}  // namespace remesh
