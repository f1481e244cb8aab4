//! \file
//! Names for the faces before and after the operations of a history. Private to intrinsic.
#pragma once

#include <cassert>

#include "agvd/core/types.h"

namespace agvd::detail {

//! A face before or after an operation, in one word. A flip or split is named by its place among
//! the flips and splits and by a slot, 0 or 1; a merge by its place among the merges and a slot, 0
//! to 2. The highest bit tells which. Default: none.
class FaceLink {
public:
    constexpr FaceLink() = default;
    [[nodiscard]] static constexpr FaceLink operation(Index place, Index slot) {
        assert(place < first_merge / 2 && slot < 2);
        return FaceLink(2 * place + slot);
    }
    [[nodiscard]] static constexpr FaceLink merge(Index place, Index slot) {
        assert(place < first_merge / 4 && slot < 3);
        return FaceLink(first_merge + 4 * place + slot);
    }

    [[nodiscard]] constexpr bool is_none() const { return word_ == no_index; }
    [[nodiscard]] constexpr bool is_merge() const { return word_ >= first_merge && !is_none(); }
    //! Of the operation. Not if is_none(), as slot().
    [[nodiscard]] constexpr Index place() const {
        return word_ >= first_merge ? (word_ - first_merge) / 4 : word_ / 2;
    }
    [[nodiscard]] constexpr Index slot() const {
        return word_ >= first_merge ? (word_ - first_merge) % 4 : word_ % 2;
    }

private:
    static constexpr Index first_merge = Index{1} << 31;

    explicit constexpr FaceLink(Index word) : word_(word) {}

    Index word_ = no_index;
};
static_assert(sizeof(FaceLink) == sizeof(Index));

}  // namespace agvd::detail
