//! \file
//! Blue noise by weighted sample elimination ([yuksel2015]).
#pragma once

#include <span>

#include "remesh/sites/scatter.h"

namespace remesh::detail {

//! Removes one by one the most crowded point: the one with the largest sum of its neighbours'
//! weights (the last of equals). It stops when `keep` points are left besides the last `num_fixed`,
//! which have weight for others and stay.
//!
//! \param spacing  distance of the kept points in the densest packing.
//! \param unit     #points: of distances between a point and its neighbours; empty: mesh units. It
//!                 must not change much over a spacing.
//! \return  the kept points in their old order, without the fixed ones.
//! Cost: O(M log M) for M = points.size() spread over the area.
[[nodiscard]] std::vector<SurfacePoint> eliminate(const Surface& surface,
                                                  std::span<const ScatteredPoint> points,
                                                  Index num_fixed, Index keep, double spacing,
                                                  int num_threads, const Progress& progress = {},
                                                  std::span<const double> unit = {});

}  // namespace remesh::detail
