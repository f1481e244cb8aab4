//! \file
//! Which labels and arcs of a diagram a change of its propagation may change.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/surface.h"

namespace agvd {

//! The labels on an edge depend on the relays of its faces and the labels of its ends, and on
//! nothing else; the arcs in a face on its relays, the labels on its edges, and at times on the
//! relays of its neighbours. What depends on nothing that was touched holds.
class TouchedParts {
public:
    //! \param faces  those whose relays, or the distances of whose corners, have changed, and
    //!               others that are to be labelled again.
    TouchedParts(const Surface& surface, std::span<const Index> faces);

    //! The corners of those faces.
    [[nodiscard]] const std::vector<Index>& vertices() const { return vertices_; }
    //! Ascending: the faces around those vertices. All else holds.
    [[nodiscard]] const std::vector<Index>& faces() const { return faces_; }
    //! Whether it is one of faces().
    [[nodiscard]] bool is_near(Index face) const { return is_near_[face] != 0; }

    //! Says that a vertex has the label and distance that it had.
    void clear_vertex(Index vertex) { is_vertex_touched_[vertex] = 0; }

    //! Whether the labels on an edge hold.
    [[nodiscard]] bool holds_on_edge(Index half_edge) const;
    //! On all edges of a face.
    [[nodiscard]] bool holds_on_edges_of(Index face) const;

    //! Says whether an edge on which labels need not hold has those that it had.
    void settle_edge(Index edge, bool is_same) {
        edge_states_[edge] = is_same ? EdgeState::Same : EdgeState::Other;
    }
    [[nodiscard]] bool is_settled(Index edge) const {
        return edge_states_[edge] != EdgeState::Unknown;
    }
    //! Whether the arcs of a face hold, when its edges are settled.
    //! \param is_local  the arcs depend on no relays of other faces.
    [[nodiscard]] bool holds_in_face(Index face, bool is_local) const;

private:
    enum class EdgeState : std::uint8_t { Unknown, Same, Other };

    [[nodiscard]] bool is_touched(Index face) const;

    const Surface& surface_;
    std::vector<Index> vertices_, faces_;
    std::vector<std::uint8_t> is_face_touched_;    // #F
    std::vector<std::uint8_t> is_near_;            // #F
    std::vector<std::uint8_t> is_vertex_touched_;  // #V
    std::vector<EdgeState> edge_states_;           // #E
};

}  // namespace agvd
