//! \file
//! Blue noise by weighted sample elimination ([yuksel2015]).
#pragma once

#include <span>

#include "remesh/sampling/scatter.h"

namespace remesh::detail {

//! Takes away, one by one, the point that its neighbours crowd most (of equals, the later one)
//! until `keep` are left besides the last `num_fixed`, which crowd others and stay.
//!
//! \param spacing  distance of the kept points, packed as densely as can be.
//! \return  the kept ones in their old order, without the fixed ones.
//! Cost: O(M log M) for M = points.size() spread over the area.
[[nodiscard]] std::vector<agvd::SurfacePoint> eliminate(const agvd::Surface& surface,
                                                        std::span<const ScatteredPoint> points,
                                                        agvd::Index num_fixed, agvd::Index keep,
                                                        double spacing, int num_threads,
                                                        const agvd::Progress& progress = {});

}  // namespace remesh::detail
