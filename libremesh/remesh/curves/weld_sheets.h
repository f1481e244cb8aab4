//! \file
//! Welds the sheets of a mesh, which is not manifold where they meet.
#pragma once

#include <span>

#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! The faces with first[v] in place of each vertex v.
[[nodiscard]] std::vector<Triangle> rename_vertices(std::span<const Triangle> triangles,
                                                    std::span<const Index> first);

//! Merges the vertices of each group into the first one.
//!
//! \param group  #V.
//! \return the vertices that stay, ascending; these are the new vertices in order. Cost: O(n).
std::vector<Index> weld_sheets(std::span<const Index> group, TriangleMesh& mesh);

//! The number of edges with more than two faces. Cost: O(n).
[[nodiscard]] Index num_branched_edges(std::span<const Triangle> triangles);

}  // namespace remesh
