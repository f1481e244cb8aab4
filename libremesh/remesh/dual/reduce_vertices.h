//! \file
//! Removes vertices one by one without changing the topology.
#pragma once

#include <cstdint>
#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! Collapses edges of an oriented 2-manifold, shortest first, until `target` vertices are left: one
//! end is removed, the other keeps its place. Every step meets the link condition ([dey1999]), so
//! the result is a manifold with the same components, genera and boundary loops. A boundary vertex
//! is removed only along its loop. Unless the target cannot be reached otherwise, faces keep their
//! orientation in space and a minimum quality, and the vertices of `keep` stay.
//!
//! It stops above the target if no edge is left to collapse. Closed components of genus g then have
//! at most max(4, 26 g - 4) vertices, whatever their number before ([joret2010]).
//! \param triangles  edited in place; indices are not renumbered.
//! \param keep       #V, or empty: 1 for vertices to remove last (corners).
//! \throw Cancelled  the progress callback returned false; `triangles` are unspecified then.
//! \return the removed vertices, in order of removal. Cost: O(n log n).
[[nodiscard]] std::vector<Index> reduce_vertices(std::span<const Vec3> positions,
                                                 std::vector<Triangle>& triangles, Index target,
                                                 std::span<const std::uint8_t> keep = {},
                                                 const Progress& progress = {});

}  // namespace remesh
