//! \file
//! Pairs of faces that intersect.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! Pairs of faces (lower, higher), sorted, that meet in more than the vertices or the edge they
//! share by index: they cross, touch, fold onto each other along their edge, or have the same
//! corners. Decided exactly on the coordinates. Faces without area are skipped. Any mesh, manifold
//! or not.
//!
//! \param num_threads  >= 0; 0: all cores. Any number gives the same pairs.
//! \throw Cancelled  the progress callback returned false.
//! \return unset in a build without CGAL, whose box intersection and exact predicates are used.
//! Cost: O(n log^3 n) and about 1 us for each pair of neighbouring faces.
[[nodiscard]] std::optional<std::vector<std::pair<Index, Index>>> find_self_intersections(
    const MeshView& mesh, int num_threads = 0, const Progress& progress = {});

}  // namespace remesh
