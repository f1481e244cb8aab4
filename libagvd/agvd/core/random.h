//! \file
//! Counter-based random numbers: value = f(seed, stream, index). No state, so any thread can draw
//! any number and the result never depends on the order of drawing.
#pragma once

#include <cstdint>

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

}  // namespace agvd
