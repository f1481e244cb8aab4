//! \file
//! The lower envelope of relays along a segment: which site is nearest where.
#pragma once

#include "agvd/diagram/envelope_candidates.h"

namespace agvd {

//! One stretch of a segment with one nearest site, up to parameter `end` in [0, 1].
struct LabelInterval {
    double end;
    Index site;
};

//! A segment and the sites of its ends.
struct LabelledSegment {
    double length;
    Index site_at_start, site_at_end;
};

//! Scratch memory, so that a loop over many segments allocates once.
struct EnvelopeScratch {
    std::vector<Candidate> candidates, left, right;
};

//! Replaces `out` by the intervals of a segment, in order: neighbours differ, the last end is 1.
//!
//! Distances along a straight segment are convex, so a relay whose tangents stay above the chord of
//! another cannot win. The rest is bisected until one site, or one crossing of two sites, is left.
//! Sites closer than rounding count as tied, and the lowest index takes them. The first and last
//! interval get the sites of the ends, with no length if need be, so that all segments at a corner
//! agree on its site.
//! \param relays  not empty.
void label_envelope(std::span<const LineRelay> relays, const LabelledSegment& segment,
                    EnvelopeScratch& scratch, std::vector<LabelInterval>& out);

}  // namespace agvd
