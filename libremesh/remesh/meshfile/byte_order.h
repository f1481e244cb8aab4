//! \file
//! Reads and writes numbers in binary files. Private to the readers and writers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

#include "remesh/names.h"

namespace remesh {

//! The T stored at `bytes`, in the order given.
template <typename T>
[[nodiscard]] T load(const char* bytes, std::endian order = std::endian::little) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes, sizeof(T));
    if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
}

//! Appends the value in the order given.
template <typename T>
void append(std::string& bytes, T value, std::endian order = std::endian::little) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (std::endian::native != order) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

}  // namespace remesh
