//! \file
//! Improves the worst triangles by moving vertices along the surface.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "remesh/placement/placed_mesh.h"
#include "remesh/sites/cell_measures.h"
#include "remesh/sites/prepared_surface.h"

namespace remesh {

//! Moves the corners of triangles of low quality or with a small angle along the surface in small
//! steps; their offsets stay. A step is taken if the worst triangle around the vertex gains more
//! than it costs to leave the planes of the surface nearby, so that vertices at a crease stay
//! there. All other vertices and those on the boundary stay. No triangle turns over.
//!
//! \param nearest_vertex  per vertex of surface.base: the vertex of the mesh in whose cell it lies;
//!                        no_index: none.
//! \param num_threads     >= 0; 0: all cores. The result is the same for any number.
//! \param sizes  target lengths of the edges; null: all are equal.
//! \throw Cancelled  the progress callback returned false; `mesh` is unspecified then.
//! Cost: O(#surface + #triangles), and about 20 us for each vertex at such a triangle.
void improve_shape(const PreparedSurface& surface, std::span<const Index> nearest_vertex,
                   PlacedMesh& mesh, int num_threads = 0, const Progress& progress = {},
                   const SizeField* sizes = nullptr);

//! The planes of the surface in the cell of each vertex: what improve_shape() reads of the pieces.
//! They are smaller than these.
//! Cost: O(#surface).
[[nodiscard]] std::vector<detail::CellPlanes> planes_of_cells(const PreparedSurface& surface,
                                                              std::span<const Index> nearest_vertex,
                                                              Index num_vertices,
                                                              int num_threads = 0,
                                                              const Progress& progress = {});

//! The same as improve_shape() above, with these planes.
//! \param input  PreparedSurface::input().
//! \param stays  #V of the mesh: 1 for vertices that stay; or empty.
void improve_shape(const Surface& input, std::span<const detail::CellPlanes> planes,
                   PlacedMesh& mesh, const Progress& progress = {},
                   const SizeField* sizes = nullptr, std::span<const std::uint8_t> stays = {});

}  // namespace remesh
