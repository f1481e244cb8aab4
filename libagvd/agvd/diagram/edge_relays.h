//! \file
//! The relays that matter on one mesh edge.
#pragma once

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/envelope.h"

namespace agvd {

//! Gathers the relays of both faces of an edge and its ends in the frame of the edge_half. Keeps
//! references; one for each thread.
class EdgeRelays {
public:
    EdgeRelays(const Surface& surface, const Propagation& propagation, const EdgeLabels& labels)
        : surface_(surface), propagation_(propagation), labels_(labels) {}

    //! Whether labels may change on an edge, all of whose faces are listed. Then `relays` holds
    //! those that could be the nearest somewhere on it. Distances grow no faster than the point
    //! moves, and are convex along the edge: most relays lose by what they say at its ends.
    [[nodiscard]] bool may_change(Index edge, std::vector<LineRelay>& relays);

    //! The same relays of any such edge.
    void gather(Index edge, std::vector<LineRelay>& relays);

private:
    struct Candidate {
        double lo, hi;              // Distances of the two ends,
        double slope_lo, slope_hi;  // and bounds of their derivatives along the edge.
        Index relay;
        Index site;
        Index base;  // The half-edge of the edge in whose face the relay is seen.
    };

    void scan(Index edge);
    void scan_across(Index edge, Index half_edge);
    void scan_others(Index edge, Index half_edge);
    // Calls each(index) for those of a face's relays that are in question, in their order.
    template <typename IsInQuestion, typename Each>
    void for_each_relay(Index half_edge, const IsInQuestion& is_in_question,
                        const Each& each) const;
    void add_distances(Index edge, Index half_edge, Index relay);
    [[nodiscard]] LineRelay through_face(Index base, const Relay& relay) const;
    void append_all(Index edge, std::vector<LineRelay>& relays) const;

    const Surface& surface_;
    const Propagation& propagation_;
    const EdgeLabels& labels_;
    std::vector<Candidate> candidates_;
    // The end itself is nearer to its site than any relay says.
    bool needs_tail_ = false, needs_head_ = false;
};

}  // namespace agvd
