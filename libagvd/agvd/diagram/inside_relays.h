//! \file
//! The relays by which labels reach into a face.
#pragma once

#include "agvd/diagram/edge_relays.h"

namespace agvd {

//! Gathers relays in a face's own frame, by ascending site. Keeps references; one for each thread.
class InsideRelays {
public:
    InsideRelays(const Surface& surface, const Propagation& propagation, const EdgeLabels& labels)
        : surface_(surface),
          propagation_(propagation),
          labels_(labels),
          edge_relays_(surface, propagation, labels) {}

    //! The face's own relays.
    void gather_own(Index mixed_index, std::vector<PlanarRelay>& out);

    //! What lies in the face, what won on its edges, its corners, and the label changes on its
    //! edges, which pin the arcs to the points where they enter. What won on an edge comes through
    //! the interval on which it won and nowhere else: inside the face every label is star-shaped
    //! with respect to an interval of its own on the boundary, or its site.
    void gather_all(Index mixed_index, std::vector<PlanarRelay>& out);

private:
    void append_winners(Index half_edge, std::vector<PlanarRelay>& out);
    void append_crossings(Index half_edge, std::vector<PlanarRelay>& out) const;

    const Surface& surface_;
    const Propagation& propagation_;
    const EdgeLabels& labels_;
    EdgeRelays edge_relays_;
    std::vector<std::pair<Index, Index>> order_;  // Site and relay.
    std::vector<LineRelay> on_edge_;
    std::vector<StraightPiece> pieces_;
};

}  // namespace agvd
