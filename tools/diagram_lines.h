//! \file
//! The arcs of a diagram as polylines with their conics.
#pragma once

#include "agvd/diagram/diagram.h"
#include "remesh/meshfile/lines_file.h"

namespace cli {

//! A polyline for each arc, through the diagram's points on it. Values of points: the distance from
//! their sites; of lines: `edge`, `site_left`, `site_right`, `face`, `kind` (as ArcKind counts),
//! and for both sites `focus_..._x`, `_y`, `_z` in space, in the plane of the face, and
//! `weight_...`.
//! \param diagram  with arcs, on the surface.
[[nodiscard]] remesh::Lines arc_lines(const agvd::Surface& surface, const agvd::Diagram& diagram);

}  // namespace cli
