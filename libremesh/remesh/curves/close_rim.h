//! \file
//! The rim of a set of triangles, and triangles between it and the curves that bound a patch.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

using DirectedEdge = std::pair<Index, Index>;  //!< From, to.

//! The sides without a triangle on their right, ascending. Their own triangle lies on their left.
//! Cost: O(n log n).
[[nodiscard]] std::vector<DirectedEdge> rim_of(std::span<const Triangle> triangles);

//! Fills gaps between chain and rim with triangles, without a change of topology. There are two
//! kinds. If the cell of an inner site meets a curve, no triangle joins the two sites of the curve
//! next to it, and the rim passes through the inner site. If the cell of a site on the curve has no
//! Voronoi vertex (at a sharp corner), the site has no triangle, and the rim bypasses it.
//!
//! \param chain  edges that the rim is to have.
//! Cost: O(n log n).
void close_rim(std::span<const DirectedEdge> chain, std::vector<Triangle>& triangles);

}  // namespace remesh
