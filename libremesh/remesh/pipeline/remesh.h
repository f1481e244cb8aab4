//! \file
//! The whole pipeline: from a mesh to the dual of its geodesic Voronoi diagram.
#pragma once

#include "agvd/mesh/mesh.h"
#include "remesh/pipeline/remesh_options.h"
#include "remesh/pipeline/remesh_result.h"

namespace remesh {

//! Replaces a mesh by the dual of its geodesic Voronoi diagram ([meng2023] Sec. 7).
//!
//! The result is an oriented 2-manifold with the components of the cleaned input, each with its
//! genus and boundary loops, and has num_samples vertices (or one for each of `sites` that owns a
//! part of the surface). Both are checked; docs/algorithm.md says why they can be had. Where k
//! sheets meet at a junction, it has k vertices at one point; Junctions::Keep welds them.
//! \param mesh  #V x 3 positions, #F x 3 indices; read only during the call; may be dirty.
//! \throw InvalidOption    an option is out of range.
//! \throw InvalidInput the mesh cannot be repaired (see clean_input), a given site does not
//!        lie on it, or a feature edge is not one of its edges.
//! \throw ConstraintUnmet  num_samples is too small for the topology; the text gives a number
//!        that was tried and works.
//! \throw Cancelled        the progress callback returned false.
//! Cost: mostly that of the propagations, of which each round of repair needs one: about O(n) with
//! an error bound, O(n sqrt(n / t)) for exact distances; n = faces of the base, t = sites. The
//! Steiner engine has O(m n) nodes, m = Steiner points per edge. Re-entrant: no global state.
[[nodiscard]] RemeshResult remesh(const MeshView& mesh, const RemeshOptions& options = {});

//! The same for a mesh that the caller no longer needs. If it needs no repair and no option refers
//! to its elements, its memory, 36 bytes for each face, is released after cleaning.
[[nodiscard]] RemeshResult remesh_moved(TriangleMesh mesh, const RemeshOptions& options = {});

}  // namespace remesh
