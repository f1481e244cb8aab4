//! \file
//! Points of a surface made vertices of it. Private to intrinsic.
#pragma once

#include <span>
#include <vector>

#include "agvd/intrinsic/face_charts.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd::detail {

//! Inserts points one by one: those in a face cut it into three, those on an edge cut the faces
//! beside it into two, and at a vertex that no earlier point has claimed nothing is cut. A point
//! closer to an edge or a vertex than 1e-9 of a face is taken to lie there; if the vertex there is
//! another point's, it is moved by that much.
//! \param surface  simplicial; stays so. Its faces lie in the plane as they did at first.
//! \return by point: its vertex. Cost: O(log n) for each point in practice.
[[nodiscard]] std::vector<Index> insert_points(Surface& surface, FaceCharts& charts,
                                               std::span<const SurfacePoint> points);

}  // namespace agvd::detail
