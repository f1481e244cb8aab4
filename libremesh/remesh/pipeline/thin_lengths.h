//! \file
//! Longest edges on parts that are thinner than the spacing.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Lengths with which some five vertices lie around a thin part, such as a rod. They are at least
//! an eighth of the spacing, and longer if the thin parts took more than a quarter of the sites.
//!
//! \param places   on base.input(): where cells wrap around such parts.
//! \param joined   see limit_growth.
//! \param spacing  mesh units: of the sites in the mean.
//! \return #V of base.surface(); infinity where nothing is thin.
//! Cost: O(n log n).
[[nodiscard]] std::vector<double> thin_lengths(const IntrinsicTriangulation& base,
                                               std::span<const SurfacePoint> places,
                                               std::span<const std::pair<Index, Index>> joined,
                                               double spacing, double num_sites, Ticker& ticker);

}  // namespace remesh::detail
