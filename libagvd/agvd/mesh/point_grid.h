//! \file
//! Finds the points near a position by a grid.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "agvd/core/random.h"
#include "agvd/core/types.h"

namespace agvd {

//! Points by cell, named by numbers. A slot of its hash table may hold those of several cells.
class PointGrid {
public:
    PointGrid(const Vec3& low, double cell, std::size_t num_points)
        : low_(low), cell_(cell), first_(std::bit_ceil(2 * num_points), no_index) {}

    //! Calls visit(number) for all that were added within `radius` of p, and maybe some others.
    //! \param radius  less than half a cell.
    template <typename Visit>
    void visit_near(const Vec3& p, double radius, const Visit& visit) const {
        std::array<std::size_t, 8> seen;
        std::size_t num_seen = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
            const std::size_t slot = slot_of(p + radius * side);
            const auto end = seen.begin() + static_cast<std::ptrdiff_t>(num_seen);
            if (std::find(seen.begin(), end, slot) != end) continue;
            seen[num_seen++] = slot;
            for (Index i = first_[slot]; i != no_index; i = entries_[i].next) {
                visit(entries_[i].point);
            }
        }
    }

    //! Adds a point.
    void add(const Vec3& p, Index point) {
        Index& first = first_[slot_of(p)];
        entries_.push_back({point, first});
        first = static_cast<Index>(entries_.size() - 1);
    }

private:
    struct Entry {
        Index point, next;
    };

    [[nodiscard]] std::size_t slot_of(const Vec3& p) const {
        const Vec3 cell = ((p - low_) / cell_).array().floor();
        return PositionHash{}(cell) & (first_.size() - 1);
    }

    Vec3 low_;
    double cell_;
    std::vector<Index> first_;  // By slot: the entry added last.
    std::vector<Entry> entries_;
};

}  // namespace agvd
