//! \file
//! How points, segments and polygons pass one flip, split or merge. Private to intrinsic; inline
//! because a point may pass hundreds.
#pragma once

#include <algorithm>

#include "agvd/intrinsic/face_parts.h"
#include "agvd/intrinsic/operation_records.h"
#include "agvd/mesh/surface.h"

namespace agvd::detail {

//! Barycentric.
using Shares = std::array<double, 3>;

//! Coordinates for the tail and the head of a half-edge and the corner opposite.
inline Shares shares_at(const SurfacePoint& point, Index half_edge) {
    const std::size_t k = half_edge % 3;
    return {point.barycentric[k], point.barycentric[(k + 1) % 3], point.barycentric[(k + 2) % 3]};
}

//! The reverse.
inline SurfacePoint point_at_shares(const Shares& shares, Index half_edge) {
    SurfacePoint point{FaceId(Surface::face(half_edge)), {}};
    const std::size_t k = half_edge % 3;
    for (std::size_t i = 0; i < 3; ++i) point.barycentric[(k + i) % 3] = shares[i];
    return point;
}

//! The point at a share of the way from s to t.
inline Shares between(const Shares& s, const Shares& t, double at) {
    Shares result;
    for (std::size_t k = 0; k < 3; ++k) result[k] = (1 - at) * s[k] + at * t[k];
    return result;
}

//! The part of a convex polygon where `side` is not below 0, in the order of its corners.
template <typename Sides>
FacePolygon clipped(const FacePolygon& polygon, const Sides& side) {
    FacePolygon result;
    result.face = polygon.face;
    for (Index i = 0; i < polygon.num_corners; ++i) {
        const Index next = i + 1 == polygon.num_corners ? 0 : i + 1;
        if (side[i] >= 0) result.corner[result.num_corners++] = polygon.corner[i];
        if ((side[i] > 0 && side[next] < 0) || (side[i] < 0 && side[next] > 0)) {
            result.corner[result.num_corners++] =
                between(polygon.corner[i], polygon.corner[next], side[i] / (side[i] - side[next]));
        }
    }
    return result;
}

//! The passage of a point through a flip or split, from one of its faces. With d = q.tail a +
//! q.head b + q.apex c every corner of the old and new faces is an affine combination of the
//! corners of another face.
struct FlipPassage {
    FlipPassage(const FlipRecord& operation, Way way_through, Index slot)
        : op(operation), way(way_through), is_twin(slot == 1), q(operation.shares) {}

    const FlipRecord& op;
    Way way;
    bool is_twin;  //!< From slot 1.
    const QuadShares& q;

    [[nodiscard]] Shares shares_of(const SurfacePoint& point) const {
        if (way == Way::Forward) return shares_at(point, op.half_edge[is_twin ? 1 : 0]);
        return point.barycentric;
    }
    //! At least 0 if the point goes to slot 0.
    [[nodiscard]] double side(const Shares& s) const {
        if (way == Way::Forward) {
            return is_twin ? s[1] - s[0] * (q.tail / q.head) : s[0] - s[1] * (q.tail / q.head);
        }
        return s[2] + (is_twin ? s[0] : s[1]) * q.apex;
    }
    //! To slot 0 or 1; `on_cut`: the point lies on the edge between the two.
    [[nodiscard]] SurfacePoint pass(const Shares& s, Index slot, bool on_cut) const {
        Shares to = on_cut                ? on_diagonal(s, slot)
                    : way == Way::Forward ? forward(s, slot)
                                          : backward(s, slot);
        for (double& share : to) share = std::max(share, 0.0);
        if (way == Way::Backward) return point_at_shares(to, op.half_edge[slot]);
        return {FaceId(op.new_face[slot]), to};
    }
    [[nodiscard]] OperationLink next_link(Index slot) const {
        return way == Way::Forward ? op.next[slot] : op.previous[slot];
    }

private:
    // A point on the new diagonal, or backward on the old one: its coordinates are the same numbers
    // on both sides. Two shares give its place; the one with the larger divisor has the smaller
    // error.
    [[nodiscard]] Shares on_diagonal(const Shares& s, Index slot) const {
        if (way == Way::Backward) {
            const double d = is_twin ? s[0] : s[1];
            const double a = (is_twin ? 0 : s[0]) + d * q.tail;
            const double b = (is_twin ? s[1] : 0) + d * q.head;
            return slot == 0 ? Shares{a, b, 0} : Shares{b, a, 0};
        }
        const double a = is_twin ? s[1] : s[0], b = is_twin ? s[0] : s[1];
        const double at = q.tail >= q.head ? a / q.tail : b / q.head;
        const double c = (is_twin ? 0 : s[2]) - at * q.apex;
        const double d = (is_twin ? s[2] : 0) + at;
        return slot == 0 ? Shares{0, d, c} : Shares{d, 0, c};
    }
    // From (a, b, c) or (b, a, d) to (a, d, c) or (d, b, c).
    [[nodiscard]] Shares forward(const Shares& s, Index slot) const {
        if (!is_twin) {
            if (slot == 0) {
                const double at = s[1] / q.head;
                return {s[0] - at * q.tail, at, s[2] - at * q.apex};
            }
            const double at = s[0] / q.tail;
            return {at, s[1] - at * q.head, s[2] - at * q.apex};
        }
        if (slot == 0) {
            const double at = s[0] / q.head;
            return {s[1] - at * q.tail, s[2] + at, -at * q.apex};
        }
        const double at = s[1] / q.tail;
        return {s[2] + at, s[0] - at * q.head, -at * q.apex};
    }
    // From (a, d, c) or (d, b, c) to (a, b, c) or (b, a, d).
    [[nodiscard]] Shares backward(const Shares& s, Index slot) const {
        if (slot == 0) {
            const double d = is_twin ? s[0] : s[1];
            const Shares along{d * q.tail, d * q.head, s[2] + d * q.apex};
            if (is_twin) return {along[0], s[1] + along[1], along[2]};
            return {s[0] + along[0], along[1], along[2]};
        }
        const double at = s[2] / q.apex;
        if (is_twin) return {s[1] - at * q.head, -at * q.tail, s[0] + at};
        return {-at * q.head, s[0] - at * q.tail, s[1] + at};
    }
};

//! The passage of a point through a merge. Let m = q[0] a + q[1] b + q[2] c. For a point s of (a,
//! b, c), the corner k with the least s[k] / q[k] is opposite to the side at which the point's old
//! face lies.
struct MergePassage {
    explicit MergePassage(const MergeRecord& merge) : op(merge), q(merge.shares) {}

