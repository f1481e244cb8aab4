//! \file
//! Better triangles where moving vertices is not enough.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/features/close_rim.h"
#include "remesh/placement/edited_mesh.h"
#include "remesh/placement/placed_mesh.h"

namespace remesh {

//! Works on the worst triangles first: flips an edge, slides vertices over the surface and along
//! its boundary, splits an edge and collapses another one elsewhere, or the other way round,
//! wherever the worst triangle touched gets better. The number of vertices stays, and so do
//! topology and hard edges; the order of vertices does not.
//!
//! \param surface   where the points of the mesh lie.
//! \param mobility  #V: Fixed ones stay; those on hard edges are not Free.
//! \param hard      edges that are not flipped; those with one face alone must be among them.
//! \throw agvd::Cancelled  the progress callback returned false; `mesh` is as it was.
//! \return the number that each vertex had, of new ones not below #V; nothing if all is as before.
//! Cost: O(#triangles log #triangles), and about a millisecond for each bad one.
std::vector<agvd::Index> mend_shape(const agvd::Surface& surface,
                                    std::span<const detail::Mobility> mobility,
                                    std::span<const DirectedEdge> hard, PlacedMesh& mesh,
                                    const agvd::Progress& progress = {});

}  // namespace remesh
