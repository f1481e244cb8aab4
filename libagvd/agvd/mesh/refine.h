//! \file
//! Splits long edges without changing the surface.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh_view.h"

namespace agvd {

struct RefinedMesh {
    TriangleMesh mesh;               //!< The input's vertices first, then edge midpoints.
    std::vector<Index> face_origin;  //!< #F: the input face that each face is a part of.
};

//! Whether split_long_edges would split any.
[[nodiscard]] bool has_long_edges(const MeshView& mesh, double max_length);

//! Halves edges until none is longer than max_length; neighbouring faces stay joined. With no such
//! edge the mesh comes back as it is.
//!
//! A graph of Steiner points sees only what its edges resolve: where an edge spans many cells, its
//! points lie too far apart for any of them, and splitting it costs less than more points on every
//! edge.
//! \param max_length > 0, mesh units.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n log(longest / max_length)) plus the size of the result.
[[nodiscard]] RefinedMesh split_long_edges(const MeshView& mesh, double max_length,
                                           const Progress& progress = {});

}  // namespace agvd