    const MergeRecord& op;
    const std::array<double, 3>& q;

    //! Above 0 if s[i] / q[i] exceeds s[k] / q[k].
    [[nodiscard]] double side(const Shares& s, std::size_t i, std::size_t k) const {
        return s[i] * q[k] - s[k] * q[i];
    }
    [[nodiscard]] Index slot_of(const Shares& s) const {
        std::size_t least = q[0] > 0 ? 0 : q[1] > 0 ? 1 : 2;
        for (std::size_t k = least + 1; k < 3; ++k) {
            if (q[k] > 0 && side(s, least, k) > 0) least = k;
        }
        return static_cast<Index>((least + 1) % 3);
    }
    [[nodiscard]] SurfacePoint forward(const SurfacePoint& point, Index slot) const {
        const Shares s = shares_at(point, op.half_edge[slot]);
        const std::size_t next = (slot + 1) % 3, apex = (slot + 2) % 3;
        Shares to;
        to[slot] = s[0] + s[2] * q[slot];
        to[next] = s[1] + s[2] * q[next];
        to[apex] = s[2] * q[apex];
        return {FaceId(op.new_face), to};
    }
    //! \param on_spoke  the corner k if the point lies on the edge from m to corner k; 3: on none.
    [[nodiscard]] SurfacePoint backward(const Shares& s, Index slot, std::size_t on_spoke) const {
        const std::size_t next = (slot + 1) % 3, apex = (slot + 2) % 3;
        // A point on an edge at m gets the same coordinates from both sides of the edge.
        if (on_spoke == slot || on_spoke == next) {
            const std::size_t i = (on_spoke + 1) % 3, k = (on_spoke + 2) % 3;
            const double at = (s[i] + s[k]) / (q[i] + q[k]);
            const double rest = std::max(1 - at, 0.0);
            return point_at_shares(on_spoke == slot ? Shares{rest, 0, at} : Shares{0, rest, at},
                                   op.half_edge[slot]);
        }
        const double at = s[apex] / q[apex];
        return point_at_shares(
            {std::max(s[slot] - at * q[slot], 0.0), std::max(s[next] - at * q[next], 0.0), at},
            op.half_edge[slot]);
    }

    //! The part of a polygon in (a, b, c) that lies in one of the old faces, in that face.
    [[nodiscard]] FacePolygon clip(const FacePolygon& polygon, Index slot) const {
        const std::size_t apex = (slot + 2) % 3;
        FacePolygon piece = polygon;
        for (const std::size_t other : {std::size_t{slot}, (slot + std::size_t{1}) % 3}) {
            if (!(q[other] > 0)) continue;
            std::array<double, FacePolygon::most_corners> sides;
            for (Index i = 0; i < piece.num_corners; ++i) {
                sides[i] = side(piece.corner[i], other, apex);
            }
            piece = clipped(piece, sides);
        }
        for (Index i = 0; i < piece.num_corners; ++i) {
            const SurfacePoint point = backward(piece.corner[i], slot, 3);
            piece.face = point.face.value();
            piece.corner[i] = point.barycentric;
        }
        return piece;
    }

    struct Part {
        FaceSegment segment;
        Index slot = 0;
    };
    //! Cuts a segment of (a, b, c) where it crosses the edges at m, in its order.
    //! \return the number of parts.
    Index cut(const FaceSegment& segment, std::array<Part, 3>& parts) const {
        const Shares& begin = segment.begin.barycentric;
        const Shares& end = segment.end.barycentric;
        const std::size_t last = (slot_of(end) + 2) % 3;
        std::size_t least = (slot_of(begin) + 2) % 3;  // The corner across.
        Index count = 0;
        Shares from = begin;
        std::size_t on_spoke = 3;
        double done = 0;
        while (least != last && count < 2) {
            double at = 1;
            std::size_t next = last;
            for (std::size_t k = 0; k < 3; ++k) {
                if (k == least || !(q[k] > 0)) continue;
                const double before = side(begin, k, least), after = side(end, k, least);
                if (!(after < 0)) continue;
                const double here = std::max(before, 0.0) / (std::max(before, 0.0) - after);
                if (here >= at) continue;
                at = here;
                next = k;
            }
            at = std::max(at, done);
            const Shares cut = between(begin, end, at);
            const std::size_t spoke = 3 - least - next;
            const auto slot = static_cast<Index>((least + 1) % 3);
            parts[count++] = {{backward(from, slot, on_spoke), backward(cut, slot, spoke)}, slot};
            from = cut;
            on_spoke = spoke;
            done = at;
            least = next;
        }
        const auto slot = static_cast<Index>((least + 1) % 3);
        parts[count++] = {{backward(from, slot, on_spoke), backward(end, slot, 3)}, slot};
        return count;
    }
};

}  // namespace agvd::detail
