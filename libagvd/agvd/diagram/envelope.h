//! \file
//! The lower envelope of relays along a segment: which site is nearest where.
#pragma once

#include "agvd/diagram/face_relays.h"

namespace agvd {

//! One stretch of a segment with one nearest site, up to parameter `end` in [0, 1].
struct LabelInterval {
    double end;
    Index site;
};

//! A straight stretch of the envelope: from parameter `begin` to `end` (lengths along the segment)
//! the nearest site is reached straight from `from`, itself at distance `weight` from the site.
//! Several may overlap where one site is reached in several ways.
struct EnvelopePiece {
    Vec2 from;
    double weight;
    double begin, end;
    Index site;
};

//! Scratch memory, so that a loop over many segments allocates once.
struct EnvelopeScratch {
    struct Candidate {
        const PlanarRelay* relay;
        double value_lo, slope_lo;
        double value_hi, slope_hi;
        Vec2 from_lo, from_hi;  // Where the last straight piece begins, at both ends.
    };
    std::vector<Candidate> candidates, left, right;
};

//! Replaces `out` by the intervals from p to q, in order: neighbours differ, the last end is 1.
//!
//! Distances along a straight segment are convex, so a relay whose tangents stay above the chord of
//! another cannot win; what is left is bisected until one site, or one crossing of two relays, is
//! left. Sites closer than rounding count as tied, and the lowest index takes them.
//! The first and last interval get the sites named, with no length if need be, so that all segments
//! at a corner agree on its site. `pieces`, if asked for, gets what won and where.
void label_envelope(std::span<const PlanarRelay> relays, const Vec2& p, const Vec2& q,
                    Index site_at_p, Index site_at_q, EnvelopeScratch& scratch,
                    std::vector<LabelInterval>& out, std::vector<EnvelopePiece>* pieces = nullptr);

}  // namespace agvd
