//! \file
//! Dihedral angles that needles do not falsify.
#pragma once

#include <vector>

#include "agvd/core/poller.h"
#include "agvd/mesh/surface.h"

namespace remesh::detail {

//! The angle between the normals on both sides of each edge, radians in [0, pi]; 0 on the boundary.
//!
//! A face lower than `thin` has no direction of its own: rounding of its corners turns it anyhow.
//! It is put together with the neighbour that suits it best until their sum is not thin, and all
//! edges between them get the sum's normal: the vector area of a patch is that of its outline, so
//! that the noise of faces inside cancels. Edges inside a patch get 0.
//!
//! \param thin  mesh units, >= 0: least height over the longest side.
//! \return #E.
//! Cost: O(#F + k log k), k = thin faces.
[[nodiscard]] std::vector<double> edge_angles(const agvd::Surface& surface, double thin,
                                              int num_threads, agvd::Poller& poller);

}  // namespace remesh::detail
