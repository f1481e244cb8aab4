//! \file
//! Moves the vertices of curves so that the chain between them lies nearest to the curve.
#pragma once

#include "remesh/curves/curve_sites.h"
#include "remesh/sites/sample_sites.h"

namespace remesh {

//! Least squares along each crease of the distances between points of the curve and of the chain at
//! the same arc length. Nodes stay, and so do the vertices of junctions and kept boundaries.
//!
//! \param surface  that of the network, whole or cut.
//! \return #groups: from each site to the best position of its vertex.
//! Cost: O(vertices of the curves + groups).
[[nodiscard]] std::vector<Vec3> fit_curves(const Surface& surface, const CurveNetwork& network,
                                           const CurveSites& sites,
                                           Boundary boundary = Boundary::Keep);

}  // namespace remesh
