//! \file
//! Random numbers and hashes. A number is f(seed, stream, index), without state: any thread can
//! draw any number, and the result never depends on the order of drawing.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "agvd/core/types.h"

namespace agvd {

//! Mixes 64 bits (the finaliser of SplitMix64).
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

[[nodiscard]] constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t stream,
                                                  std::uint64_t index) {
    return mix_bits(mix_bits(mix_bits(seed) ^ stream) ^ index);
}

//! Uniform in [0, 1).
[[nodiscard]] constexpr double random_unit(std::uint64_t seed, std::uint64_t stream,
                                           std::uint64_t index) {
    return static_cast<double>(random_bits(seed, stream, index) >> 11) * 0x1.0p-53;
}

//! To find equal positions: equal ones have equal hashes; 0 and -0 are equal.
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
