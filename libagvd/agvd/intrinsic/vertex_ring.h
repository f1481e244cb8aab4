//! \file
//! The faces around a vertex, laid out in one plane, and how it goes from among them. Private to
//! intrinsic.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "agvd/intrinsic/face_charts.h"
#include "agvd/intrinsic/face_operations.h"

namespace agvd::detail {

//! A face (a, b, c) that two or three faces at a vertex m became.
struct MergedFace {
    Index face = no_index;
    //! Sides ab, bc and ca in the faces that were; no_index where m lies on it.
    std::array<Index, 3> half_edge{no_index, no_index, no_index};
    std::array<double, 3> shares{};  //!< m = shares[0] a + shares[1] b + shares[2] c.
};

//! A flip as FaceHistory takes it.
struct RingFlip {
    Index half_edge, twin;
    QuadShares shares;
};

//! Around an inner vertex without curvature, counter-clockwise: takes it away. Edges at it are
//! flipped until three are left, or four of which two are one straight line, and the faces around
//! merge. All that is found in one plane; faces are written once, when it is known that the vertex
//! can go: a run on 1.4 M faces that loses 643 000 vertices takes 4.6 s of user time, and 5.1 s
//! with one flip after the other.
class VertexRing {
public:
    VertexRing(Surface& surface, FaceCharts& charts) : surface_(surface), charts_(charts) {}

    //! Takes up an inner vertex. Others must not change until it is removed.
    void set(Index vertex);
    //! Half-edges that leave the vertex.
    [[nodiscard]] std::span<const Index> half_edges() const { return half_edge_; }
    //! Takes the vertex away; it, faces and edges leave gaps.
    //! \return false where it cannot go: a face comes twice, or nothing can be flipped. Then
    //! nothing has changed.
    [[nodiscard]] bool remove();
    //! What remove() has done: first the flips, then the one or two faces that were made.
    [[nodiscard]] std::span<const RingFlip> flips() const { return flips_; }
    [[nodiscard]] std::span<const MergedFace> merged() const { return merged_; }
    //! Vertices around, as they were.
    [[nodiscard]] std::span<const Index> corners() const { return corners_; }

private:
    // The side of a face across from the vertex, and what lies beyond.
    struct Rim {
        Index twin, edge;
        Index number;  // In the ring as it was; no_index: a diagonal.
        Vec2 along;
        Vec2 turn;  // Of the chart beyond into that of the ring's first face.
    };
    // A face at the vertex and the spoke that it begins with.
    struct Sector {
        Index half_edge;  // Leaves the vertex.
        Index spoke_edge;
        Index head;
        Vec2 spoke;  // In the chart of the first face.
        Rim rim;
    };
    // A face that is left.
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
    std::vector<Vec2> turns_;        // Of each face's chart into that of the first.
    std::vector<Index> rim_places_;  // By number of a rim: where it lies now.
    std::vector<Sector> sectors_;
    std::vector<RingFlip> flips_;
    std::vector<MergedFace> merged_;
    std::vector<Made> made_;
    std::vector<Index> gone_edges_;
    bool is_glued_ = false;  // A rim to another one.
};

}  // namespace agvd::detail
