//! \file
//! Remeshes a part of a mesh.
#pragma once

#include <functional>

#include "remesh/pipeline/remesh_options.h"
#include "remesh/pipeline/remesh_result.h"

namespace remesh::detail {

//! Remeshes a whole mesh.
using RemeshWhole = std::function<RemeshResult(const MeshView&, const RemeshOptions&)>;

//! Takes the region out as a mesh of its own, locks its seam, remeshes it, and joins it with the
//! faces that stay.
//!
//! \param options  with a region; checked, but for what `run` checks.
//! \throw ConstraintUnmet  num_samples is too small; what `run` throws.
//! Cost: O(n log n) for the whole mesh, and that of `run`.
[[nodiscard]] RemeshResult remesh_region(const MeshView& mesh, const RemeshOptions& options,
                                         const RemeshWhole& run);

}  // namespace remesh::detail
