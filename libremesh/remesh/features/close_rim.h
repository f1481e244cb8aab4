//! \file
//! Where triangles end, and triangles between that and the curves that bound a patch.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "agvd/core/types.h"

namespace remesh {

using DirectedEdge = std::pair<agvd::Index, agvd::Index>;  //!< From, to.

//! The sides of triangles without another one on the other side, ascending: triangles lie on their
//! left. Cost: O(n log n).
[[nodiscard]] std::vector<DirectedEdge> rim_of(std::span<const agvd::Triangle> triangles);

//! Fills gaps between chain and rim with triangles, which changes no topology. There are two kinds:
//! where the cell of an inner site meets a curve, no triangle joins the sites of the curve beside
//! it, and the rim goes through the inner site; where the cell of a site on the curve has no
//! Voronoi vertex (at a sharp corner), the site has no triangle, and the rim goes past it.
//!
//! \param chain  edges that are to be on the rim.
//! Cost: O(n log n).
void close_rim(std::span<const DirectedEdge> chain, std::vector<agvd::Triangle>& triangles);

}  // namespace remesh
