//! \file
//! Sites of curves get denser towards curves that are much shorter.
#pragma once

#include <vector>

#include "remesh/features/curve_network.h"

namespace remesh {

//! A triangle between an interval of a curve and one that is k times as long has an angle of 1/k at
//! most. So where the first interval behind a node is more than eight times as long as the shortest
//! there, it is divided in equal proportions: of two corners .08 apart where sites are 2.6 (65004)
//! the smallest angle goes from 1.2 to 8.6 degrees, for three or four sites at each. Not where the
//! short curve joins two that run on side by side: a strip is as narrow whatever its sites (58011
//! loses .01 of its mean quality).
//!
//! \param along  #curves: places between the ends of each, ascending; changed.
//! Cost: O(curves + sites).
void guard_corners(const agvd::Surface& surface, const CurveNetwork& network,
                   std::vector<std::vector<double>>& along);

}  // namespace remesh
