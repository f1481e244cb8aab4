//! \file
//! What waits in the queue of the window engine.
#pragma once

#include <cassert>
#include <compare>

#include "agvd/core/types.h"

namespace agvd {

//! The record of a half-edge or of a pseudo-source, in one word: bit 0 tells which.
class FrontItem {
public:
    [[nodiscard]] static constexpr FrontItem half_edge(Index record) {
        assert(record < most_records);
        return FrontItem(2 * record);
    }
    [[nodiscard]] static constexpr FrontItem pseudo_source(Index record) {
        assert(record < most_records);
        return FrontItem(2 * record + 1);
    }

    [[nodiscard]] constexpr bool is_pseudo_source() const { return word_ % 2 == 1; }
    [[nodiscard]] constexpr Index record() const { return word_ / 2; }

    //! Any order that is the same in every run.
    constexpr auto operator<=>(const FrontItem&) const = default;

private:
    static constexpr Index most_records = Index{1} << 31;

    explicit constexpr FrontItem(Index word) : word_(word) {}

    Index word_;
};
static_assert(sizeof(FrontItem) == sizeof(Index));

}  // namespace agvd
