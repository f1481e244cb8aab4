//! \file
//! Windows: what one straight beam of shortest paths knows where it crosses an edge.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "agvd/core/types.h"

namespace agvd {

//! Straight paths from the (pseudo-)source at `image` through [begin, end] of a half-edge into its
//! face, in the frame of that half-edge, y < 0 ([mitchell1987]). The distance of a point p beyond
//! is weight + |image - p| from below: a real path of at most `error` more leads there.
struct Window {
    double x, y;
    double weight;
    double begin, end;
    double at_begin, at_end;  //!< Distances of the interval's ends.
    float error;
    bool is_served;  //!< Its children have been sent on.

    //! Distance of a point of the edge; the ends cost nothing.
    [[nodiscard]] double distance(double at) const {
        if (at == begin) return at_begin;
        if (at == end) return at_end;
        return weight + std::sqrt((at - x) * (at - x) + y * y);
    }
    //! The part of it over [from, to], which must lie inside [begin, end].
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
static_assert(std::is_trivial_v<Window>);  // New memory is not written before it is used.

}  // namespace agvd
