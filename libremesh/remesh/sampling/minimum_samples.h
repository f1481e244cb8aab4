//! \file
//! How few vertices a surface can have.
#pragma once

#include "agvd/core/types.h"

namespace remesh {

//! No simplicial surface of this genus and number of boundary loops has fewer vertices: 4 for the
//! sphere, 7 for the torus, 3 for the disc, 6 for the open tube. Reached by every closed surface
//! ([jungerman1980]); a bound by counting edges for those with boundary.
//!
//! \param genus, boundary_loops  >= 0, of one connected component.
[[nodiscard]] agvd::Index minimum_samples(int genus, int boundary_loops);

}  // namespace remesh
