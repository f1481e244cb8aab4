//! \file
//! Better worst triangles.
#pragma once

#include "agvd/mesh/surface.h"
#include "remesh/placement/placed_mesh.h"

namespace remesh {

//! Moves the corners of triangles of low quality along the surface (their offsets stay), a little
//! at a time, as long as the worst triangle around the vertex gets better. All other vertices and
//! those on the boundary stay. No triangle turns over.
//! Cost: O(#triangles), and about 20 us for each vertex at such a triangle.
void improve_shape(const agvd::Surface& surface, PlacedMesh& mesh);

}  // namespace remesh
