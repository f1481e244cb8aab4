//! \file
//! What of a diagram a change of its propagation touches.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/surface.h"

namespace agvd {

//! Labels and arcs depend on nothing but the relays of the faces next to them and the labels of
//! their corners.
class TouchedParts {
public:
    //! All is touched.
    explicit TouchedParts(const Surface& surface) : surface_(surface), is_all_(true) {}
    //! \param faces  those whose relays, or the distances of whose corners, are others now, and
    //!               those to be done anew for other reasons.
    TouchedParts(const Surface& surface, std::span<const Index> faces);

    [[nodiscard]] bool is_all() const { return is_all_; }
    //! Corners of those faces, unless all is touched.
    [[nodiscard]] const std::vector<Index>& vertices() const { return vertices_; }
    //! Ascending: the faces around those vertices, unless all is touched. What lies outside is as
    //! it was.
    [[nodiscard]] const std::vector<Index>& faces() const { return faces_; }

    //! Whether it is one of these.
    [[nodiscard]] bool is_near(Index face) const { return is_all_ || is_near_[face] != 0; }

    //! Says that a vertex has the label and distance that it had.
    void clear_vertex(Index vertex) { is_vertex_touched_[vertex] = 0; }

    //! Whether all is as it was that its row depends on.
    [[nodiscard]] bool holds_on_edge(Index half_edge) const;
    //! On all its edges.
    [[nodiscard]] bool holds_on_edges_of(Index face) const;

    //! Says whether an edge on which not all holds has the row that it had.
    void settle_edge(Index edge, bool is_same) {
        if (!is_all_) edge_states_[edge] = is_same ? EdgeState::Same : EdgeState::Other;
    }
    [[nodiscard]] bool is_settled(Index edge) const {
        return edge_states_[edge] != EdgeState::Unknown;
    }
    //! Whether all is as it was that the arcs of a face depend on, when its edges are settled.
    //! \param is_local  the arcs depend on no relays of other faces.
    [[nodiscard]] bool holds_in_face(Index face, bool is_local) const;

private:
    enum class EdgeState : std::uint8_t { Unknown, Same, Other };

    [[nodiscard]] bool is_touched(Index face) const;

    const Surface& surface_;
    bool is_all_ = false;
    std::vector<Index> vertices_, faces_;
    std::vector<std::uint8_t> is_face_touched_;    // #F
    std::vector<std::uint8_t> is_near_;            // #F
    std::vector<std::uint8_t> is_vertex_touched_;  // #V
    std::vector<EdgeState> edge_states_;           // #E
};

}  // namespace agvd
