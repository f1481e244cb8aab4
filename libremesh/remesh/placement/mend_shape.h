//! \file
//! Improves triangles where moving vertices is not enough.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/curves/glue.h"
#include "remesh/placement/edited_mesh.h"
#include "remesh/placement/placed_mesh.h"

namespace remesh {

//! Works on the worst triangles first. Flips an edge, slides vertices over the surface and along
//! its boundary, or splits an edge and collapses another one elsewhere, or the reverse, if the
//! worst triangle touched gets better. Keeps the number of vertices, the topology and the hard
//! edges, but not the order of vertices.
//!
//! \param surface   where the points of the mesh lie.
//! \param mobility  #V: Fixed ones stay; those on hard edges are not Free.
//! \param hard      edges that are not flipped; must include all edges of a single face.
//! \throw Cancelled  the progress callback returned false; `mesh` is unchanged.
//! \return for each vertex its old number, #V or more for new ones; empty if nothing changed.
//! Cost: O(#triangles log #triangles), and about a millisecond for each bad one.
std::vector<Index> mend_shape(const Surface& surface, std::span<const detail::Mobility> mobility,
                              std::span<const DirectedEdge> hard, PlacedMesh& mesh,
                              const Progress& progress = {});

}  // namespace remesh
