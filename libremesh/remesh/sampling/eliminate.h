//! \file
//! Blue noise by weighted sample elimination ([yuksel2015]).
#pragma once

#include <span>

#include "remesh/sampling/scatter.h"

namespace remesh::detail {

//! Takes away, one by one, the point that its neighbours crowd most (of equals, the later one)
//! until `keep` are left.
//!
//! \param area  of the component they lie on.
//! \return  the kept ones in their old order.
//! Cost: O(M log M) for M = points.size() spread over the area.
[[nodiscard]] std::vector<agvd::SurfacePoint> eliminate(const agvd::Surface& surface,
                                                        std::span<const ScatteredPoint> points,
                                                        agvd::Index keep, double area,
                                                        int num_threads);

}  // namespace remesh::detail
