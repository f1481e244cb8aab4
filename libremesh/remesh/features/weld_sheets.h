//! \file
//! Welds the sheets of a mesh, which is not manifold where they meet.
#pragma once

#include <span>

#include "agvd/mesh/mesh_view.h"

namespace remesh {

//! The faces with first[v] in place of each vertex v.
[[nodiscard]] std::vector<agvd::Triangle> rename_vertices(std::span<const agvd::Triangle> triangles,
                                                          std::span<const agvd::Index> first);

//! Merges the vertices of each group into the first one.
//!
//! \param group  #V.
//! \return the vertices that stay, ascending; these are the new vertices in order. Cost: O(n).
std::vector<agvd::Index> weld_sheets(std::span<const agvd::Index> group, agvd::TriangleMesh& mesh);

//! The number of edges with more than two faces. Cost: O(n).
[[nodiscard]] agvd::Index num_branched_edges(std::span<const agvd::Triangle> triangles);

}  // namespace remesh
