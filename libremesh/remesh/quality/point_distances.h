//! \file
//! Distances of a few points from the nearest of many segments, up to a limit.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "agvd/core/poller.h"
#include "agvd/core/types.h"

namespace remesh::detail {

//! Points in a grid of cells; segments pass by one after the other and are not kept.
class PointDistances {
public:
    //! \param reach  mesh units, > 0: what is farther away is not looked for.
    //! Cost: O(n log n).
    PointDistances(std::vector<agvd::Vec3> points, double reach, agvd::Ticker& ticker);

    //! A segment, or a point where both ends are the same. What is longer than the box of the
    //! points costs no more than what crosses it. Cost: O(1 + length / reach).
    void pass(const agvd::Vec3& a, const agvd::Vec3& b, agvd::Ticker& ticker);

    //! #points: from the nearest segment that has passed; infinity beyond `reach`.
    [[nodiscard]] const std::vector<double>& distances() const { return distances_; }

private:
    struct Cell {
        agvd::Index begin = 0, end = 0;  // Of entries_.
    };
    void look_around(const agvd::Vec3& at, const agvd::Vec3& a, const agvd::Vec3& b,
                     std::uint64_t& last_key);

    std::vector<agvd::Vec3> points_;
    std::vector<double> distances_;
    double reach_;
    agvd::Vec3 low_, high_;  // Of the points' box, by reach larger.
    std::vector<std::pair<std::uint64_t, agvd::Index>> entries_;  // (cell, point near it), sorted.
    std::unordered_map<std::uint64_t, Cell> cells_;
};

}  // namespace remesh::detail
