//! \file
//! Better triangles in flat parts, from which long slivers go before they are split.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh_view.h"

namespace remesh {

//! Flips edges between coplanar triangles until all are Delaunay whose two triangles have an edge
//! longer than max_length (of four corners on a circle, the shorter diagonal): fans and strips of
//! slivers, as CAD programs export them, would be split into many times more faces, and geodesic
//! distances take long to pass them. The surface stays where it is, up to 1e-6 of max_length; so
//! does every vertex, and a face keeps its number.
//!
//! \param mesh        manifold, oriented.
//! \param max_length  > 0, mesh units.
//! \return the number of flips.
//! Cost: O(n log n) without long edges, else that of Lawson's flips, of which there are 64 an edge
//! at most.
//! \throw agvd::Cancelled  the progress callback returned false; the mesh is as it was.
agvd::Index flip_flat_edges(agvd::TriangleMesh& mesh, double max_length,
                            const agvd::Progress& progress = {});

}  // namespace remesh
