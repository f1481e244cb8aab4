//! \file
//! Inserts points of a surface as vertices. Private to intrinsic.
#pragma once

#include <span>
#include <vector>

#include "agvd/intrinsic/face_charts.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd::detail {

//! Inserts points one by one. A point in a face cuts the face into three. A point on an edge cuts
//! the faces beside it into two. At a vertex that has no earlier point nothing is cut. A point
//! closer to an edge or a vertex than 1e-9 of a face is taken to lie there; if the vertex there is
//! another point's, it is moved by that much.
//! \param surface  simplicial; stays so.
//! \return by point: its vertex. Cost: O(log n) for each point in practice.
[[nodiscard]] std::vector<Index> insert_points(Surface& surface, FaceCharts& charts,
                                               std::span<const SurfacePoint> points);

}  // namespace agvd::detail
