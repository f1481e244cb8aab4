//! \file
//! Last stage: does the mesh keep what was promised?
#pragma once

#include "remesh/pipeline/build_mesh.h"

namespace remesh::detail {

//! Compares the topology of the mesh with the input's, although all stages before imply that they
//! are the same, and the vertex count with the one asked for. With Junctions::Keep the sheets are
//! welded in between.
//!
//! \throw NetworkFailed     with a plan: something differs.
//! \throw std::logic_error  without a plan the topology differs, which is a bug.
//! Cost: O(n log n).
void check_result(const CleanedInput& cleaned, const Domain& domain,
                  std::span<const ChainEdge> chain, BuiltMesh& built, const StageContext& context);

}  // namespace remesh::detail
