//! \file
//! Orders in which neighbours in space are near each other in memory: passes over many points or
//! faces find what they read in the cache.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "remesh/clean/clean_input.h"
#include "remesh/names.h"

namespace remesh::detail {

//! The numbers of the points along a Morton curve through their bounding cube. Points that are not
//! told apart by 1 / 65536 of the cube keep their order. Cost: O(n log n).
[[nodiscard]] std::vector<Index> order_in_space(std::span<const Vec3> points, Ticker ticker = {});

//! Renumbers vertices and faces in this order, if those of a face are far apart in memory: more
//! than `most_apart` vertices on average. Files of subdivided meshes are like that; those of scans
//! are not. The corners of faces keep their order.
//!
//! \return whether it did. Cost: O(#F + #V log #V); O(#F) if not.
bool order_in_space(CleanResult& clean, Ticker ticker, double most_apart = 1 << 14);

}  // namespace remesh::detail
