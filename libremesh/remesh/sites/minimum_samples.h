//! \file
//! The least number of vertices of a surface.
#pragma once

#include "agvd/core/types.h"
#include "agvd/mesh/topology.h"
#include "remesh/names.h"

namespace remesh {

//! No simplicial surface of this genus and number of boundary loops has fewer vertices: 4 for the
//! sphere, 7 for the torus, 3 for the disc, 6 for the open tube. Every closed surface can be built
//! with this number ([jungerman1980]). For surfaces with boundary it is a lower bound from counting
//! edges.
//!
//! \param genus, boundary_loops  >= 0, of one connected component.
[[nodiscard]] Index minimum_samples(int genus, int boundary_loops);

//! The same for all components together. Cost: O(#components).
[[nodiscard]] Index minimum_samples(const Topology& topology);

}  // namespace remesh
