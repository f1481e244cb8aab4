//! \file
//! Last stage: checks what remesh() promises of the mesh.
#pragma once

#include "remesh/pipeline/build_mesh.h"

namespace remesh::detail {

//! Checks that the mesh has the topology of the input, which the earlier stages imply, and the
//! vertex count that was asked for. In between, Junctions::Keep welds the sheets.
//!
//! \return the topology before the sheets are welded; faces keep their order.
//! \throw NetworkFailed     there is a plan, and something differs.
//! \throw std::logic_error  there is no plan, and the topology differs: a bug.
//! Cost: O(n log n).
[[nodiscard]] Topology check_result(const CleanedInput& cleaned, const Domain& domain,
                                    std::span<const ChainEdge> chain, BuiltMesh& built,
                                    const StageContext& context);

}  // namespace remesh::detail
