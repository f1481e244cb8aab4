//! \file
//! The lower envelope of relays along a segment (a mesh edge or a cut): which site is nearest
//! where.
#pragma once

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/face_relays.h"

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

//! A relay with its distances at both ends of a stretch [lo, hi].
struct Candidate {
    const LineRelay* relay;
    LineSample lo, hi;
};

//! Scratch memory, so that a loop over many segments allocates once.
struct EnvelopeScratch {
    std::vector<Candidate> candidates, left, right;
    std::vector<LabelInterval> intervals;  //!< Of label_line().
};

//! Replaces `out` by the intervals of a segment, in order: neighbours differ, the last end is 1.
//!
//! A relay whose tangents stay above the chord of another cannot win, as distances are convex. The
//! rest is bisected until one site, or one crossing of two sites, is left. Ties go to the lowest
//! index. The first and last interval get the sites of the ends, so that all segments at a corner
//! agree on its site.
//! \param relays  not empty.
void label_envelope(std::span<const LineRelay> relays, const LabelledSegment& segment,
                    EnvelopeScratch& scratch, std::vector<LabelInterval>& out);

//! A point of a segment where two sites are equally near.
struct SingleCrossing {
    double at;        //!< Length from the start.
    double distance;  //!< From both sites.
};

//! Where the label changes from site a, at the start of a segment, to site b, if tangents at the
//! change against chords prove that there is no other change and no third site between.
//! \return none if that is not certain: see label_envelope.
[[nodiscard]] std::optional<SingleCrossing> find_single_crossing(std::span<const LineRelay> relays,
                                                                 double length, Index a, Index b);

//! Appends the label changes on a line, in their order.
//! \param relays  all that are the nearest somewhere on it.
//! Cost: O(relays) and a few square roots a label change, most often.
void label_line(std::span<const LineRelay> relays, LineId line, const LabelledSegment& segment,
                EnvelopeScratch& scratch, std::vector<Crossing>& out);

//! Moves the label changes of a line to where rounding alone is left: label_line() stops a little
//! before, and tells relays of one site apart up to a share of the segment only. Their order stays.
//! Cost: O(relays) for each.
void settle_crossings(std::span<const LineRelay> relays, double length,
                      std::span<Crossing> crossings);

}  // namespace agvd
