//! \file
//! A record of flips, splits and merges of faces: it carries points and segments through them,
//! forward and backward. Private.
#pragma once

#include "agvd/intrinsic/passages.h"

namespace agvd::detail {

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
