//! \file
//! The boundary's corners, and sites along it.
#pragma once

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace remesh {

//! Vertices of a loop (of agvd::boundary_loops) where it turns by more than 45 degrees: at the
//! vertex itself, and between the chords to the points half a spacing before and after it, so that
//! a rough curve has no corners that sites at this spacing could not follow. Of several within half
//! a spacing the sharpest. \param spacing  > 0, mesh units. \return vertices, in the loop's order.
//! Cost: O(k log k + k c), c = corners.
[[nodiscard]] std::vector<agvd::Index> find_corners(const agvd::Surface& surface,
                                                    const std::vector<agvd::Index>& loop,
                                                    double spacing);

//! Sites on a loop: at its corners, and at equal distances of about a spacing along each curve
//! between them, but at least three.
//! \param corners  vertices of the loop, in its order.
[[nodiscard]] std::vector<agvd::SurfacePoint> sample_loop(const agvd::Surface& surface,
                                                          const std::vector<agvd::Index>& loop,
                                                          const std::vector<agvd::Index>& corners,
                                                          double spacing);

}  // namespace remesh
