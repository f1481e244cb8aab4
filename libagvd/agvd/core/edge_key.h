//! \file
//! Edges by their ends.
#pragma once

#include <algorithm>
#include <cstdint>

#include "agvd/core/types.h"

namespace agvd {

//! The same number for (a, b) and (b, a); ascending by the lower index, then by the higher one.
[[nodiscard]] constexpr std::uint64_t edge_key(Index a, Index b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

}  // namespace agvd
