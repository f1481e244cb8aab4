//! \file
//! Takes vertices away one by one without changing the topology.
#pragma once

#include <cstdint>
#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh_view.h"

namespace remesh {

//! Collapses edges of an oriented 2-manifold, shortest first, until `target` vertices are left: one
//! end goes, the other stays where it is. Every step meets the link condition ([dey1999]), so that
//! the result is a manifold with the same components, genera and boundary loops. A boundary vertex
//! goes only along its loop. As long as other steps lead to the target, faces keep their
//! orientation in space and a decent shape, and the vertices of `keep` stay.
//!
//! It stops above the target where no edge is left to collapse. Closed components of genus g then
//! have at most max(4, 26 g - 4) vertices, wherever they started ([joret2010]).
//! \param triangles  edited in place; indices are not renumbered.
//! \param keep       #V, or empty: 1 for vertices that go last (corners).
//! \throw agvd::Cancelled  the progress callback returned false; `triangles` are of no use then.
//! \return the vertices that went, in this order. Cost: O(n log n).
[[nodiscard]] std::vector<agvd::Index> reduce_vertices(std::span<const agvd::Vec3> positions,
                                                       std::vector<agvd::Triangle>& triangles,
                                                       agvd::Index target,
                                                       std::span<const std::uint8_t> keep = {},
                                                       const agvd::Progress& progress = {});

}  // namespace remesh
