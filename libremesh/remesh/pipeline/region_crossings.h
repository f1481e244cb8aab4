//! \file
//! Self-intersections of a part of a mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh::detail {

//! The number of intersecting pairs of faces of which at least one is marked: see
//! find_self_intersections.
//!
//! \param is_marked  #F: other than 0 for marked faces, of which there is one.
//! \return unset without CGAL.
//! Cost: O(#F), and that of find_self_intersections for the faces near the marked ones.
[[nodiscard]] std::optional<Index> count_crossings_at(const MeshView& mesh,
                                                      std::span<const std::uint8_t> is_marked,
                                                      int num_threads, const Progress& progress);

}  // namespace remesh::detail
