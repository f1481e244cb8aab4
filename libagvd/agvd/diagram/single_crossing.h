//! \file
//! The one label change of most segments, by tangents.
#pragma once

#include <optional>

#include "agvd/diagram/line_relay.h"

namespace agvd {

//! A point of a segment where two sites are equally near.
struct SingleCrossing {
    double at;        //!< Length from the start.
    double distance;  //!< From both sites.
};

//! Where the label changes from site a, at the start of a segment, to site b. Distances through one
//! relay along a segment are convex: tangents at the change that stay above the chords of the
//! nearer site's relay prove that there is no other change and no third site between.
//! \return none if that is not certain: see envelope.h.
//! Cost: O(relays) and a few square roots each.
[[nodiscard]] std::optional<SingleCrossing> find_single_crossing(std::span<const LineRelay> relays,
                                                                 double length, Index a, Index b);

}  // namespace agvd
