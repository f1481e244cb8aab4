//! \file
//! Meshes that are too large for a page are drawn as a remesh.
#pragma once

#include <optional>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"

namespace page {

//! A mesh of more faces is drawn as a remesh of thinned_vertices.
inline constexpr std::size_t most_faces = 1'000'000;
//! See most_faces.
inline constexpr agvd::Index thinned_vertices = 200'000;

//! A mesh that is small enough to be drawn; unset: the given one is.
//! \throw agvd::Cancelled  the progress callback returned false.
[[nodiscard]] std::optional<agvd::TriangleMesh> thinned(const agvd::MeshView& mesh, int num_threads,
                                                        const agvd::Progress& progress);

}  // namespace page
