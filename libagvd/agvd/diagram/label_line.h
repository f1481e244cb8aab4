//! \file
//! Label changes along one mesh edge or cut.
#pragma once

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/envelope.h"

namespace agvd {

//! Scratch memory.
struct LineScratch {
    EnvelopeScratch envelope;
    std::vector<LabelInterval> intervals;
};

//! Appends the label changes on a line, in their order.
//! \param relays  all that are the nearest somewhere on it.
//! Cost: O(relays) and a few square roots a label change, most often.
void label_line(std::span<const LineRelay> relays, LineId line, const LabelledSegment& segment,
                LineScratch& scratch, std::vector<Crossing>& out);

}  // namespace agvd
