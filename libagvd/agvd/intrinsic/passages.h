//! \file
//! What a history of faces knows of each flip, split and merge, and how points, segments and
//! polygons pass one. Private; inline because a point may pass hundreds.
//!
//! Notation: a flip replaces the faces (a, b, c) and (b, a, d) by (a, d, c) and (d, b, c), where
//!   d = q.tail a + q.head b + q.apex c;
//! a split is the same with the middle of the side ab for d, and without the second face. A merge
//! removes m = q[0] a + q[1] b + q[2] c: its faces become (a, b, c). Shares are barycentric
//! coordinates; a slot is the number of a face within its operation.
#pragma once

#include <algorithm>
#include <optional>
#include <variant>

#include "agvd/mesh/surface.h"

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
    constexpr OperationLink() = default;  //!< To no operation.
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

//! A part of a polyline that lies in one face.
struct FaceSegment {
    SurfacePoint begin, end;
};

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
template <std::size_t N>
std::array<double, N> between(const std::array<double, N>& s, const std::array<double, N>& t,
                              double at) {
    std::array<double, N> result;
    for (std::size_t k = 0; k < N; ++k) result[k] = (1 - at) * s[k] + at * t[k];
    return result;
}

//! The part of a convex polygon where side(corner) is not below 0, in the order of its corners.
template <typename Side>
FacePolygon clipped(const FacePolygon& polygon, const Side& side) {
    FacePolygon result;
    result.face = polygon.face;
    for (Index i = 0; i < polygon.num_corners; ++i) {
        const Shares &from = polygon.corner[i],
                     &to = polygon.corner[i + 1 == polygon.num_corners ? 0 : i + 1];
        const double before = side(from), after = side(to);
        if (before >= 0) result.corner[result.num_corners++] = from;
        if ((before > 0 && after < 0) || (before < 0 && after > 0)) {
            result.corner[result.num_corners++] = between(from, to, before / (before - after));
        }
    }
    return result;
}

//! A point of a quad: its shares of a, b, c and d.
using QuadPoint = std::array<double, 4>;

//! The passage of a point through a flip or split, from one of its faces: every corner is an affine
//! combination of the corners of another face.
struct FlipPassage {
    FlipPassage(const FlipRecord& operation, Way way_through, Index slot)
        : op(operation), way(way_through), from(slot), q(operation.shares) {}

    const FlipRecord& op;
    Way way;
    Index from;  //!< The slot.
    const QuadShares& q;

    //! A point of the face at `from`: of (a, b, c) or (b, a, d), or backward of (a, d, c) or
    //! (d, b, c).
    [[nodiscard]] QuadPoint in_quad(const SurfacePoint& point) const {
        if (way == Way::Backward) {
            const Shares& s = point.barycentric;
            return from == 0 ? QuadPoint{s[0], 0, s[2], s[1]} : QuadPoint{0, s[1], s[2], s[0]};
        }
        const Shares s = shares_at(point, op.half_edge[from]);
        return from == 0 ? QuadPoint{s[0], s[1], s[2], 0} : QuadPoint{s[1], s[0], 0, s[2]};
    }
    //! At least 0 if the point goes to slot 0.
    [[nodiscard]] double side(const QuadPoint& p) const {
        const auto& [a, b, c, d] = p;
        return way == Way::Forward ? a - b * (q.tail / q.head) : c + d * q.apex;
    }
    //! To slot 0 or 1; `on_cut`: the point lies on the edge between the two.
    [[nodiscard]] SurfacePoint pass(const QuadPoint& p, Index slot, bool on_cut) const {
        Shares to = way == Way::Forward ? forward(p, slot, on_cut) : backward(p, slot, on_cut);
        for (double& share : to) share = std::max(share, 0.0);
        if (way == Way::Backward) return point_at_shares(to, op.half_edge[slot]);
        return {FaceId(op.new_face[slot]), to};
    }
    [[nodiscard]] OperationLink next_link(Index slot) const {
        return way == Way::Forward ? op.next[slot] : op.previous[slot];
    }

    //! To one slot, backward.
    void carry(Index slot, FacePolygon& part) const {
        const Index face = part.face;
        for (Index i = 0; i < part.num_corners; ++i) {
            const SurfacePoint point = pass(in_quad({FaceId(face), part.corner[i]}), slot, false);
            part.face = point.face.value();
            part.corner[i] = point.barycentric;
        }
    }
    //! The slot to which a whole polygon passes backward; none if it is to be clipped.
    [[nodiscard]] std::optional<Index> slot_of(const FacePolygon& part) const {
        Index num_first = 0, num_second = 0;  // Corners strictly on either side.
        for (Index i = 0; i < part.num_corners; ++i) {
            const double here = side(in_quad({FaceId(part.face), part.corner[i]}));
            num_first += here > 0 ? 1 : 0;
            num_second += here < 0 ? 1 : 0;
        }
        const bool is_flat = num_first + num_second + 2 < part.num_corners;
        if ((num_first > 0 && num_second > 0) || is_flat) return std::nullopt;
        return num_second == 0 ? 0 : 1;
    }
    //! The part of a polygon that passes to a slot, backward.
    [[nodiscard]] FacePolygon clip(const FacePolygon& whole, Index slot) const {
        FacePolygon piece = clipped(whole, [&](const Shares& s) {
            const double here = side(in_quad({FaceId(whole.face), s}));
            return slot == 0 ? here : -here;
        });
        carry(slot, piece);
        return piece;
    }

private:
    // To (a, d, c) or (d, b, c). A point on the new diagonal gets the same numbers on both sides.
    // Two shares give its position there; the one with the larger divisor has the smaller error.
    [[nodiscard]] Shares forward(const QuadPoint& p, Index slot, bool on_cut) const {
        const auto& [a, b, c, d] = p;
        const bool is_by_head = on_cut ? q.tail < q.head : slot == 0;
        const double at = is_by_head ? b / q.head : a / q.tail;
        const double new_c = c - at * q.apex, new_d = d + at;
        if (slot == 0) return {on_cut ? 0 : a - at * q.tail, new_d, new_c};
        return {new_d, on_cut ? 0 : b - at * q.head, new_c};
    }
    // To (a, b, c) or (b, a, d). A point on the old diagonal gets the same numbers on both sides.
    [[nodiscard]] Shares backward(const QuadPoint& p, Index slot, bool on_cut) const {
        const auto& [a, b, c, d] = p;
        if (on_cut || slot == 0) {
            const double new_a = a + d * q.tail, new_b = b + d * q.head;
            if (slot == 1) return {new_b, new_a, 0};
            return {new_a, new_b, on_cut ? 0 : c + d * q.apex};
        }
        const double at = c / q.apex;
        return {b - at * q.head, a - at * q.tail, d + at};
    }
};

//! The passage of a point through a merge. For a point s of (a, b, c), the corner k with the least
//! s[k] / q[k] is opposite to the side of its old face.
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
            piece = clipped(piece, [&](const Shares& s) { return side(s, other, apex); });
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
    //! Cuts a segment of (a, b, c) at the edges at m, in its order; returns the number of parts.
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
