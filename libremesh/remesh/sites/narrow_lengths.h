//! \file
//! Lengths of edges on parts that are narrower than the spacing. Private.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Longest edges on parts that are narrower than the spacing there: some five vertices lie around
//! each. Lengths are at least an eighth of the others', and longer if such parts took more than a
//! quarter of the sites.
//! \param points   on base.input(): where cells wrap around such parts.
//! \param joined   see limit_growth, as is slope.
//! \param edge     #V of base.surface(): lengths of the edges without such parts.
//! \return #V of base.surface(); infinity where nothing is narrow.
//! Cost: O(n log n).
[[nodiscard]] std::vector<double> narrow_lengths(const IntrinsicTriangulation& base,
                                                 std::span<const SurfacePoint> points,
                                                 std::span<const std::pair<Index, Index>> joined,
                                                 std::span<const double> edge, double num_sites,
                                                 double slope, Ticker& ticker);

}  // namespace remesh::detail
