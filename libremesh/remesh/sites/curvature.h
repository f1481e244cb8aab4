//! \file
//! How much a surface is curved, at the scale of its patches.
#pragma once

#include <vector>

#include "agvd/core/progress.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "remesh/names.h"

namespace remesh {

//! The root mean square of the two principal curvatures, averaged over patches: the standard
//! deviation of the normals over that of the positions. The surface is divided into cells around
//! evenly spread random vertices; a patch is a cell with those next to it. The result depends on
//! the surface, not on its triangles. Patches end at the boundary: cut creases first.
//!
//! \param num_cells  >= 1; there are no more than vertices of the base.
//! \return #V of base.surface(): 1 / mesh units, >= 0.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n).
[[nodiscard]] std::vector<double> patch_curvature(const IntrinsicTriangulation& base,
                                                  Index num_cells, Ticker& ticker);

}  // namespace remesh
