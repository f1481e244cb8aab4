//! \file
//! Vertices off the surface, for a mesh that lies nearer to it.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "remesh/placement/placed_mesh.h"
#include "remesh/relax/prepared_surface.h"

namespace remesh {

//! Moves vertices so that the triangles, not their corners, lie as near to the surface as they can:
//! least squares of the distances of the surface's vertices (where there are few, of points inside
//! faces too) from the planes of their triangles, and of vertices and middles of triangles from the
//! surface. Planes say nothing of moves along them: there a vertex is drawn to where its triangles
//! are equilateral, but slides to the edge where planes meet at an angle. Vertices on the boundary
//! stay, and no triangle turns over.
//!
//! \param nearest_vertex  per vertex of surface.base: that of the mesh in whose cell it lies;
//!                        agvd::no_index: none.
//! \param num_threads     >= 0; 0: all cores. The result is the same for any number.
//! \param least_way       >= 0, mesh units: no longer ways between mesh and surface are rounding,
//!                        whose direction says nothing. Above 0 what is flat stays flat.
//! \throw agvd::Cancelled  the progress callback returned false; `mesh` is of no use then.
//! Cost: O(#base + #mesh), about 2 us for each vertex of the base.
void fit_vertices(const PreparedSurface& surface, std::span<const agvd::Index> nearest_vertex,
                  PlacedMesh& mesh, int num_threads = 0, const agvd::Progress& progress = {},
                  double least_way = 0);

}  // namespace remesh
