//! \file
//! Distances of a few points from the nearest of many segments, up to a limit.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Stores points in a grid of cells; segments are passed one after the other and not stored.
class PointDistances {
public:
    //! \param reach  mesh units, > 0: larger distances are not searched for.
    //! Cost: O(n log n).
    PointDistances(std::vector<Vec3> points, double reach, Ticker& ticker);

    //! Takes a segment, or a point if both ends are equal. Only the part inside the box of the
    //! points costs time. Cost: O(1 + length / reach).
    void pass(const Vec3& a, const Vec3& b, Ticker& ticker);

    //! #points: from the nearest segment that has passed; infinity beyond `reach`.
    [[nodiscard]] const std::vector<double>& distances() const { return distances_; }

private:
    struct Cell {
        Index begin = 0, end = 0;  // Of entries_.
    };
    void look_around(const Vec3& at, const Vec3& a, const Vec3& b, std::uint64_t& last_key);

    std::vector<Vec3> points_;
    std::vector<double> distances_;
    double reach_;
    Vec3 low_, high_;                                       // The points' box, enlarged by reach.
    std::vector<std::pair<std::uint64_t, Index>> entries_;  // (cell, point near it), sorted.
    std::unordered_map<std::uint64_t, Cell> cells_;
};

}  // namespace remesh::detail
