//! \file
//! Dihedral angles that are robust against needles.
#pragma once

#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh::detail {

//! The angle between the normals on both sides of each edge, radians in [0, pi]; 0 on the boundary.
//!
//! A face lower than `thin` has no reliable normal, as rounding of its corners turns it. It is
//! joined with the neighbour that fits it best until the patch is not thin. All edges of the patch
//! get the normal of its vector area. That is the vector area of the patch's outline, so the noise
//! of the faces inside cancels. Edges inside a patch get 0.
//!
//! \param thin  mesh units, >= 0: least height over the longest side.
//! \return #E.
//! Cost: O(#F + k log k), k = thin faces.
[[nodiscard]] std::vector<double> edge_angles(const Surface& surface, double thin, int num_threads,
                                              Poller& poller);

}  // namespace remesh::detail
