//! \file
//! Reads and writes numbers in binary files. Private to the readers and writers.
//! Writes numbers of types that are known at run time to binary files. Private to the writers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "remesh/meshfile/read_mesh.h"

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

//! Appends a value in a type; integers are rounded and kept in the range of the type, NaN becomes
//! 0.
inline void append_number(std::string& bytes, NumberType type, double value,
                          std::endian order = std::endian::little) {
    const auto append_whole = [&]<typename T>(T) {
        constexpr double low = std::numeric_limits<T>::min(), high = std::numeric_limits<T>::max();
        const double whole = std::isnan(value) ? 0 : std::clamp(std::round(value), low, high);
        append(bytes, static_cast<T>(whole), order);
    };
    switch (type) {
        case NumberType::Int8:
            return append_whole(std::int8_t{});
        case NumberType::UInt8:
            return append_whole(std::uint8_t{});
        case NumberType::Int16:
            return append_whole(std::int16_t{});
        case NumberType::UInt16:
            return append_whole(std::uint16_t{});
        case NumberType::Int32:
            return append_whole(std::int32_t{});
        case NumberType::UInt32:
            return append_whole(std::uint32_t{});
        case NumberType::Float32:
            return append(bytes, static_cast<float>(value), order);
        case NumberType::Float64:
            return append(bytes, value, order);
    }
}

}  // namespace remesh
