//! \file
//! Adds sites to curves towards much shorter curves.
#pragma once

#include <vector>

#include "remesh/curves/curve_network.h"

namespace remesh {

//! A triangle between an interval of a curve and one k times as long has an angle of at most 1/k.
//! So if the first interval after a node is more than eight times as long as the shortest one
//! there, it is divided in equal proportions. For two corners .08 apart where the spacing is 2.6
//! (65004), the smallest angle goes from 1.2 to 8.6 degrees with three or four sites at each.
//! Intervals are not divided if the short curve joins two curves that run side by side: sites do
//! not widen a narrow strip (58011 loses .01 of its mean quality).
//!
//! \param along  #curves: places between the ends of each, ascending; edited in place.
//! Cost: O(curves + sites).
void guard_corners(const Surface& surface, const CurveNetwork& network,
                   std::vector<std::vector<double>>& along);

}  // namespace remesh
