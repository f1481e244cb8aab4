//! \file
//! The relays by which labels reach into a face.
#pragma once

#include "agvd/diagram/edge_relays.h"

namespace agvd {

//! Gathers relays in a face's own frame, site by site. Keeps references; one for each thread.
class InsideRelays {
public:
    InsideRelays(const Surface& surface, const Propagation& propagation, const RelayGroups& groups,
                 const EdgeLabels& labels)
        : surface_(surface),
          propagation_(propagation),
          labels_(labels),
          edge_relays_(surface, propagation, groups, labels) {}

    //! The face's own relays of some sites, in their order.
    void gather_own(Index mixed_index, std::span<const Index> sites, std::vector<PlanarRelay>& out);

    //! What lies in the face, what won on its edges, its corners, and the label changes on its
    //! edges, which pin the arcs to the points where they enter. What won on an edge comes through
    //! the interval on which it won and nowhere else: inside the face every label is star-shaped
    //! with respect to an interval of its own on the boundary, or its site. By ascending site.
    void gather_all(Index mixed_index, std::vector<PlanarRelay>& out);

private:
    void append_winners(Index half_edge, std::vector<PlanarRelay>& out);
    void append_crossings(Index half_edge, std::vector<PlanarRelay>& out) const;

    const Surface& surface_;
    const Propagation& propagation_;
    const EdgeLabels& labels_;
    EdgeRelays edge_relays_;
    std::vector<Index> places_, next_;
    std::vector<LineRelay> on_edge_;
    std::vector<LabelInterval> intervals_;
    std::vector<EnvelopePiece> pieces_;
    EnvelopeScratch scratch_;
};

}  // namespace agvd
