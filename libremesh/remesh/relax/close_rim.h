//! \file
//! Triangles between a triangulation of sites and the curves that bound it.
#pragma once

#include <span>
#include <vector>

#include "remesh/features/curve_sites.h"

namespace remesh::detail {

//! Where an inner site's cell meets a curve, no triangle joins the sites of the curve beside it: the
//! rim of the triangulation goes through the inner site. Fills the gap between the edge of the
//! chain and the rim.
//!
//! \param chain  edges that are to be on the rim.
//! \return edges of the chain that are still not on it: sites there are in no triangle.
//! Cost: O(n log n).
agvd::Index close_rim(std::span<const ChainEdge> chain, std::vector<agvd::Triangle>& triangles);

}  // namespace remesh::detail
