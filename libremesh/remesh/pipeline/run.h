//! \file
//! The stages of remesh() in their order. Private to the pipeline.
#pragma once

#include "remesh/pipeline/remesh_options.h"
#include "remesh/pipeline/remesh_result.h"

namespace remesh::detail {

//! Thrown where the topology of the input lets no further vertex go.
struct TooFewSamples {
    agvd::Index asked;
    agvd::Index reached;  //!< Vertices that are left.
};

//! Thrown where the curves of the network could not all be reproduced.
struct NetworkFailed {};

//! What of its curves a run is to reproduce, besides the boundary.
struct KeptCurves {
    bool has_junctions = true;
    double drop_share = 0;  //!< Of the creases: see plan_network.
};

//! \param options     checked.
//! \param most_mends  rounds of new sites where the result self-intersects.
//! \throw TooFewSamples, NetworkFailed (only with creases or junctions), and what remesh() throws.
[[nodiscard]] RemeshResult run_pipeline(const agvd::MeshView& mesh, const RemeshOptions& options,
                                        int most_mends, const KeptCurves& kept = {});
//! \param mesh  is given away as soon as cleaning has found nothing to repair; with TooFewSamples,
//!              NetworkFailed or a result with curves it is as it was.
[[nodiscard]] RemeshResult run_pipeline(agvd::TriangleMesh& mesh, const RemeshOptions& options,
                                        int most_mends, const KeptCurves& kept = {});

}  // namespace remesh::detail
