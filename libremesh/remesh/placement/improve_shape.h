//! \file
//! Better worst triangles.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "remesh/placement/placed_mesh.h"
#include "remesh/relax/prepared_surface.h"

namespace remesh {

//! Moves the corners of triangles of low quality or with a small angle along the surface (their
//! offsets stay), a little at a time, as long as the worst triangle around the vertex gets better
//! by more than it costs to leave the planes of the surface nearby: so vertices at a crease stay at
//! it. All other vertices and those on the boundary stay. No triangle turns over.
//!
//! \param nearest_vertex  per vertex of surface.base: that of the mesh in whose cell it lies;
//!                        agvd::no_index: none.
//! \param num_threads     >= 0; 0: all cores. The result is the same for any number.
//! \throw agvd::Cancelled  the progress callback returned false; `mesh` is of no use then.
//! Cost: O(#surface + #triangles), and about 20 us for each vertex at such a triangle.
void improve_shape(const PreparedSurface& surface, std::span<const agvd::Index> nearest_vertex,
                   PlacedMesh& mesh, int num_threads = 0, const agvd::Progress& progress = {});

}  // namespace remesh
