//! \file
//! Patches of a mesh that lie on each other, whatever their vertices and diagonals.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/any_mesh.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Two patches in one place.
struct CoincidentPatch {
    std::vector<Index> first, copy;  //!< Their faces, ascending; `first` has the lowest one.
    bool is_turned = false;          //!< They face opposite ways.
};

//! Whether two faces with a common edge, from a on and across it from b on, lie nearly on each
//! other.
[[nodiscard]] bool is_folded(const MeshView& mesh, Index a, Index b);

//! Patches are joined at edges of two faces that are not folded there. Single faces are left out.
//! Cost: O(n log n).
[[nodiscard]] std::vector<CoincidentPatch> find_coincident(const MeshView& mesh,
                                                           std::span<const EdgeSide> sides,
                                                           Ticker& ticker);

}  // namespace remesh::detail
