//! \file
//! Removes vertices of a triangulation. Private to intrinsic.
#pragma once

#include <vector>

#include "agvd/intrinsic/face_charts.h"
#include "agvd/mesh/surface.h"

namespace agvd::detail {

//! Removes every vertex whose number is no_index, the flattest first, and keeps the rest Delaunay.
//! A vertex stays where the complex would not stay simplicial without it. See
//! thin().
//! \param surface  simplicial; left with gaps.
//! \return the number of flips.
std::size_t remove_vertices(Surface& surface, FaceCharts& charts, const std::vector<Index>& number);

}  // namespace agvd::detail
