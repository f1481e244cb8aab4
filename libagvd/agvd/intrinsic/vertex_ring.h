//! \file
//! Removes a vertex without curvature, on a layout of the faces around it in one plane. Private to
//! intrinsic.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "agvd/intrinsic/face_charts.h"
#include "agvd/intrinsic/face_operations.h"

namespace agvd::detail {

//! A face (a, b, c) that replaces two or three faces at a vertex m.
struct MergedFace {
    Index face = no_index;
    //! Sides ab, bc and ca as half-edges of the old faces; no_index for a side on which m lies.
    std::array<Index, 3> half_edge{no_index, no_index, no_index};
    std::array<double, 3> shares{};  //!< m = shares[0] a + shares[1] b + shares[2] c.
};

//! A flip as FaceHistory takes it.
struct RingFlip {
    Index half_edge, twin;
    QuadShares shares;
};

//! The ring of faces around an inner vertex without curvature, counter-clockwise. To remove the
//! vertex, edges at it are flipped until three are left, or four of which two are one straight
//! line, and the faces around merge. The flips are found in one plane. Faces are written once, when
//! it is known that the vertex can be removed: a run on 1.4 M faces that loses 643 000 vertices
//! takes 4.6 s of user time, and 5.1 s if every flip is written.
class VertexRing {
public:
    VertexRing(Surface& surface, FaceCharts& charts) : surface_(surface), charts_(charts) {}

    //! Reads the ring of an inner vertex. The surface must not change until remove().
    void set(Index vertex);
    //! Half-edges that leave the vertex.
    [[nodiscard]] std::span<const Index> half_edges() const { return half_edge_; }
    //! Removes the vertex. The vertex, faces and edges leave gaps.
    //! \return false if it cannot be removed: a face comes twice, or no edge can be flipped. Then
    //! nothing has changed.
    [[nodiscard]] bool remove();
    //! The operations of remove(): first the flips, then the one or two faces that were made.
    [[nodiscard]] std::span<const RingFlip> flips() const { return flips_; }
    [[nodiscard]] std::span<const MergedFace> merged() const { return merged_; }
    //! The neighbours, before the removal.
    [[nodiscard]] std::span<const Index> corners() const { return corners_; }

private:
    // The side of a face opposite to the vertex, and its neighbour beyond.
    struct Rim {
        Index twin, edge;
        Index number;  // Its place in the first ring; no_index: a diagonal.
        Vec2 along;
        Vec2 turn;  // Turns vectors of the chart beyond into the chart of the ring's first face.
    };
    // A face at the vertex and its edge from the vertex.
    struct Sector {
        Index half_edge;  // Leaves the vertex.
        Index spoke_edge;
        Index head;
        Vec2 spoke;  // In the chart of the first face.
        Rim rim;
    };
    // A face of the result.
    struct Made {
        Index face;
        Triangle corners;
        std::array<Rim, 3> side;
    };

    [[nodiscard]] bool lay();
    void turn_glued_rims();
    [[nodiscard]] bool straighten();
    [[nodiscard]] bool flip_away();
    void merge_three();
    void merge_straight();
    void write();
    void write_sides(const Made& made);
    [[nodiscard]] Index twin_now(Index half_edge) const;

    Surface& surface_;
    FaceCharts& charts_;
    Index vertex_ = no_index;
    std::vector<Index> half_edge_, corners_;
    std::vector<Vec2> turns_;  // Turn vectors of each face's chart into that of the first face.
    std::vector<Index> rim_places_;  // By number of a rim: where it lies now.
    std::vector<Sector> sectors_;
    std::vector<RingFlip> flips_;
    std::vector<MergedFace> merged_;
    std::vector<Made> made_;
    std::vector<Index> gone_edges_;
    bool is_glued_ = false;  // Whether a rim is the twin of another one.
};

}  // namespace agvd::detail
