//! \file
//! Vertices at equal positions. Private.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/poller.h"
#include "agvd/core/types.h"

namespace remesh::detail {

//! For each position the first one that is equal to it. Cost: O(n) expected.
[[nodiscard]] std::vector<agvd::Index> first_at_position(std::span<const agvd::Vec3> positions,
                                                         agvd::Ticker& ticker);

}  // namespace remesh::detail
