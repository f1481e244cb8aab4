//! \file
//! The ends of arcs.
#pragma once

#include "agvd/core/types.h"

namespace agvd {

//! The tail or the head of an arc, in one word.
class ArcEnd {
public:
    //! None.
    constexpr ArcEnd() = default;
    [[nodiscard]] static constexpr ArcEnd tail_of(Index arc) { return ArcEnd(2 * arc); }
    [[nodiscard]] static constexpr ArcEnd head_of(Index arc) { return ArcEnd(2 * arc + 1); }

    [[nodiscard]] constexpr bool is_valid() const { return word_ != no_index; }
    [[nodiscard]] constexpr Index arc() const { return word_ / 2; }
    [[nodiscard]] constexpr bool is_tail() const { return word_ % 2 == 0; }
    //! Of the same arc.
    [[nodiscard]] constexpr ArcEnd other() const { return ArcEnd(word_ ^ 1); }
    //! Among the ends of consecutive arcs: tail, head, tail of the next one, and so on.
    [[nodiscard]] constexpr Index place_from(Index first_arc) const {
        return word_ - 2 * first_arc;
    }

    friend constexpr bool operator==(const ArcEnd&, const ArcEnd&) = default;

private:
    explicit constexpr ArcEnd(Index word) : word_(word) {}

    Index word_ = no_index;
};

}  // namespace agvd
