//! \file
//! Corners of the boundary, and sites along it.
#pragma once

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "remesh/curves/curve_sites.h"

namespace remesh {

//! Applies corners_of_curve to a loop of boundary_loops.
//! \param spacing  > 0, mesh units.
//! \return vertices, in the loop's order.
[[nodiscard]] std::vector<Index> find_corners(const Surface& surface,
                                              const std::vector<Index>& loop, double spacing);

//! Sites on a loop, at least three: at its corners, and at equal distances of about a spacing along
//! each curve between them.
//! \param corners  vertices of the loop, in its order.
//! \param unit_at  the unit of distances and spacing; empty: mesh units.
[[nodiscard]] std::vector<SurfacePoint> sample_loop(const Surface& surface,
                                                    const std::vector<Index>& loop,
                                                    const std::vector<Index>& corners,
                                                    double spacing, const UnitAt& unit_at = {});

}  // namespace remesh
