//! \file
//! Windows: a beam of straight shortest paths where it crosses an edge.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "agvd/core/types.h"

namespace agvd {

//! The straight paths from a site or pseudo-source through [begin, end] of a half-edge into its
//! face ([mitchell1987]). The image (x, y) of the source lies in the frame of the half-edge, y < 0.
//! The distance of a point p of the face through the window is at least weight + |image - p|, and a
//! real path exceeds that by at most `error`.
struct Window {
    double x, y;
    double weight;
    double begin, end;
    double at_begin, at_end;  //!< Distances at the ends of the interval.
    float error;
    bool is_served;  //!< The half-edges beyond the face have got their parts.

    //! Distance of a point of the edge. At the ends no root is taken.
    [[nodiscard]] double distance(double at) const {
        if (at == begin) return at_begin;
        if (at == end) return at_end;
        return weight + std::sqrt((at - x) * (at - x) + y * y);
    }
    //! The part over [from, to], which must lie inside [begin, end].
    [[nodiscard]] Window part(double from, double to) const {
        Window result = *this;
        result.at_begin = distance(from);
        result.at_end = distance(to);
        result.begin = from;
        result.end = to;
        return result;
    }
    //! Least distance over the interval. Without branches, which cannot be predicted.
    [[nodiscard]] double nearest() const {
        const std::array<double, 2> least{std::min(at_begin, at_end), weight - y};
        return least[static_cast<std::size_t>((begin < x) & (x < end))];
    }
};
static_assert(sizeof(Window) == 64);
static_assert(std::is_trivial_v<Window>);  // New memory is not initialized.

}  // namespace agvd
