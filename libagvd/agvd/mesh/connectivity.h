//! \file
//! The neighbours of the faces of an oriented 2-manifold.
#pragma once

#include <optional>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh_view.h"

namespace agvd {

//! Twins and one-rings of a mesh. Half-edge 3 f + k runs from corner k to corner k + 1 of face f.
struct Connectivity {
    std::vector<Index> twin;  //!< #H: the half-edge across; no_index on the boundary.
    //! #V: a half-edge that leaves the vertex; on the boundary the one without twin, from which
    //! `previous` and `twin` walk through the whole one-ring. no_index for an isolated vertex.
    std::vector<Index> outgoing;
};

//! No result if a face repeats a corner, an edge has more than two faces or two that run the same
//! way, or the faces around a vertex are not one fan.
//!
//! \param mesh         indices in range; positions are not read.
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n); 8 bytes per edge and 4 per vertex beyond the result.
[[nodiscard]] std::optional<Connectivity> find_connectivity(const MeshView& mesh, int num_threads,
                                                            const Progress& progress = {});

}  // namespace agvd
