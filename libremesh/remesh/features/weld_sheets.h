//! \file
//! The sheets of a mesh as one that is not manifold where they meet.
#pragma once

#include <span>

#include "agvd/mesh/mesh_view.h"

namespace remesh {

//! The faces with first[v] in place of each vertex v.
[[nodiscard]] std::vector<agvd::Triangle> rename_vertices(std::span<const agvd::Triangle> triangles,
                                                          std::span<const agvd::Index> first);

//! Makes one vertex of all those of a group: of them the first one stays.
//!
//! \param group  #V.
//! \return the vertices that stay, ascending: the new ones in their order. Cost: O(n).
std::vector<agvd::Index> weld_sheets(std::span<const agvd::Index> group, agvd::TriangleMesh& mesh);

//! Edges of more than two faces. Cost: O(n).
[[nodiscard]] agvd::Index num_branched_edges(std::span<const agvd::Triangle> triangles);

}  // namespace remesh
