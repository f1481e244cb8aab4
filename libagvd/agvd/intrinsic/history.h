//! \file
//! A record of flips, splits and merges of faces: it carries points and segments through them,
//! forward and backward. Private.
//!
//! Notation: a flip replaces the faces (a, b, c) and (b, a, d) by (a, d, c) and (d, b, c), where
//!   d = q.tail a + q.head b + q.apex c;
//! a split is the same with the middle of the side ab for d, and without the second face. A merge
//! removes m = q[0] a + q[1] b + q[2] c: its faces become (a, b, c). Shares are barycentric
//! coordinates; a slot is the number of a face within its operation.
#pragma once

#include <optional>
#include <variant>

#include "agvd/mesh/mesh.h"

namespace agvd::detail {

//! Barycentric.
using Shares = std::array<double, 3>;

//! The corner d opposite to a new edge; the shares sum to 1. A flip has apex < 0, a split 0.
struct QuadShares {
    double tail = 0;
    double head = 0;
    double apex = 0;
};

//! Faces (a, b, c) and (b, a, d) at a half-edge became (a, d, c) and (d, b, c).
struct FaceFlip {
    Index half_edge, twin;
    QuadShares shares;
};

//! A face (a, b, c) that replaces two or three faces at a vertex m.
struct FaceMerge {
    Index face = no_index;
    //! Sides ab, bc and ca as half-edges of the old faces; no_index for a side on which m lies.
    std::array<Index, 3> half_edge{no_index, no_index, no_index};
    Shares shares{};  //!< Of m.
};

//! A flip or a merge.
using FaceOperation = std::variant<FaceFlip, FaceMerge>;

//! A convex part of a face.
struct FacePolygon {
    static constexpr Index most_corners = 12;

    Index face = no_index;
    Index num_corners = 0;
    std::array<Shares, most_corners> corner;  //!< Counter-clockwise.
};

//! One of the faces of a flip or split, or of a merge: its slot there.
class OperationLink {
public:
    constexpr OperationLink() = default;  //!< None.
    [[nodiscard]] static OperationLink to_flip(std::size_t flip, Index slot) {
        return OperationLink(EitherIndex::first(2 * static_cast<Index>(flip) + slot));
    }
    [[nodiscard]] static OperationLink to_merge(std::size_t merge, Index slot) {
        return OperationLink(EitherIndex::second(4 * static_cast<Index>(merge) + slot));
    }

    [[nodiscard]] bool is_valid() const { return id_.is_valid(); }
    [[nodiscard]] bool is_merge() const { return id_.is_second(); }
    [[nodiscard]] Index flip() const { return id_.first() / 2; }
    [[nodiscard]] Index merge() const { return id_.second() / 4; }
    [[nodiscard]] Index slot() const { return is_merge() ? id_.second() % 4 : id_.first() % 2; }

private:
    explicit OperationLink(EitherIndex id) : id_(id) {}

    EitherIndex id_;
};

//! A flip or split. Slot 0: the face of the half-edge; slot 1: that of the twin (flips only). New
//! faces likewise: (a, d, c) is slot 0, (d, b, c) slot 1.
struct FlipRecord {
    std::array<Index, 2> half_edge;
    std::array<Index, 2> new_face;
    std::array<OperationLink, 2> next{};      //!< What changes the new faces.
    std::array<OperationLink, 2> previous{};  //!< What made the old ones.
    QuadShares shares;
};

//! A merge. Slots 0 to 2: the faces at sides ab, bc and ca; the new face, (a, b, c), has slot 0.
struct MergeRecord {
    std::array<Index, 3> half_edge;
    Index new_face;
    std::array<OperationLink, 3> previous{};
    OperationLink next{};
    Shares shares;
};

//! From the beginning to the end, or back.
enum class Way : std::uint8_t { Forward, Backward };

//! An operation lays one or two faces out in a plane and cuts them anew. Barycentric coordinates
//! pass from the old faces to the new ones by the shares of the quad: sums of terms of one sign, or
//! differences of numbers below 1, so that each operation costs a few roundings of 1. Coordinates
//! that are exactly 0 stay so on edges that stay.
//! 56 bytes for each operation, 8 for each face if there is one.
class FaceHistory {
public:
    explicit FaceHistory(Index num_faces) : num_faces_(num_faces) {}

    void add(const FaceFlip& flip);
    void add(const FaceMerge& made);
    //! Face (a, b, c) became (a, m, c). The new face is (m, b, c) and has the highest number.
    void add_split(Index half_edge, Index new_face);
    //! A face of the end gets another number, which no face has.
    void move_face(Index from, Index to);
    //! Faces of the end with numbers from `count` on were removed.
    void drop_faces_from(Index count) { last_.resize(std::min<std::size_t>(last_.size(), count)); }
    void reserve(std::size_t num_flips, std::size_t num_merges) {
        flips_.reserve(num_flips);
        merges_.reserve(num_merges);
    }
    //! Frees spare memory after the last operation.
    void shrink() {
        flips_.shrink_to_fit();
        merges_.shrink_to_fit();
    }

    [[nodiscard]] bool is_changed(Index face) const {
        return face < last_.size() && last_[face].is_valid();
    }
    //! Cost: some 20 ns for each operation on the way.
    //! \return nothing if the point passes more than `most_steps` operations.
    [[nodiscard]] std::optional<SurfacePoint> carry(Way way, SurfacePoint point,
                                                    Index most_steps = no_index) const;
    //! Appends the parts of a straight segment within one face of the end, in their order: begin
    //! and end of each.
    void carry_back(const SurfacePoint& begin, const SurfacePoint& end,
                    std::vector<SurfacePoint>& parts) const;
    //! Appends the parts of a face of the end in the faces of the beginning.
    //! \return false if that takes more than `most_steps` passes of a part through an operation, or
    //!        a part with too many corners; then `parts` means nothing.
    [[nodiscard]] bool parts_of(Index face, Index most_steps,
                                std::vector<FacePolygon>& parts) const;

private:
    using Link = OperationLink;

    void start();
    void add(FlipRecord record);
    // Follows the last link of an old face with another one.
    Link chain(Index face, Link link);
    [[nodiscard]] Link first_link(Way way, Index face) const;

    Index num_faces_;  // Of the beginning.
    std::vector<FlipRecord> flips_;
    std::vector<MergeRecord> merges_;
    std::vector<Link> first_;  // By face of the beginning: the link that changes it first.
    std::vector<Link> last_;   // By face of the end: the link that made it.
};

}  // namespace agvd::detail
