//! \file
//! A run after cleaning: the stages once, and again only where these do not give a good mesh.
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

//! Runs the stages from the network of curves on (mesh_with_curves). Where no mesh has the curves,
//! or faces still intersect, they run again with others; where the result does not reach a narrow
//! part, or faces still intersect then, with shorter edges there.
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
[[nodiscard]] RemeshResult run_by_collapses(const CleanedInput& cleaned, RemeshResult before,
                                            const RemeshOptions& options);

//! Whether that run would have a mesh; without shorter edges.
//! \throw TooFewSamples  it would not.
void require_mesh(const CleanedInput& cleaned, RemeshResult after_cleaning,
                  const RemeshOptions& options);

}  // namespace remesh::detail
