//! \file
//! Puts the vertices of curves where the chain between them lies nearest to the curve.
#pragma once

#include "remesh/features/curve_sites.h"
#include "remesh/sampling/sample_sites.h"

namespace remesh {

//! Least squares along each crease: of the distance between the points of the curve and those of
//! the chain that lie as far along. Nodes stay, and junctions and kept boundaries, whose vertices
//! are to lie on them.
//!
//! \param surface  that of the network, whole or cut.
//! \return #groups: from the site to where its vertex fits best.
//! Cost: O(vertices of the curves + groups).
[[nodiscard]] std::vector<agvd::Vec3> fit_curves(const agvd::Surface& surface,
                                                 const CurveNetwork& network,
                                                 const CurveSites& sites,
                                                 Boundary boundary = Boundary::Keep);

}  // namespace remesh
