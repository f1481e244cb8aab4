//! \file
//! The whole job: a mesh in, the dual of its geodesic Voronoi diagram out.
#pragma once

#include "agvd/mesh/mesh_view.h"
#include "remesh/pipeline/remesh_options.h"
#include "remesh/pipeline/remesh_result.h"

namespace remesh {

//! Replaces a mesh by the dual of its geodesic Voronoi diagram ([meng2023] Sec. 7).
//!
//! The result is an oriented 2-manifold with the components of the cleaned input, each with its
//! genus and boundary loops, and with num_samples vertices (or those of `sites` that own
//! something): checked before it is returned. A junction of k sheets has k vertices at one point;
//! with Junctions::Keep the mesh is one of these sheets, welded. docs/algorithm.md says why this
//! always ends well.
//! \param mesh  #V x 3 positions, #F x 3 indices; read only during the call; may be dirty.
//! \throw agvd::InvalidOption    an option is out of range.
//! \throw agvd::InvalidInput the mesh cannot be repaired (see clean_input), a given site is not on
//!        it, or a feature edge is none of its edges.
//! \throw agvd::ConstraintUnmet  num_samples is too small for the topology; the text gives a number
//!        that was tried and works.
//! \throw agvd::Cancelled        the progress callback returned false.
//! Cost: O(m n log n) a round, n = #F. Re-entrant: no global state.
[[nodiscard]] RemeshResult remesh(const agvd::MeshView& mesh, const RemeshOptions& options = {});

//! The same for a mesh that the caller does not need any more: where nothing has to be repaired its
//! memory, 36 bytes for each face, is given back before all else is made.
[[nodiscard]] RemeshResult remesh_moved(agvd::TriangleMesh mesh, const RemeshOptions& options = {});

}  // namespace remesh
