//! \file
//! The stages of remesh() in their order. Private to the pipeline.
#pragma once

#include "remesh/pipeline/remesh.h"

namespace remesh::detail {

//! Thrown where the topology of the input lets no further vertex go.
struct TooFewSamples {
    agvd::Index asked;
    agvd::Index reached;  //!< Vertices that are left.
};

//! \param options     checked.
//! \param most_mends  rounds of new sites where the result runs through itself.
//! \throw TooFewSamples, and what remesh() throws.
[[nodiscard]] RemeshResult run_pipeline(const agvd::MeshView& mesh, const RemeshOptions& options,
                                        int most_mends);
//! \param mesh  is given away as soon as cleaning has found nothing to repair; with TooFewSamples
//! it
//!              is as it was.
[[nodiscard]] RemeshResult run_pipeline(agvd::TriangleMesh& mesh, const RemeshOptions& options,
                                        int most_mends);

}  // namespace remesh::detail
