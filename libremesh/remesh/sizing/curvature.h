//! \file
//! How much a surface is curved, at the scale of its patches.
#pragma once

#include <vector>

#include "agvd/core/progress.h"
#include "agvd/intrinsic/face_pieces.h"
#include "agvd/propagation/surface_layout.h"

namespace remesh {

//! The root mean square of the two principal curvatures, averaged over patches: the standard
//! deviation of the normals over that of the positions. The surface is divided into cells around
//! evenly spread random points; a patch is a cell with those next to it. The result depends on the
//! surface, not on its triangles. Patches end at the boundary: cut creases first.
//!
//! \param pieces, layout  of `base`.
//! \param num_cells       >= 1.
//! \return #V of base.surface(): 1 / mesh units, >= 0. The same for any number of threads.
//! \throw agvd::Cancelled  the progress callback returned false.
//! Cost: O(n), two sweeps over the edges.
[[nodiscard]] std::vector<double> patch_curvature(const agvd::IntrinsicTriangulation& base,
                                                  const agvd::FacePieces& pieces,
                                                  const agvd::SurfaceLayout& layout,
                                                  agvd::Index num_cells, int num_threads = 0,
                                                  const agvd::Progress& progress = {});

}  // namespace remesh
