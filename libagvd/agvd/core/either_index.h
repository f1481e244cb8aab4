//! \file
//! Indices into one of two arrays.
#pragma once

#include <cassert>

#include "agvd/core/types.h"

namespace agvd {

//! An index into the first or the second of two arrays, in one word: the highest bit tells which.
//! Types that name the two arrays hold one of these.
class EitherIndex {
public:
    //! Neither.
    constexpr EitherIndex() = default;
    [[nodiscard]] static constexpr EitherIndex first(Index index) {
        assert(index < second_bit);
        return EitherIndex(index);
    }
    [[nodiscard]] static constexpr EitherIndex second(Index index) {
        assert(index < second_bit - 1);
        return EitherIndex(index | second_bit);
    }

    [[nodiscard]] constexpr bool is_valid() const { return word_ != no_index; }
    //! \pre is_valid()
    [[nodiscard]] constexpr bool is_second() const {
        assert(is_valid());
        return word_ >= second_bit;
    }
    [[nodiscard]] constexpr Index first() const {
        assert(!is_second());
        return word_;
    }
    [[nodiscard]] constexpr Index second() const {
        assert(is_second());
        return word_ - second_bit;
    }

    friend constexpr bool operator==(const EitherIndex&, const EitherIndex&) = default;

private:
    static constexpr Index second_bit = Index{1} << 31;

    explicit constexpr EitherIndex(Index word) : word_(word) {}

    Index word_ = no_index;
};

}  // namespace agvd
