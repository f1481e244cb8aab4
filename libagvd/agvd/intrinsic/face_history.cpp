// Carries points, segments and polygons through a record of flips, splits and merges ([sharp2019]
// trace geodesics instead). Operations are linked face by face, forward and backward, so that a
// point passes only those that touch its face.
//
// Notation: a flip replaces the faces (a, b, c) and (b, a, d) by (a, d, c) and (d, b, c), where
//   d = q.tail a + q.head b + q.apex c;
// a split is the same with the middle of the side ab for d, and without the second face. A merge
// removes m = q[0] a + q[1] b + q[2] c: its faces become (a, b, c). Shares are barycentric
// coordinates; a slot is the number of a face within its operation.
#include "agvd/intrinsic/face_history.h"

#include <algorithm>

namespace agvd::detail {
namespace {

using Shares = std::array<double, 3>;

// Coordinates for the tail and the head of a half-edge and the corner opposite.
Shares seen_from(const SurfacePoint& point, Index half_edge) {
    const std::size_t k = half_edge % 3;
    return {point.barycentric[k], point.barycentric[(k + 1) % 3], point.barycentric[(k + 2) % 3]};
}

SurfacePoint point_of(const Shares& shares, Index half_edge) {
    SurfacePoint point{FaceId(Surface::face(half_edge)), {}};
    const std::size_t k = half_edge % 3;
    for (std::size_t i = 0; i < 3; ++i) point.barycentric[(k + i) % 3] = shares[i];
    return point;
}

SurfacePoint normalized(SurfacePoint point) {
    const auto& [a, b, c] = point.barycentric;
    const double sum = a + b + c;
    for (double& share : point.barycentric) share /= sum;
    return point;
}

Shares between(const Shares& s, const Shares& t, double at) {
    Shares result;
    for (std::size_t k = 0; k < 3; ++k) result[k] = (1 - at) * s[k] + at * t[k];
    return result;
}

// The part of a convex polygon where `side` is not below 0, in the order of its corners.
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

}  // namespace

// The passage of a point through a flip or split, from one of its faces. With d = q.tail a + q.head
// b + q.apex c every corner of the old and new faces is an affine combination of the corners of
// another face.
struct FaceHistory::Step {
    Step(const Operation& operation, Way way_through, Index slot)
        : op(operation), way(way_through), is_twin(slot == 1), q(operation.shares) {}

    const Operation& op;
    Way way;
    bool is_twin;  // From slot 1.
    const QuadShares& q;

