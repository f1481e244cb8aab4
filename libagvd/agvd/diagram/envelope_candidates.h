//! \file
//! Which relays cannot be the nearest on a stretch of a segment.
#pragma once

#include <algorithm>
#include <cmath>

#include "agvd/diagram/line_relay.h"

namespace agvd {

//! A relay with its distances at both ends of a stretch [lo, hi].
struct Candidate {
    const LineRelay* relay;
    LineSample lo, hi;
};

//! Distances that differ by less are tied.
//! \param length  of the whole segment.
[[nodiscard]] inline double tie_at(double distance, double length) {
    return tie_tolerance * (distance + length);
}

//! Turns a sample at x into one from the left. The segment may pass through the source itself: then
//! the slope changes there.
[[nodiscard]] inline LineSample from_left(const LineRelay& relay, double x, LineSample s) {
    const auto k = static_cast<std::size_t>(s.source);
    if (relay.y[k] == 0 && relay.x[k] == x) s.slope = -1;
    return s;
}

//! Seen from x, two images differ in direction by at most their distance from each other over the
//! distance of either. Distances from images that are near each other are thus nearly parallel:
//! this decides without bisecting whether one is above the other.
[[nodiscard]] inline bool is_parallel_above(const Candidate& c, const Candidate& b, double width,
                                            double slack) {
    if (c.lo.source != c.hi.source || b.lo.source != b.hi.source) return false;
    const auto i = static_cast<std::size_t>(c.lo.source);
    const auto j = static_cast<std::size_t>(b.lo.source);
    const double dx = c.relay->x[i] - b.relay->x[j];
    // Along the segment only the distance from its line matters, not the side.
    const double dy = std::abs(c.relay->y[i]) - std::abs(b.relay->y[j]);
    if (dx == 0 && dy == 0) return true;
    const double range = b.lo.value - b.relay->weight[j] - width;
    if (!(range > 0)) return false;
    const double gap = std::min(c.lo.value - b.lo.value, c.hi.value - b.hi.value) + slack;
    return gap >= 0 && gap * gap * range * range >= width * width * (dx * dx + dy * dy);
}

//! True if c cannot be below b anywhere on the stretch by more than the slack: distances are
//! convex, so c lies above its tangents at the ends and b below its chord.
[[nodiscard]] inline bool is_above(const Candidate& c, const Candidate& b, double width,
                                   double slack) {
    if (c.lo.value < b.lo.value - slack || c.hi.value < b.hi.value - slack) return false;
    const double rise = b.hi.value - b.lo.value;
    // A tangent that leaves the chord upwards stays above it.
    if (c.lo.slope * width >= rise || c.hi.slope * width <= rise) return true;
    // Else the tangents meet at lo + t; above the chord there means above it everywhere.
    const double t = (c.lo.value - c.hi.value + c.hi.slope * width) / (c.hi.slope - c.lo.slope);
    return c.lo.value + c.lo.slope * t >= b.lo.value + rise * (t / width) - slack ||
           is_parallel_above(c, b, width, slack);
}

//! Where the distances from the sites of a and b are equal on the stretch: a is nearer at lo, b at
//! hi. Newton, relay against relay, until no other relay of the two sites is nearer at the root.
//! \param candidates  a and b among them.
//! \param length      of the whole segment.
[[nodiscard]] double find_equal(std::span<const Candidate> candidates, const Candidate& a,
                                const Candidate& b, const std::array<double, 2>& stretch,
                                double length);

}  // namespace agvd
