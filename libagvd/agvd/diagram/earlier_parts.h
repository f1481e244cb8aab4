//! \file
//! What an earlier diagram was made of, for the next one to take over what still holds.
#pragma once

#include "agvd/diagram/diagram.h"
#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/face_arcs.h"

namespace agvd {

//! Listed faces come in chunks of `grain`, each of which has arcs of its own. Small, since a chunk
//! is traced again as a whole where an island was absorbed.
struct DiagramParts {
    static constexpr Index grain = 128;

    EdgeLabels labels;
    std::vector<Index> vertex_site;  //!< #V: before islands were absorbed.
    std::vector<FaceArcs> chunks;
    std::vector<Index> mended_faces;  //!< Those around labels that islands changed.
};

//! Labels and arcs depend on nothing but the relays of the faces next to them and the labels of
//! their corners.
class EarlierParts {
public:
    //! \param parts          outlive this.
    //! \param changed_faces  those whose relays, or the distances of whose corners, are others now.
    EarlierParts(const Surface& surface, const DiagramParts& parts,
                 std::span<const Index> changed_faces);

    //! Settles the vertices around which nothing changed, and marks them as fixed.
    void settle_vertices(EdgeLabels& labels, std::vector<std::uint8_t>& is_fixed) const;
    //! Compares the other vertices, when they are settled; before that, nothing holds at them.
    void compare_vertices(const EdgeLabels& labels);

    //! Whether anything has changed in a face or next to one of its corners; where nothing has,
    //! all holds.
    [[nodiscard]] bool is_near_change(Index face) const { return is_near_[face] != 0; }
    [[nodiscard]] bool holds_on_edge(Index half_edge) const;
    //! In the face and on its edges.
    [[nodiscard]] bool holds_in_face(Index face) const;

    //! The label changes on a mesh edge on which they hold.
    [[nodiscard]] std::span<const Crossing> on_edge(Index edge) const {
        return parts_.labels.on_edge(edge);
    }
    //! Appends the arcs of a listed face without cuts in which they hold, with the names that
    //! `labels` give to the label changes on its edges.
    void append_arcs(Index face, const EdgeLabels& labels, FaceArcs& out) const;
    [[nodiscard]] bool is_cut(Index face) const;

private:
    const Surface& surface_;
    const DiagramParts& parts_;
    std::vector<std::uint8_t> is_face_changed_;    // #F
    std::vector<std::uint8_t> is_vertex_changed_;  // #V
    std::vector<std::uint8_t> is_near_;            // #F: around a vertex marked at first.
};

//! As build_diagram().
//! \param earlier  may be null. The result is the same, byte for byte, with and without it.
//! \param parts    replaced; of another diagram than `earlier`.
[[nodiscard]] Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                                    const Propagation& propagation, const DiagramOptions& options,
                                    EarlierParts* earlier, DiagramParts& parts);

}  // namespace agvd
