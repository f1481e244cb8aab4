//! \file
//! Triangulates a planar polygon with holes: bridges, ear clipping, then flips to Delaunay.
#pragma once

#include <vector>

#include "agvd/core/types.h"

namespace make_data {

//! \param loops  the outline counter-clockwise, then the holes clockwise; simple and disjoint.
//! The triangles are counter-clockwise; indices run through the loops one after the other.
//! Cost: O(n^3) at worst, n points.
[[nodiscard]] std::vector<agvd::Triangle> triangulate(
    const std::vector<std::vector<agvd::Vec2>>& loops);

}  // namespace make_data
