//! \file
//! Vertices at equal positions. Private.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/poller.h"
#include "agvd/core/types.h"

namespace agvd {

//! For each position the first one that is equal to it. Cost: O(n) expected.
[[nodiscard]] std::vector<Index> first_at_position(std::span<const Vec3> positions, Ticker& ticker);

}  // namespace agvd
