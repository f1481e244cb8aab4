//! \file
//! Carries edges of the caller's mesh to the cleaned mesh.
#pragma once

#include <array>
#include <span>

#include "agvd/mesh/surface.h"
#include "remesh/clean/clean_input.h"

namespace remesh {

//! \param edges    pairs of vertices of `mesh`.
//! \param clean    of clean_input(mesh).
//! \param surface  of clean.mesh.
//! \return #E of the surface: 1 for edges that given ones have become. A given edge whose faces
//!         were split elsewhere by cleaning becomes none.
//! \throw InvalidInput  a pair is not an edge of the mesh; the text names it.
//! Cost: O(#F log #edges).
[[nodiscard]] std::vector<std::uint8_t> carry_edges(std::span<const std::array<Index, 2>> edges,
                                                    const MeshView& mesh, const CleanedView& clean,
                                                    const Surface& surface);

//! Finds edges between faces of different labels.
//!
//! \param face_labels  of the faces of the mesh that clean_input() got.
//! \param face_origin  #F of the surface: see CleanResult.
//! \return #E of the surface: 1 for such edges. Cost: O(#E).
[[nodiscard]] std::vector<std::uint8_t> find_label_borders(std::span<const Index> face_labels,
                                                           std::span<const Index> face_origin,
                                                           const Surface& surface);

}  // namespace remesh
