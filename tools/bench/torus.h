//! \file
//! A generated mesh of any size.
#pragma once

#include "agvd/mesh/mesh.h"

namespace bench {

//! A torus of bumps: 2 k x k rectangles cut in two, for the largest k with at most `max_faces`
//! faces. Radii 1 and 0.4, bumps of a tenth of the latter.
//! \throw agvd::InvalidOption  max_faces < 36: then k is below 3.
[[nodiscard]] agvd::TriangleMesh bumpy_torus(agvd::Index max_faces);

}  // namespace bench
