//! \file
//! Moves vertices off the surface so that the mesh lies nearer to it.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "remesh/placement/placed_mesh.h"
#include "remesh/sites/prepared_surface.h"

namespace remesh {

//! Moves vertices so that the triangles, not their corners, lie as near to the surface as possible.
//! Least squares of the distances of the surface's vertices (if they are few, also of points inside
//! faces) from the planes of their triangles, and of vertices and middles of triangles from the
//! surface. Planes do not restrict moves along them: there a vertex is drawn to where its triangles
//! are equilateral. Where planes meet at an angle the vertex slides to their edge. Vertices on the
//! boundary and those marked in `stays` stay, and no triangle turns over.
//!
//! \param nearest_vertex  per vertex of surface.base: the vertex of the mesh in whose cell it lies;
//!                        no_index: none.
//! \param num_threads     >= 0; 0: all cores. The result is the same for any number.
//! \param least_way       >= 0, mesh units: distances up to this between mesh and surface are
//!                        rounding, without a direction. Above 0 planar parts stay planar.
//! \throw Cancelled  the progress callback returned false; `mesh` is unspecified then.
//! Cost: O(#base + #mesh), about 2 us for each vertex of the base.
void fit_vertices(const PreparedSurface& surface, std::span<const Index> nearest_vertex,
                  PlacedMesh& mesh, int num_threads = 0, const Progress& progress = {},
                  double least_way = 0);

//! A point of the surface and the area that it stands for.
struct CellSample {
    Vec3 position;
    double area;
    Index vertex;               //!< Of the mesh: in whose cell it lies.
    Index triangle = no_index;  //!< Set by fit_vertices(): the nearest.
};

//! The points by which fit_vertices() measures distances: all that it reads of the pieces.
//! Cost: O(#base).
[[nodiscard]] std::vector<CellSample> sample_cells(const PreparedSurface& surface,
                                                   std::span<const Index> nearest_vertex,
                                                   Index num_vertices,
                                                   const Progress& progress = {});

//! The same as fit_vertices() above, with these points.
//! \param stays  #V of the mesh: 1 for vertices that stay; or empty.
void fit_vertices(const IntrinsicTriangulation& base, std::span<const Index> nearest_vertex,
                  std::vector<CellSample> samples, PlacedMesh& mesh, int num_threads = 0,
                  const Progress& progress = {}, double least_way = 0,
                  std::span<const std::uint8_t> stays = {});

}  // namespace remesh
