//! \file
//! Removes vertices one by one without changing the topology: to a number, and what simplified
//! patches have too many. Private to remeshing.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "agvd/core/progress.h"
#include "agvd/intrinsic/simplify.h"
#include "remesh/dual/fan_mesh.h"

namespace remesh {

//! Collapses edges of an oriented 2-manifold, shortest first, until `target` vertices are left;
//! ends that stay keep their positions. Every step meets the link condition ([dey1999]), so the
//! topology stays. Unless it cannot be reached otherwise, faces keep their orientation and a
//! minimum quality, and the vertices of `keep` stay.
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

//! The same, but the caller does the collapses, and may refuse some.
//! \param collapse  collapse(gone, into) edits `mesh` so, and gives true; or does nothing.
void reduce_vertices(std::span<const Vec3> positions, const detail::FanMesh& mesh, Index target,
                     const std::function<bool(Index, Index)>& collapse,
                     const Progress& progress = {});

//! Applies simplify(), then removes as many of the extra vertices that it leaves as can be removed
//! by collapses, and by flips of edges that are in their way. On a curve no patch may have a vertex
//! that the patch across the curve lacks.
//! \param surface  may be a Delta-complex.
//! \param faces    ascending: one component of it.
//! \param points   in these faces, no two at one position.
//! Cost: as simplify().
[[nodiscard]] SimplifiedMesh simplify_patch(const Surface& surface, std::span<const Index> faces,
                                            std::span<const SurfacePoint> points);

}  // namespace remesh
