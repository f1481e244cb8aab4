//! \file
//! Numbers in binary files. Private to the readers and writers.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "remesh/meshfile/mesh_file.h"

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

//! Appends the values of a list, little endian.
template <typename T>
void append_numbers(std::string& bytes, std::span<const T> values) {
    if constexpr (std::endian::native == std::endian::little) {
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    } else {
        for (const T value : values) append(bytes, value);
    }
}

//! Appends some values, little endian.
template <typename... Numbers>
void append_all(std::string& bytes, Numbers... numbers) {
    (append(bytes, numbers), ...);
}

//! Calls `call` with a zero of the type. \return what it returns.
template <typename Call>
[[gnu::always_inline]] inline auto with_type(NumberType type, const Call& call) {
    switch (type) {
        case NumberType::Int8:
            return call(std::int8_t{});
        case NumberType::UInt8:
            return call(std::uint8_t{});
        case NumberType::Int16:
            return call(std::int16_t{});
        case NumberType::UInt16:
            return call(std::uint16_t{});
        case NumberType::Int32:
            return call(std::int32_t{});
        case NumberType::UInt32:
            return call(std::uint32_t{});
        case NumberType::Float32:
            return call(float{});
        case NumberType::Float64:
            break;
    }
    return call(double{});
}

//! The bytes that a number takes.
[[nodiscard]] inline std::size_t size_of(NumberType type) {
    return with_type(type, [](auto zero) { return sizeof zero; });
}

//! The number of a type stored at `bytes`.
[[nodiscard]] inline double load_number(const char* bytes, NumberType type,
                                        std::endian order = std::endian::little) {
    return with_type(type,
                     [&]<typename T>(T) { return static_cast<double>(load<T>(bytes, order)); });
}

//! Appends a value in a type; integers are rounded and kept in the range of the type, NaN becomes
//! 0.
inline void append_number(std::string& bytes, NumberType type, double value,
                          std::endian order = std::endian::little) {
    with_type(type, [&]<typename T>(T) {
        if constexpr (std::is_integral_v<T>) {
            constexpr double low = std::numeric_limits<T>::min(),
                             high = std::numeric_limits<T>::max();
            value = std::isnan(value) ? 0 : std::clamp(std::round(value), low, high);
        }
        append(bytes, static_cast<T>(value), order);
    });
}

}  // namespace remesh
