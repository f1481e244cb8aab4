//! \file
//! A record of flips, splits and merges of faces: it carries points and segments through them,
//! forward and backward. Private to intrinsic.
#pragma once

#include <functional>
#include <vector>

#include "agvd/intrinsic/face_operations.h"
#include "agvd/intrinsic/face_parts.h"
#include "agvd/intrinsic/operation_records.h"

namespace agvd::detail {

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
    using Link = OperationLink;
    struct Parts;

    void add(FlipRecord operation);
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
    std::vector<FlipRecord> operations_;
    std::vector<MergeRecord> merges_;
    std::vector<Link> first_;  // By face of the beginning: the link that changes it first.
    std::vector<Link> last_;   // By face of the end: the link that made it.
};

}  // namespace agvd::detail
