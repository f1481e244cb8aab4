//! \file
//! Distances to the nearest of many segments, up to a limit.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "agvd/core/poller.h"
#include "agvd/core/types.h"

namespace remesh::detail {

//! Segments (a point is one of length 0) in a grid of cells; asked about within `reach`.
class SegmentGrid {
public:
    using Segment = std::pair<agvd::Vec3, agvd::Vec3>;

    //! \param reach  mesh units, > 0. Cost: O(n + length / reach).
    SegmentGrid(std::vector<Segment> segments, double reach, agvd::Ticker& ticker);

    //! To the nearest segment; infinity if it is farther than `reach`.
    [[nodiscard]] double distance(const agvd::Vec3& point) const;

private:
    struct Cell {
        agvd::Index begin = 0, end = 0;  // Of entries_.
    };

    std::vector<Segment> segments_;
    double reach_;
    std::vector<std::pair<std::uint64_t, agvd::Index>> entries_;  // (cell, segment), sorted.
    std::unordered_map<std::uint64_t, Cell> cells_;
};

}  // namespace remesh::detail
