//! \file
//! How much a surface is curved, at the scale of its patches.
#pragma once

#include <vector>

#include "agvd/core/progress.h"
#include "agvd/intrinsic/face_pieces.h"
#include "agvd/propagation/surface_layout.h"

namespace remesh {

//! The largest principal curvature. The surface is divided into patches around evenly spread random
//! points. In each patch and those next to it, normals n are fitted by a linear function of the
//! position x: n = M x + c. The largest eigenvalue of M, by its size, is the curvature; it depends
//! on the surface, not on its triangles, and noise finer than a patch cancels out.
//!
//! Patches do not cross the boundary: cut creases first.
//! \param pieces, layout  of `base`.
//! \param num_patches     >= 1.
//! \return #V of base.surface(): 1 / mesh units, >= 0. The same for any number of threads.
//! \throw agvd::Cancelled  the progress callback returned false.
//! Cost: O(n), two sweeps over the edges.
[[nodiscard]] std::vector<double> largest_curvature(const agvd::IntrinsicTriangulation& base,
                                                    const agvd::FacePieces& pieces,
                                                    const agvd::SurfaceLayout& layout,
                                                    agvd::Index num_patches, int num_threads = 0,
                                                    const agvd::Progress& progress = {});

}  // namespace remesh
