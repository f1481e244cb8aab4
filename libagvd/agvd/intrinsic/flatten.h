//! \file
//! The angle around a vertex, and lengths scaled to make it flat. Private to intrinsic.
#pragma once

#include "agvd/intrinsic/face_charts.h"
#include "agvd/mesh/surface.h"

namespace agvd::detail {

//! The sum of the corners at a vertex, radians.
[[nodiscard]] double cone_angle(const Surface& surface, Index vertex);

//! Scales the edges at a vertex by one factor so that the cone angle is `target`: the conformal map
//! that moves its curvature to its neighbours ([springborn2008]; [liu2023] Sec. 3.3).
//! \param target  2 pi; pi on the boundary.
//! \return false if no factor leaves all faces there triangles; then nothing has changed.
//! The vertex must have no edge to itself. Cost: O(edges there).
[[nodiscard]] bool flatten(Surface& surface, FaceCharts& charts, Index vertex, double target);

}  // namespace agvd::detail