    [[nodiscard]] Shares shares_of(const SurfacePoint& point) const {
        if (way == Way::Forward) return seen_from(point, op.half_edge[is_twin ? 1 : 0]);
        return point.barycentric;
    }
    // At least 0 if the point goes to slot 0.
    [[nodiscard]] double side(const Shares& s) const {
        if (way == Way::Forward) {
            return is_twin ? s[1] - s[0] * (q.tail / q.head) : s[0] - s[1] * (q.tail / q.head);
        }
        return s[2] + (is_twin ? s[0] : s[1]) * q.apex;
    }
    // To slot 0 or 1; `on_cut`: the point lies on the edge between the two.
    [[nodiscard]] SurfacePoint pass(const Shares& s, Index slot, bool on_cut) const {
        Shares to = on_cut                ? on_diagonal(s, slot)
                    : way == Way::Forward ? forward(s, slot)
                                          : backward(s, slot);
        for (double& share : to) share = std::max(share, 0.0);
        if (way == Way::Backward) return point_of(to, op.half_edge[slot]);
        return {FaceId(op.new_face[slot]), to};
    }
    [[nodiscard]] Link next_link(Index slot) const {
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

// The passage of a point through a merge. Let m = q[0] a + q[1] b + q[2] c. For a point s of (a, b,
// c), the corner k with the least s[k] / q[k] is opposite to the side at which the point's old face
// lies.
struct FaceHistory::MergeStep {
    MergeStep(const Merge& merge) : op(merge), q(merge.shares) {}

    const Merge& op;
    const std::array<double, 3>& q;

    // Above 0 if s[i] / q[i] exceeds s[k] / q[k].
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
        const Shares s = seen_from(point, op.half_edge[slot]);
        const std::size_t next = (slot + 1) % 3, apex = (slot + 2) % 3;
        Shares to;
        to[slot] = s[0] + s[2] * q[slot];
        to[next] = s[1] + s[2] * q[next];
        to[apex] = s[2] * q[apex];
        return {FaceId(op.new_face), to};
    }
    // \param on_spoke  the corner k if the point lies on the edge from m to corner k; 3: on none.
    [[nodiscard]] SurfacePoint backward(const Shares& s, Index slot, std::size_t on_spoke) const {
        const std::size_t next = (slot + 1) % 3, apex = (slot + 2) % 3;
        // A point on an edge at m gets the same coordinates from both sides of the edge.
        if (on_spoke == slot || on_spoke == next) {
            const std::size_t i = (on_spoke + 1) % 3, k = (on_spoke + 2) % 3;
            const double at = (s[i] + s[k]) / (q[i] + q[k]);
            const double rest = std::max(1 - at, 0.0);
            return point_of(on_spoke == slot ? Shares{rest, 0, at} : Shares{0, rest, at},
                            op.half_edge[slot]);
        }
        const double at = s[apex] / q[apex];
        return point_of(
            {std::max(s[slot] - at * q[slot], 0.0), std::max(s[next] - at * q[next], 0.0), at},
            op.half_edge[slot]);
    }

    // The part of a polygon in (a, b, c) that lies in one of the old faces, in that face.
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
    // Cuts a segment of (a, b, c) where it crosses the edges at m, in its order.
    // \return the number of parts.
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

void FaceHistory::add_flip(Index half_edge, Index twin, const QuadShares& shares) {
    add({{half_edge, twin}, {Surface::face(half_edge), Surface::face(twin)}, {}, {}, shares});
}

void FaceHistory::add_split(Index half_edge, Index new_face) {
    add({{half_edge, no_index}, {Surface::face(half_edge), new_face}, {}, {}, {0.5, 0.5, 0}});
}

void FaceHistory::start() {
    if (whole_ != nullptr || !last_.empty()) return;
    first_.assign(num_faces_, {});
    last_.assign(num_faces_, {});
}

FaceHistory::Link FaceHistory::chain(Index face, Link link) {
    const Link made_by = links().last_[face];
    if (!made_by.is_valid()) {
        links().first_[face] = link;
    } else if (made_by.is_merge()) {
        merges_[made_by.merge()].next = link;
    } else {
        operations_[made_by.operation()].next[made_by.slot()] = link;
    }
    return made_by;
}

void FaceHistory::add(Operation operation) {
    start();
    const std::size_t number = operations_.size();
    for (Index slot = 0; slot < 2; ++slot) {
        if (operation.half_edge[slot] == no_index) continue;
        const Index face = Surface::face(operation.half_edge[slot]);
        operation.previous[slot] = chain(face, Link::to_operation(number, slot));
    }
    for (Index slot = 0; slot < 2; ++slot) {
        const Index face = operation.new_face[slot];
        std::vector<Link>& last = links().last_;
        if (face >= last.size()) last.resize(face + 1);
        last[face] = Link::to_operation(number, slot);
    }
    operations_.push_back(operation);
}

void FaceHistory::add_merge(const MergedFace& made) {
    start();
    Merge merge{made.half_edge, made.face, {}, {}, made.shares};
    const std::size_t number = merges_.size();
    for (Index slot = 0; slot < 3; ++slot) {
        if (merge.half_edge[slot] == no_index) continue;
        merge.previous[slot] =
            chain(Surface::face(merge.half_edge[slot]), Link::to_merge(number, slot));
    }
    links().last_[made.face] = Link::to_merge(number, 0);
    merges_.push_back(merge);
}

// Places in links of the part are counted from its own first operation and merge.
void FaceHistory::take(const FaceHistory& part) {
    const std::size_t num_operations = operations_.size();
    const std::size_t num_merges = merges_.size();
    const auto moved = [&](Link link) { return link.behind(num_operations, num_merges); };
    operations_.insert(operations_.end(), part.operations_.begin(), part.operations_.end());
    merges_.insert(merges_.end(), part.merges_.begin(), part.merges_.end());
    for (std::size_t i = num_operations; i < operations_.size(); ++i) {
        Operation& op = operations_[i];
        for (Index slot = 0; slot < 2; ++slot) {
            const Link link = Link::to_operation(i, slot);
            if (!op.previous[slot].is_valid()) first_[Surface::face(op.half_edge[slot])] = link;
            if (!op.next[slot].is_valid()) last_[op.new_face[slot]] = link;
            op.previous[slot] = moved(op.previous[slot]);
            op.next[slot] = moved(op.next[slot]);
        }
    }
    for (std::size_t i = num_merges; i < merges_.size(); ++i) {
        Merge& merge = merges_[i];
        for (Index slot = 0; slot < 3; ++slot) {
            if (merge.half_edge[slot] == no_index) continue;
            const Index face = Surface::face(merge.half_edge[slot]);
            if (!merge.previous[slot].is_valid()) first_[face] = Link::to_merge(i, slot);
            merge.previous[slot] = moved(merge.previous[slot]);
        }
        if (!merge.next.is_valid()) last_[merge.new_face] = Link::to_merge(i, 0);
        merge.next = moved(merge.next);
    }
}

void FaceHistory::move_face(Index from, Index to) {
    start();
    const Link made_by = last_[from];
    if (!made_by.is_valid()) {  // Its third corner merges with it: nothing moves.
        add_merge({to, {3 * from, no_index, no_index}, {0, 0, 1}});
        return;
    }
    last_[to] = made_by;
    if (made_by.is_merge()) {
        merges_[made_by.merge()].new_face = to;
    } else {
        operations_[made_by.operation()].new_face[made_by.slot()] = to;
    }
}

FaceHistory::Link FaceHistory::first_link(Way way, Index face) const {
    const std::vector<Link>& links = way == Way::Forward ? first_ : last_;
    return face < links.size() ? links[face] : Link();
}

FaceHistory::Link FaceHistory::carry_through_merge(Way way, Link link, SurfacePoint& point) const {
    const MergeStep step(merges_[link.merge()]);
    if (way == Way::Forward) {
        point = step.forward(point, link.slot());
        return step.op.next;
    }
    const Index slot = step.slot_of(point.barycentric);
    point = step.backward(point.barycentric, slot, 3);
    return step.op.previous[slot];
}

SurfacePoint FaceHistory::carry(Way way, SurfacePoint point) const {
    Link link = first_link(way, point.face.value());
    if (!link.is_valid()) return point;
    while (link.is_valid()) {
        if (link.is_merge()) {
            link = carry_through_merge(way, link, point);
            continue;
        }
        const Step step(operations_[link.operation()], way, link.slot());
        const Shares shares = step.shares_of(point);
        const double side = step.side(shares);
        const Index slot = side >= 0 ? 0 : 1;
        point = step.pass(shares, slot, side == 0);
        link = step.next_link(slot);
    }
    return normalized(point);
}

void FaceHistory::carry(Way way, const FaceSegment& segment,
                        std::vector<FaceSegment>& parts) const {
    struct Waiting {
        FaceSegment segment;
        Link link;
    };
    std::vector<Waiting> waiting{{segment, first_link(way, segment.begin.face.value())}};
    if (!waiting[0].link.is_valid()) {
        parts.push_back(segment);
        return;
    }
    while (!waiting.empty()) {
        const auto [part, link] = waiting.back();
        waiting.pop_back();
        if (!link.is_valid()) {
            parts.push_back({normalized(part.begin), normalized(part.end)});
            continue;
        }
        if (link.is_merge()) {
            const MergeStep step(merges_[link.merge()]);
            if (way == Way::Forward) {
                const Index slot = link.slot();
                waiting.push_back(
                    {{step.forward(part.begin, slot), step.forward(part.end, slot)}, step.op.next});
                continue;
            }
            std::array<MergeStep::Part, 3> cuts;
            for (Index i = step.cut(part, cuts); i-- > 0;) {
                waiting.push_back({cuts[i].segment, step.op.previous[cuts[i].slot]});
            }
            continue;
        }
        const Step step(operations_[link.operation()], way, link.slot());
        const Shares begin = step.shares_of(part.begin), end = step.shares_of(part.end);
        const double begin_side = step.side(begin), end_side = step.side(end);
        if ((begin_side > 0 && end_side < 0) || (begin_side < 0 && end_side > 0)) {
            const Shares cut = between(begin, end, begin_side / (begin_side - end_side));
            const Index slot = begin_side > 0 ? 0 : 1;
            waiting.push_back({{step.pass(cut, 1 - slot, true), step.pass(end, 1 - slot, false)},
                               step.next_link(1 - slot)});
            waiting.push_back({{step.pass(begin, slot, false), step.pass(cut, slot, true)},
                               step.next_link(slot)});
            continue;
        }
        const Index slot = begin_side >= 0 && end_side >= 0 ? 0 : 1;
        waiting.push_back({{step.pass(begin, slot, begin_side == 0),  //
                            step.pass(end, slot, end_side == 0)},
                           step.next_link(slot)});
    }
}

bool FaceHistory::is_near(SurfacePoint point, Index most_steps) const {
    Link link = first_link(Way::Backward, point.face.value());
    for (Index steps = 0; link.is_valid(); ++steps) {
        if (steps == most_steps) return false;
        if (link.is_merge()) {
            link = carry_through_merge(Way::Backward, link, point);
            continue;
        }
        const Step step(operations_[link.operation()], Way::Backward, link.slot());
        const Shares shares = step.shares_of(point);
        const Index slot = step.side(shares) >= 0 ? 0 : 1;
        point = step.pass(shares, slot, false);
        link = step.next_link(slot);
    }
    return true;
}

// Parts of a face of the end that have not passed all operations. Records are large, so a part that
// is not cut is changed in place.
struct FaceHistory::Parts {
    struct Waiting {
        FacePolygon part;
        Link link;
    };
    std::vector<Waiting> waiting;

    void add(const FacePolygon& part, Link link) {
        if (part.num_corners >= 3) waiting.push_back({part, link});
    }

    void pass(const MergeStep& step) {
        const FacePolygon whole = waiting.back().part;
        waiting.pop_back();
        for (const Index slot : {0U, 1U, 2U}) {
            if (step.op.half_edge[slot] == no_index) continue;
            add(step.clip(whole, slot), step.op.previous[slot]);
        }
    }

    void pass(const Step& step) {
        FacePolygon& part = waiting.back().part;
        std::array<double, FacePolygon::most_corners> side;
        Index num_first = 0, num_second = 0;  // Corners strictly on either side.
        for (Index i = 0; i < part.num_corners; ++i) {
            side[i] = step.side(part.corner[i]);
            num_first += side[i] > 0 ? 1 : 0;
            num_second += side[i] < 0 ? 1 : 0;
        }
        const bool is_flat = num_first + num_second + 2 < part.num_corners;
        if ((num_first == 0 || num_second == 0) && !is_flat) {
            const Index slot = num_second == 0 ? 0 : 1;
            carry(step, slot, part);
            waiting.back().link = step.next_link(slot);
            return;
        }
        const FacePolygon whole = part;
        waiting.pop_back();
        for (const Index slot : {0U, 1U}) {
            FacePolygon piece = clipped(whole, side);
            for (double& s : side) s = -s;  // The other side.
            carry(step, slot, piece);
            add(piece, step.next_link(slot));
        }
    }

    static void carry(const Step& step, Index slot, FacePolygon& part) {
        for (Index i = 0; i < part.num_corners; ++i) {
            const SurfacePoint point = step.pass(part.corner[i], slot, false);
            part.face = point.face.value();
            part.corner[i] = point.barycentric;
        }
    }
};

bool FaceHistory::parts_of(Index face, Index most_steps,
                           const std::function<void(const FacePolygon&)>& take) const {
    Parts all;
    all.waiting.reserve(16);
    all.add(FacePolygon(face), first_link(Way::Backward, face));
    for (Index steps = 0; !all.waiting.empty(); ++steps) {
        const auto& [part, link] = all.waiting.back();
        if (!link.is_valid()) {
            take(part);
            all.waiting.pop_back();
            continue;
        }
        if (steps == most_steps || part.num_corners + 2 > FacePolygon::most_corners) return false;
        if (link.is_merge()) {
            all.pass(MergeStep(merges_[link.merge()]));
        } else {
            all.pass(Step(operations_[link.operation()], Way::Backward, link.slot()));
        }
    }
    return true;
}

SurfacePoint FaceHistory::forward(SurfacePoint point) const { return carry(Way::Forward, point); }
SurfacePoint FaceHistory::backward(SurfacePoint point) const { return carry(Way::Backward, point); }
void FaceHistory::forward(const FaceSegment& segment, std::vector<FaceSegment>& parts) const {
    carry(Way::Forward, segment, parts);
}
void FaceHistory::backward(const FaceSegment& segment, std::vector<FaceSegment>& parts) const {
    carry(Way::Backward, segment, parts);
}

}  // namespace agvd::detail
