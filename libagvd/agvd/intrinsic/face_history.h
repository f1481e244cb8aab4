//! \file
//! A record of flips, splits and merges of faces: it carries points and segments through them,
//! forward and backward. Private to intrinsic.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "agvd/core/either_index.h"
#include "agvd/intrinsic/face_operations.h"
#include "agvd/intrinsic/vertex_ring.h"
#include "agvd/mesh/surface_point.h"

namespace agvd::detail {

//! A part of a polyline that lies in one face.
struct FaceSegment {
    SurfacePoint begin;
    SurfacePoint end;  //!< Of the same face.
};

//! A convex part of a face.
struct FacePolygon {
    static constexpr Index most_corners = 12;

    Index face = no_index;
    Index num_corners = 0;
    std::array<std::array<double, 3>, most_corners> corner;  //!< Barycentric, counter-clockwise.

    FacePolygon() = default;
    //! A whole face.
    explicit FacePolygon(Index whole) : face(whole), num_corners(3) {
        for (std::size_t k = 0; k < 3; ++k) {
            corner[k] = {0, 0, 0};
            corner[k][k] = 1;
        }
    }
    //! Copies the corners in use: few polygons have all.
    FacePolygon(const FacePolygon& other) : face(other.face), num_corners(other.num_corners) {
        std::copy_n(other.corner.begin(), num_corners, corner.begin());
    }
    FacePolygon& operator=(const FacePolygon& other) {
        face = other.face;
        num_corners = other.num_corners;
        std::copy_n(other.corner.begin(), num_corners, corner.begin());
        return *this;
    }
    ~FacePolygon() = default;
};

//! An operation lays one or two faces out in a plane and cuts them anew. Barycentric coordinates
//! pass from the old faces to the new ones by the shares of the quad: sums of terms of one sign, or
//! differences of numbers below 1, so that each operation costs a few roundings of 1. Coordinates
//! that are exactly 0 stay so on edges that stay.
//! 56 bytes for each operation, 8 for each face if there is one.
class FaceHistory {
public:
    FaceHistory() = default;
    explicit FaceHistory(Index num_faces) : num_faces_(num_faces) {}

    //! A part records flips and merges separately, until `whole` takes them over. Threads may fill
    //! several parts, of different faces.
    struct Part {
        FaceHistory& whole;
    };
    explicit FaceHistory(Part part) : whole_(&part.whole) {}
    //! To be called before there are parts.
    void start();
    void take(const FaceHistory& part);

    //! Faces (a, b, c) and (b, a, d) at a half-edge became (a, d, c) and (d, b, c).
    void add_flip(Index half_edge, Index twin, const QuadShares& shares);
    //! Face (a, b, c) became (a, m, c). The new face is (m, b, c) and has the highest number.
    void add_split(Index half_edge, Index new_face);
    //! Faces became one.
    void add_merge(const MergedFace& made);
    //! A face of the end gets another number, which no face has.
    void move_face(Index from, Index to);
    //! Faces of the end with numbers from `count` on were removed.
    void drop_faces_from(Index count) { last_.resize(std::min<std::size_t>(last_.size(), count)); }

    void reserve(std::size_t num_flips_and_splits, std::size_t num_merges) {
        operations_.reserve(num_flips_and_splits);
        merges_.reserve(num_merges);
    }
    //! Frees spare memory after the last operation.
    void shrink() {
        operations_.shrink_to_fit();
        merges_.shrink_to_fit();
    }

    [[nodiscard]] bool is_changed(Index face) const {
        return face < last_.size() && last_[face].is_valid();
    }

    //! Cost: some 20 ns for each operation on the way.
    [[nodiscard]] SurfacePoint forward(SurfacePoint point) const;
    [[nodiscard]] SurfacePoint backward(SurfacePoint point) const;
    //! Appends the parts of a straight segment within one face, in their order.
    void forward(const FaceSegment& segment, std::vector<FaceSegment>& parts) const;
    void backward(const FaceSegment& segment, std::vector<FaceSegment>& parts) const;

    //! Calls take(part) for the parts of a face of the end in the faces of the beginning.
    //! \return false if that takes more than `most_steps` passes of a part through an operation, or
    //!        a part with too many corners; then what was taken means nothing.
    [[nodiscard]] bool parts_of(Index face, Index most_steps,
                                const std::function<void(const FacePolygon&)>& take) const;
    //! Whether a point passes no more operations than that on its way back.
    [[nodiscard]] bool is_near(SurfacePoint point, Index most_steps) const;

private:
    // One of the faces of a flip or split, or of a merge: its slot there.
    class Link {
    public:
        constexpr Link() = default;  // None.
        [[nodiscard]] static Link to_operation(std::size_t operation, Index slot) {
            return Link(EitherIndex::first(2 * static_cast<Index>(operation) + slot));
        }
        [[nodiscard]] static Link to_merge(std::size_t merge, Index slot) {
            return Link(EitherIndex::second(4 * static_cast<Index>(merge) + slot));
        }

        [[nodiscard]] bool is_valid() const { return id_.is_valid(); }
        [[nodiscard]] bool is_merge() const { return id_.is_second(); }
        [[nodiscard]] Index operation() const { return id_.first() / 2; }
        [[nodiscard]] Index merge() const { return id_.second() / 4; }
        [[nodiscard]] Index slot() const { return is_merge() ? id_.second() % 4 : id_.first() % 2; }
        // Behind so many operations and merges.
        [[nodiscard]] Link behind(std::size_t operations, std::size_t merges) const {
            if (!is_valid()) return {};
            return is_merge() ? to_merge(merge() + merges, slot())
                              : to_operation(operation() + operations, slot());
        }

    private:
        explicit Link(EitherIndex id) : id_(id) {}

        EitherIndex id_;
    };
    // Slot 0: the face of the half-edge; slot 1: that of the twin (flips only). New faces likewise:
    // (a, d, c) is slot 0, (d, b, c) slot 1.
    struct Operation {
        std::array<Index, 2> half_edge;
        std::array<Index, 2> new_face;
        std::array<Link, 2> next{};      // What changes the new faces.
        std::array<Link, 2> previous{};  // What made the old ones.
        QuadShares shares;
    };
    // Slots 0 to 2: the faces at sides ab, bc and ca; the new face, (a, b, c), has slot 0.
    struct Merge {
        std::array<Index, 3> half_edge;
        Index new_face;
        std::array<Link, 3> previous{};
        Link next{};
        std::array<double, 3> shares;
    };
    enum class Way : std::uint8_t { Forward, Backward };
    struct Step;
    struct MergeStep;
    struct Parts;

    void add(Operation operation);
    // Follows the last link of an old face with another one.
    Link chain(Index face, Link link);
    [[nodiscard]] Link first_link(Way way, Index face) const;
    // \return the next link.
    Link carry_through_merge(Way way, Link link, SurfacePoint& point) const;
    [[nodiscard]] SurfacePoint carry(Way way, SurfacePoint point) const;
    void carry(Way way, const FaceSegment& segment, std::vector<FaceSegment>& parts) const;

    // A part uses first_ and last_ of the whole.
    [[nodiscard]] FaceHistory& links() { return whole_ != nullptr ? *whole_ : *this; }

    FaceHistory* whole_ = nullptr;
    Index num_faces_ = 0;  // Of the beginning.
    std::vector<Operation> operations_;
    std::vector<Merge> merges_;
    std::vector<Link> first_;  // By face of the beginning: the link that changes it first.
    std::vector<Link> last_;   // By face of the end: the link that made it.
};

}  // namespace agvd::detail
