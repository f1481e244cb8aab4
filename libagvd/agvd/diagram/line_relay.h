//! \file
//! Relays as seen from a straight segment.
//!
//! The segment lies on the x axis and begins at the origin. The distance from a site through a
//! relay is f(x) = w + sqrt((x - a)^2 + b^2), with the source (a, b) of the last straight piece of
//! the path at distance w from the site: the image, or the end of the interval where paths bend.
#pragma once

#include "agvd/diagram/face_relays.h"

namespace agvd {

// Tolerances of label changes on a segment, as shares of its length. Changes nearer to each other
// are not told apart.
inline constexpr double shortest_interval = 1e-9;
// At a change the two distances are equal up to this: below it lies rounding.
inline constexpr double equal_distances = 1e-11;

//! Up to x = `first` paths bend at one end of the interval (source 0), from `last` on at the other
//! end (source 2), and between they come straight from the image (source 1).
struct LineRelay {
    std::array<double, 3> x, y, weight;  //!< Of the three sources.
    double first, last;
    Index site;
};

//! Distance at a point of the segment, its derivative (at a source itself: that to the right), and
//! the source of the last straight piece.
struct LineSample {
    double value, slope;
    int source;
};

[[nodiscard]] inline LineSample sample(const LineRelay& relay, double x) {
    const int i = x < relay.first ? 0 : x > relay.last ? 2 : 1;
    const auto k = static_cast<std::size_t>(i);
    const double dx = x - relay.x[k];
    const double norm = std::sqrt(dx * dx + relay.y[k] * relay.y[k]);
    return {relay.weight[k] + norm, norm > 0 ? dx / norm : 1.0, i};
}

//! A relay on a segment from `start` in a direction of length 1.
[[nodiscard]] LineRelay on_line(const PlanarRelay& relay, const Vec2& start, const Vec2& along,
                                double length);

//! A point at (x, 0).
[[nodiscard]] inline LineRelay point_on_line(double x, double weight, Index site) {
    return {{x, x, x}, {0, 0, 0}, {weight, weight, weight}, -infinity, infinity, site};
}

//! The same value as sample(), without the slope.
[[nodiscard]] inline double value_at(const LineRelay& relay, double x) {
    const std::size_t k = x < relay.first ? 0 : x > relay.last ? 2 : 1;
    const double dx = x - relay.x[k];
    return relay.weight[k] + std::sqrt(dx * dx + relay.y[k] * relay.y[k]);
}

//! Least distance over the relays of one site; infinity if it has none.
[[nodiscard]] double distance_on_line(std::span<const LineRelay> relays, Index site, double x);

//! From `begin` to `end` (lengths along the segment) a site is reached straight from `from`, itself
//! at distance `weight` from it.
struct StraightPiece {
    Vec2 from;
    double weight;
    double begin, end;
    Index site;
};

//! Appends what the relays of one site say about a stretch of the segment.
void append_pieces(std::span<const LineRelay> relays, Index site, double begin, double end,
                   std::vector<StraightPiece>& out);

}  // namespace agvd
