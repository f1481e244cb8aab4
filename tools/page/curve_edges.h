//! \file
//! The edges of a mesh that are creases, as remesh finds them.
#pragma once

#include <array>
#include <vector>

#include "remesh/pipeline/remesh.h"

namespace page {

//! The creases of a mesh at a spacing, by the rule that the options of a run choose. Boundaries are
//! left out. Empty also if the mesh cannot be repaired.
//! \param mesh     any triangles.
//! \param options  reads features, feature_angle and num_threads.
//! \param num_vertices  of the result: gives the spacing.
//! \return pairs of vertices of the mesh, ascending; each edge once.
//! Cost: that of clean_input and find_creases.
[[nodiscard]] std::vector<std::array<agvd::Index, 2>> crease_edges(
    const agvd::MeshView& mesh, const remesh::RemeshOptions& options, std::size_t num_vertices);

}  // namespace page
