//! \file
//! The relays that matter on one mesh edge and inside one face.
#pragma once

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/face_relays.h"

namespace agvd {

//! Keeps references; one for each thread.
class RelayGatherer {
public:
    RelayGatherer(const Surface& surface, const Propagation& propagation, const EdgeLabels& labels)
        : surface_(surface), propagation_(propagation), labels_(labels) {}

    //! Whether labels may change on an edge, all of whose faces are listed. Then `relays` holds
    //! those of both faces and of its ends that could be the nearest somewhere on it, in the frame
    //! of the edge_half. Distances grow no faster than the point moves, and are convex along the
    //! edge: most relays lose by what they say at its ends.
    [[nodiscard]] bool may_change(Index edge, std::vector<LineRelay>& relays);

    //! The face's own relays, in its own frame, by ascending site.
    void gather_own(Index mixed_index, std::vector<PlanarRelay>& out);

    //! What lies in the face, what won on its edges, its corners, and the label changes on its
    //! edges, which pin the arcs to the points where they enter. What won on an edge comes through
    //! the interval on which it won and nowhere else: inside the face every label is star-shaped
    //! with respect to an interval of its own on the boundary, or its site.
    void gather_all(Index mixed_index, std::vector<PlanarRelay>& out);

private:
    struct Candidate {
        double lo, hi;              // Distances of the two ends,
        double slope_lo, slope_hi;  // and bounds of their derivatives along the edge.
        const Relay* relay;
        Index site;
        Index base;  // The half-edge of the edge in whose face the relay is seen.
    };

    // Of the face.
    [[nodiscard]] std::span<const Relay> relays_at(Index half_edge) const {
        return relays_of(propagation_, labels_.mixed_index[Surface::face(half_edge)]);
    }
    void scan(Index edge);
    void scan_across(Index edge, Index half_edge);
    void scan_others(Index edge, Index half_edge);
    void add_distances(Index edge, Index half_edge, const Relay& relay);
    [[nodiscard]] LineRelay through_face(Index base, const Relay& relay) const;
    void put_candidates(Index edge, std::vector<LineRelay>& relays) const;
    [[nodiscard]] bool is_listed(Index half_edge) const;
    void append_winners(Index half_edge, std::vector<PlanarRelay>& out);
    void append_crossings(Index half_edge, std::vector<PlanarRelay>& out) const;

    const Surface& surface_;
    const Propagation& propagation_;
    const EdgeLabels& labels_;
    std::vector<Candidate> candidates_;  // Of the edge at hand.
    // The end itself is nearer to its site than any relay says.
    bool needs_tail_ = false, needs_head_ = false;
    std::vector<std::pair<Index, Index>> order_;  // Site and relay.
    std::vector<LineRelay> on_edge_;
    std::vector<StraightPiece> pieces_;
};

}  // namespace agvd
