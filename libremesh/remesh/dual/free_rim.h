//! \file
//! Removes extra vertices on the boundary of a thinned patch.
#pragma once

#include "agvd/intrinsic/simplify.h"
#include "remesh/names.h"

namespace remesh {

//! Removes extra vertices on the boundary as far as topology allows. A vertex often stays because
//! an inner edge joins its two neighbours on the boundary: then this edge is flipped first.
//!
//! \param points  those that the patch was thinned to.
//! Cost: O(n log n) for each extra vertex on the boundary.
void free_rim(const Surface& surface, std::span<const SurfacePoint> points, SimplifiedMesh& patch);

}  // namespace remesh
