//! \file
//! Cuts polygons into triangles.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "remesh/names.h"

namespace remesh {

//! Appends the corners.size() - 2 triangles of one polygon, oriented like it.
//!
//! A quad is cut along the shorter of the diagonals that lie inside; a larger polygon by clipping
//! ears (Meisters 1975) in the projection along its normal. A polygon that has no ear left (it
//! crosses itself, or has no area) is finished as a fan: no triangulation is correct.
//!
//! \param polygon    at least three indices into positions, which may repeat.
//! Cost: O(k log k) for k corners, typically; O(1) for k <= 4.
void append_triangles(std::span<const Index> polygon, std::span<const Vec3> positions,
                      Ticker& ticker, std::vector<Triangle>& triangles);

}  // namespace remesh
