//! \file
//! The lower envelope of relays along a segment: which site is nearest where.
#pragma once

#include <limits>

#include "agvd/diagram/face_relays.h"

namespace agvd {

//! A relay seen from a segment that begins at the origin and runs along the x axis: up to `first`
//! paths bend at one end of its interval (source 0), from `last` on at the other (source 2), and
//! between they come straight from the image (source 1).
struct LineRelay {
    std::array<double, 3> x, y, weight;  //!< Of the three sources.
    double first, last;
    Index site;
};

//! Distance along the segment, its derivative (at a source itself: that to the right), and the
//! source of the last straight piece.
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
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {{x, x, x}, {0, 0, 0}, {weight, weight, weight}, -infinity, infinity, site};
}

//! Least distance over the relays of one site; infinity if it has none.
[[nodiscard]] double distance_on_line(std::span<const LineRelay> relays, Index site, double x);

//! One stretch of a segment with one nearest site, up to parameter `end` in [0, 1].
struct LabelInterval {
    double end;
    Index site;
};

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

//! Scratch memory, so that a loop over many segments allocates once.
struct EnvelopeScratch {
    struct Candidate {
        const LineRelay* relay;
        LineSample lo, hi;
    };
    std::vector<Candidate> candidates, left, right;
};

//! Where the label changes from site a, at the start of a segment, to b, if that is certain:
//! tangents show that there is one change only and no other site between. A cheap answer for most
//! segments; false: ask label_envelope.
[[nodiscard]] bool find_single_crossing(std::span<const LineRelay> relays, double length, Index a,
                                        Index b, double& at, double& distance);

//! Replaces `out` by the intervals of a segment, in order: neighbours differ, the last end is 1.
//!
//! Distances along a straight segment are convex, so a relay whose tangents stay above the chord of
//! another cannot win; what is left is bisected until one site, or one crossing of two sites, is
//! left. Sites closer than rounding count as tied, and the lowest index takes them.
//! The first and last interval get the sites named, with no length if need be, so that all segments
//! at a corner agree on its site. `pieces`, if asked for, gets what won and where.
void label_envelope(std::span<const LineRelay> relays, double length, Index site_at_start,
                    Index site_at_end, EnvelopeScratch& scratch, std::vector<LabelInterval>& out);

}  // namespace agvd
