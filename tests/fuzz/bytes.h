//! \file
//! The bytes of libFuzzer, taken one value after the other.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>

#include "agvd/core/types.h"

namespace fuzz {

//! Every sequence of bytes is good for everything: where they end, zeros follow.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

    [[nodiscard]] bool is_empty() const { return left_.empty(); }

    //! Of a type whose every bit pattern is a value.
    template <typename T>
    T take() {
        T value{};
        const std::size_t size = std::min(sizeof(T), left_.size());
        std::memcpy(&value, left_.data(), size);
        left_ = left_.subspan(size);
        return value;
    }

    //! In [0, count), count from 1 to 256: one byte.
    agvd::Index below(std::size_t count) {
        return static_cast<agvd::Index>(take<std::uint8_t>() % count);
    }
    bool flip() { return below(2) == 1; }

    //! One of a few values.
    template <typename T, std::size_t N>
    T pick(const T (&values)[N]) {
        return values[below(N)];
    }

private:
    std::span<const std::uint8_t> left_;
};

}  // namespace fuzz
