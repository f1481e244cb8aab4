//! \file
//! The faces where labels may meet, guessed from quick bounds before any window runs.
#pragma once

#include <cstdint>
#include <vector>

#include "agvd/propagation/corners.h"
#include "agvd/propagation/distance_bounds.h"

namespace agvd {

//! Marks the faces where windows of several sites are expected: those within two rings of a change
//! of label, and those where a path from the other side of the change is nearly as short as the
//! bound. The labels come from bounds. On few faces the borders of exact distances lie farther off.
//!
//! \return #F: 1 for the marked faces.
//!
//! \param corners  Corners(surface).
//! Cost: O(#F).
[[nodiscard]] std::vector<std::uint8_t> faces_near_borders(const Surface& surface,
                                                           const Corners& corners,
                                                           const DistanceBounds& bounds);

}  // namespace agvd
