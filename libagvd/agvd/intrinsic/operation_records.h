//! \file
//! What a history of faces knows of each flip, split and merge. Private to intrinsic.
//!
//! Notation: a flip replaces the faces (a, b, c) and (b, a, d) by (a, d, c) and (d, b, c), where
//!   d = q.tail a + q.head b + q.apex c;
//! a split is the same with the middle of the side ab for d, and without the second face. A merge
//! removes m = q[0] a + q[1] b + q[2] c: its faces become (a, b, c). Shares are barycentric
//! coordinates; a slot is the number of a face within its operation.
#pragma once

#include <array>

#include "agvd/core/either_index.h"
#include "agvd/intrinsic/vertex_ring.h"

namespace agvd::detail {

//! One of the faces of a flip or split, or of a merge: its slot there.
class OperationLink {
public:
    constexpr OperationLink() = default;  //!< None.
    [[nodiscard]] static OperationLink to_operation(std::size_t operation, Index slot) {
        return OperationLink(EitherIndex::first(2 * static_cast<Index>(operation) + slot));
    }
    [[nodiscard]] static OperationLink to_merge(std::size_t merge, Index slot) {
        return OperationLink(EitherIndex::second(4 * static_cast<Index>(merge) + slot));
    }

    [[nodiscard]] bool is_valid() const { return id_.is_valid(); }
    [[nodiscard]] bool is_merge() const { return id_.is_second(); }
    [[nodiscard]] Index operation() const { return id_.first() / 2; }
    [[nodiscard]] Index merge() const { return id_.second() / 4; }
    [[nodiscard]] Index slot() const { return is_merge() ? id_.second() % 4 : id_.first() % 2; }
    //! Behind so many operations and merges.
    [[nodiscard]] OperationLink behind(std::size_t operations, std::size_t merges) const {
        if (!is_valid()) return {};
        return is_merge() ? to_merge(merge() + merges, slot())
                          : to_operation(operation() + operations, slot());
    }

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
    std::array<double, 3> shares;
};

//! From the beginning to the end, or back.
enum class Way : std::uint8_t { Forward, Backward };

}  // namespace agvd::detail
