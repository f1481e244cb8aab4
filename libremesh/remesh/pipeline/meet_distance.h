//! \file
//! Runs with shorter and shorter edges until the result is near enough to the input.
#pragma once

#include <functional>
#include <span>

#include "remesh/pipeline/cleaned_input.h"

namespace remesh::detail {

//! A whole run after cleaning.
//! \param most_lengths  #V of the cleaned mesh: no target is longer.
using RunWithLengths =
    std::function<RemeshResult(const RemeshOptions& options, std::span<const double> most_lengths)>;

//! Begins with the lengths that curvature asks for, and shortens edges where the result is too far.
//! Vertices that the topology needs are added (VertexCount::Add).
//!
//! \param limit  > 0, mesh units: of MaxDistance.
//! \throw ConstraintUnmet  it was not met in the rounds made; the text gives the best.
//! Cost: that of a run and of DistanceCheck::measure in each round, of which there are one to
//! eight.
[[nodiscard]] RemeshResult meet_distance(const CleanedInput& cleaned, const RemeshOptions& options,
                                         double limit, const RunWithLengths& run);

}  // namespace remesh::detail
