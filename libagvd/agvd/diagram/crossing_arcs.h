//! \file
//! Arcs of one triangle that cross.
#pragma once

#include <vector>

#include "agvd/diagram/local_diagram.h"

namespace agvd {

//! Where an arc begins and ends.
struct ArcPlace {
    Vec2 tail, head;
};

//! A piece of an arc.
struct ArcSegment {
    Index arc;
    Vec2 from, to;
};

//! Takes the inner points away from arcs that cross others, or themselves.
//! \param since    the arcs from there on are looked at.
//! \param places   of these arcs.
//! \param scratch  memory.
//! \return false: there were none.
//! Cost: O(n^2) for n pieces.
[[nodiscard]] bool straighten_crossing_arcs(const LocalDiagram::Mark& since,
                                            std::span<const ArcPlace> places,
                                            std::vector<ArcSegment>& scratch, LocalDiagram& out);

}  // namespace agvd
