//! \file
//! The dual of the diagram: a vertex per cell, a triangle per Voronoi vertex.
#pragma once

#include "agvd/diagram/diagram.h"
#include "remesh/names.h"

namespace remesh {

//! Triangles of site indices, oriented like the surface. A Voronoi vertex of degree k > 3 (or
//! several joined by degenerate Voronoi edges) gives a k-gon, triangulated with diagonals that
//! repeat no edge if possible. Sites without a cell, and cells without a Voronoi vertex, occur in
//! no triangle. The caller checks the topology (analyze_topology).
//!
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(size of the complex) and a sort.
[[nodiscard]] std::vector<Triangle> build_dual(const Surface& surface, const Diagram& diagram,
                                               const Progress& progress = {});

}  // namespace remesh
