//! \file
//! A run after cleaning: the stages once, and once more for what a good mesh needs in places.
#pragma once

#include <span>

#include "remesh/curves/select_creases.h"
#include "remesh/pipeline/cleaned_input.h"

namespace remesh::detail {

struct DistanceBound;

//! Thrown if no choice of curves gives a mesh.
struct TooFewSamples {
    Index asked;
    Index reached;  //!< Vertices that may suffice.
    Index for_all;  //!< Vertices that may suffice for all curves, too.
};

//! Runs the stages from the network of curves on (mesh_with_curves), without creases only if no
//! mesh has them. Where faces intersect beside creases that were left out, or the result does not
//! reach a narrow part, they run once more, with these creases and with shorter edges there.
//! \param after_cleaning  what the result says so far.
//! \param lengths  on the cleaned surface: how long edges are at most.
//! \param bound    see mesh_with_curves.
//! \throw TooFewSamples
[[nodiscard]] RemeshResult run_after_cleaning(const CleanedInput& cleaned,
                                              RemeshResult after_cleaning,
                                              const RemeshOptions& options,
                                              std::span<const SizedPoint> lengths,
                                              const DistanceBound* bound);

//! A mesh without curves of vertices of the input (Vertices::Surface).
//! \param before  of that run. \return the result; `before` if it has no more intersections.
[[nodiscard]] RemeshResult run_by_collapses(const CleanedInput& cleaned, const RemeshResult& before,
                                            const RemeshOptions& options);

}  // namespace remesh::detail
