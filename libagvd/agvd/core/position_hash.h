//! \file
//! A hash of positions, to find equal ones.
#pragma once

#include <bit>
#include <cstddef>

#include "agvd/core/random.h"
#include "agvd/core/types.h"

namespace agvd {

//! Equal positions have equal hashes; 0 and -0 are equal.
struct PositionHash {
    [[nodiscard]] std::size_t operator()(const Vec3& position) const {
        std::uint64_t bits = 0;
        for (int k = 0; k < 3; ++k) {
            bits = mix_bits(bits ^ std::bit_cast<std::uint64_t>(position[k] + 0.0));
        }
        return static_cast<std::size_t>(bits);
    }
};

}  // namespace agvd
