//! \file
//! An order of points in which neighbours in space are near each other in memory.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh::detail {

//! The numbers of the points along a Morton curve through their bounding cube. Points that are not
//! told apart by 1 / 65536 of the cube keep their order. Cost: O(n log n).
[[nodiscard]] std::vector<Index> order_in_space(std::span<const Vec3> points);

}  // namespace remesh::detail
