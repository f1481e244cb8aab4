// Carries points, segments and polygons through a record of flips, splits and merges ([sharp2019]
// trace geodesics instead). Operations are linked face by face, forward and backward, so that a
// point passes only those that touch its face.
#include "agvd/intrinsic/face_history.h"

#include "agvd/intrinsic/operation_passages.h"

namespace agvd::detail {
namespace {

SurfacePoint normalized(SurfacePoint point) {
    const auto& [a, b, c] = point.barycentric;
    const double sum = a + b + c;
    for (double& share : point.barycentric) share /= sum;
    return point;
}

}  // namespace

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

void FaceHistory::add(FlipRecord operation) {
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
    MergeRecord merge{made.half_edge, made.face, {}, {}, made.shares};
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
        FlipRecord& op = operations_[i];
        for (Index slot = 0; slot < 2; ++slot) {
            const Link link = Link::to_operation(i, slot);
            if (!op.previous[slot].is_valid()) first_[Surface::face(op.half_edge[slot])] = link;
            if (!op.next[slot].is_valid()) last_[op.new_face[slot]] = link;
            op.previous[slot] = moved(op.previous[slot]);
            op.next[slot] = moved(op.next[slot]);
        }
    }
    for (std::size_t i = num_merges; i < merges_.size(); ++i) {
        MergeRecord& merge = merges_[i];
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
    const MergePassage step(merges_[link.merge()]);
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
        const FlipPassage step(operations_[link.operation()], way, link.slot());
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
            const MergePassage step(merges_[link.merge()]);
            if (way == Way::Forward) {
                const Index slot = link.slot();
                waiting.push_back(
                    {{step.forward(part.begin, slot), step.forward(part.end, slot)}, step.op.next});
                continue;
            }
            std::array<MergePassage::Part, 3> cuts;
            for (Index i = step.cut(part, cuts); i-- > 0;) {
                waiting.push_back({cuts[i].segment, step.op.previous[cuts[i].slot]});
            }
            continue;
        }
        const FlipPassage step(operations_[link.operation()], way, link.slot());
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
        const FlipPassage step(operations_[link.operation()], Way::Backward, link.slot());
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

    void pass(const MergePassage& step) {
        const FacePolygon whole = waiting.back().part;
        waiting.pop_back();
        for (const Index slot : {0U, 1U, 2U}) {
            if (step.op.half_edge[slot] == no_index) continue;
            add(step.clip(whole, slot), step.op.previous[slot]);
        }
    }

    void pass(const FlipPassage& step) {
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

    static void carry(const FlipPassage& step, Index slot, FacePolygon& part) {
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
            all.pass(MergePassage(merges_[link.merge()]));
        } else {
            all.pass(FlipPassage(operations_[link.operation()], Way::Backward, link.slot()));
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
