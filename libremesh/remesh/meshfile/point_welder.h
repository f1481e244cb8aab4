//! \file
//! Gives equal points one index. Private to the STL reader and the measure of rounding.
#pragma once

#include <vector>

#include "agvd/core/random.h"
#include "remesh/names.h"

namespace remesh {

class PointWelder {
public:
    //! The index of the first point with exactly these coordinates; a new one if there is none.
    //! \param p  finite; -0 equals 0. Cost: O(1) expected.
    Index index_of(const Vec3& p) {
        if (2 * points_.size() >= slots_.size()) {
            slots_.assign(slots_.empty() ? 1024 : 2 * slots_.size(), no_index);
            for (Index i = 0; i < points_.size(); ++i) slot_of(points_[i]) = i;
        }
        Index& slot = slot_of(p);
        if (slot == no_index) {
            slot = static_cast<Index>(points_.size());
            points_.push_back(p);
        }
        return slot;
    }

    //! Indexed by index_of, in the order of first arrival.
    [[nodiscard]] std::vector<Vec3>& points() { return points_; }

private:
    // The slot that holds p's index, or the free one where it belongs.
    Index& slot_of(const Vec3& p) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t i = PositionHash{}(p)&mask;
        while (slots_[i] != no_index && points_[slots_[i]] != p) i = (i + 1) & mask;
        return slots_[i];
    }

    std::vector<Vec3> points_;
    std::vector<Index> slots_;  // Open addressing, 2^k slots, at most half of them taken.
};

}  // namespace remesh
