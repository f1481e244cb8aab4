//! \file
//! A coarse surface for a run of few samples on many faces, and the way back.
#pragma once

#include <optional>

#include "remesh/clean/coarsen.h"
#include "remesh/pipeline/cleaned_input.h"

namespace remesh::detail {

//! How a surface is coarsened for a run of few samples on many faces.
//! \param spacing  of the sites, mesh units.
//! \return unset if it has few faces.
[[nodiscard]] std::optional<CoarsenOptions> coarsening_for(Index num_faces, Index num_samples,
                                                           double spacing);

//! #V: 1 on the boundary, and for the copies of a vertex at which sheets meet.
//! \param origin  #V: equal for copies; empty: there are none.
[[nodiscard]] std::vector<std::uint8_t> vertices_that_stay(const Surface& surface,
                                                           std::span<const Index> origin);

//! The input on a mesh of some 16 faces for each sample (see coarsen), nowhere farther from it than
//! a fiftieth of the spacing, root mean square; creases and boundary are those of the input.
//! \param spacing  of the sites, mesh units.
//! \param cleaned  outlives the result.
//! \return unset if the input has few faces; if the options name places on it, or want vertices on
//!         it, exact distances, or a bound of the distance.
//! Cost: that of find_creases and coarsen.
[[nodiscard]] std::optional<CleanedInput> coarse_input(const CleanedInput& cleaned, double spacing,
                                                       const StageContext& context);

//! Points of the coarse surface on the one that it stands for: the nearest around them.
//! \param coarse  has a finer one.
//! Cost: O(faces within an edge of the coarse surface) for each point.
[[nodiscard]] std::vector<SurfacePoint> to_finer(const CleanedInput& coarse,
                                                 std::span<const SurfacePoint> points);

}  // namespace remesh::detail
