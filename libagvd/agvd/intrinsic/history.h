//! \file
//! A record of flips, splits and merges of faces: it carries points and segments through them,
//! forward and backward. Private.
#pragma once

#include "agvd/intrinsic/passages.h"

namespace agvd::detail {

//! An operation lays one or two faces out in a plane and cuts them anew. Barycentric coordinates
//! pass by the shares of the quad at a few roundings of 1; those that are exactly 0 stay so on
//! edges that stay. 56 bytes for each operation, 8 for each face if there is one.
class FaceHistory {
public:
    explicit FaceHistory(Index num_faces) : num_faces_(num_faces) {}

    void add(const FaceFlip& flip) {
        const auto& [h, twin, shares] = flip;
        add(FlipRecord{{h, twin}, {Surface::face(h), Surface::face(twin)}, {}, {}, shares});
    }

    void add(const FaceMerge& made) {
        start();
        MergeRecord merge{made.half_edge, made.face, {}, {}, made.shares};
        const std::size_t number = merges_.size();
        for (Index slot = 0; slot < 3; ++slot) {
            if (merge.half_edge[slot] == no_index) continue;
            merge.previous[slot] =
                chain(Surface::face(merge.half_edge[slot]), Link::to_merge(number, slot));
        }
        last_[made.face] = Link::to_merge(number, 0);
        merges_.push_back(merge);
    }

    //! Face (a, b, c) became (a, m, c). The new face is (m, b, c) and has the highest number.
    void add_split(Index half_edge, Index new_face) {
        add(FlipRecord{
            {half_edge, no_index}, {Surface::face(half_edge), new_face}, {}, {}, {0.5, 0.5, 0}});
    }

    //! A face of the end gets another number, which no face has.
    void move_face(Index from, Index to) {
        start();
        const Link made_by = last_[from];
        if (!made_by.is_valid()) {  // Its third corner merges with it: nothing moves.
            add(FaceMerge{to, {3 * from, no_index, no_index}, {0, 0, 1}});
            return;
        }
        last_[to] = made_by;
        if (made_by.is_merge()) {
            merges_[made_by.merge()].new_face = to;
        } else {
            flips_[made_by.flip()].new_face[made_by.slot()] = to;
        }
    }

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
                                                    Index most_steps = no_index) const {
        Link link = first_link(way, point.face.value());
        if (!link.is_valid()) return point;
        for (Index steps = 0; link.is_valid(); ++steps) {
            if (steps == most_steps) return std::nullopt;
            if (!link.is_merge()) {
                const FlipPassage step(flips_[link.flip()], way, link.slot());
                const QuadPoint in_quad = step.in_quad(point);
                const double side = step.side(in_quad);
                const Index slot = side >= 0 ? 0 : 1;
                point = step.pass(in_quad, slot, side == 0);
                link = step.next_link(slot);
                continue;
            }
            const MergePassage step(merges_[link.merge()]);
            if (way == Way::Forward) {
                point = step.forward(point, link.slot());
                link = step.op.next;
            } else {
                const Index slot = step.slot_of(point.barycentric);
                point = step.backward(point.barycentric, slot, 3);
                link = step.op.previous[slot];
            }
        }
        return normalized(point);
    }

    //! Appends begin and end of each part of a segment in a face of the end, in their order.
    void carry_back(const SurfacePoint& begin, const SurfacePoint& end,
                    std::vector<SurfacePoint>& parts) const {
        struct Waiting {
            FaceSegment segment;
            Link link;
        };
        std::vector<Waiting> waiting{{{begin, end}, first_link(Way::Backward, begin.face.value())}};
        if (!waiting[0].link.is_valid()) {
            parts.insert(parts.end(), {begin, end});
            return;
        }
        while (!waiting.empty()) {
            const auto [part, link] = waiting.back();
            waiting.pop_back();
            if (!link.is_valid()) {
                parts.insert(parts.end(), {normalized(part.begin), normalized(part.end)});
                continue;
            }
            if (link.is_merge()) {
                const MergePassage step(merges_[link.merge()]);
                std::array<MergePassage::Part, 3> cuts;
                for (Index i = step.cut(part, cuts); i-- > 0;) {
                    waiting.push_back({cuts[i].segment, step.op.previous[cuts[i].slot]});
                }
                continue;
            }
            const FlipPassage step(flips_[link.flip()], Way::Backward, link.slot());
            const QuadPoint from = step.in_quad(part.begin), to = step.in_quad(part.end);
            const double from_side = step.side(from), to_side = step.side(to);
            const Index slot = from_side > 0 || (from_side == 0 && to_side >= 0) ? 0 : 1;
            if ((from_side > 0 && to_side < 0) || (from_side < 0 && to_side > 0)) {
                const QuadPoint cut = between(from, to, from_side / (from_side - to_side));
                waiting.push_back({{step.pass(cut, 1 - slot, true), step.pass(to, 1 - slot, false)},
                                   step.next_link(1 - slot)});
                waiting.push_back({{step.pass(from, slot, false), step.pass(cut, slot, true)},
                                   step.next_link(slot)});
                continue;
            }
            waiting.push_back({{step.pass(from, slot, from_side == 0),  //
                                step.pass(to, slot, to_side == 0)},
                               step.next_link(slot)});
        }
    }

    //! Appends the parts of a face of the end in the faces of the beginning.
    //! \return false if that takes more than `most_steps` passes of a part through an operation, or
    //!        a part with too many corners; then `parts` means nothing.
    // Records are large, so a part that is not cut is changed in place.
    [[nodiscard]] bool parts_of(Index face, Index most_steps,
                                std::vector<FacePolygon>& parts) const {
        struct Waiting {
            FacePolygon part;
            Link link;
        };
        std::vector<Waiting> waiting;
        waiting.reserve(16);
        waiting.push_back(
            {{face, 3, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}, first_link(Way::Backward, face)});
        const auto add = [&](const FacePolygon& part, Link link) {
            if (part.num_corners >= 3) waiting.push_back({part, link});
        };
        for (Index steps = 0; !waiting.empty(); ++steps) {
            auto& [part, link] = waiting.back();
            if (!link.is_valid()) {
                parts.push_back(part);
                waiting.pop_back();
                continue;
            }
            if (steps == most_steps || part.num_corners + 2 > FacePolygon::most_corners)
                return false;
            if (link.is_merge()) {
                const MergePassage step(merges_[link.merge()]);
                const FacePolygon whole = part;
                waiting.pop_back();
                for (const Index slot : {0U, 1U, 2U}) {
                    if (step.op.half_edge[slot] == no_index) continue;
                    add(step.clip(whole, slot), step.op.previous[slot]);
                }
                continue;
            }
            const FlipPassage step(flips_[link.flip()], Way::Backward, link.slot());
            if (const std::optional<Index> slot = step.slot_of(part)) {
                step.carry(*slot, part);
                link = step.next_link(*slot);
                continue;
            }
            const FacePolygon whole = part;
            waiting.pop_back();
            for (const Index slot : {0U, 1U}) add(step.clip(whole, slot), step.next_link(slot));
        }
        return true;
    }

private:
    static SurfacePoint normalized(SurfacePoint point) {
        const auto& [a, b, c] = point.barycentric;
        const double sum = a + b + c;
        for (double& share : point.barycentric) share /= sum;
        return point;
    }

    using Link = OperationLink;

    void start() {
        if (!last_.empty()) return;
        first_.assign(num_faces_, {});
        last_.assign(num_faces_, {});
    }

    void add(FlipRecord record) {
        start();
        const std::size_t number = flips_.size();
        for (Index slot = 0; slot < 2; ++slot) {
            if (record.half_edge[slot] == no_index) continue;
            const Index face = Surface::face(record.half_edge[slot]);
            record.previous[slot] = chain(face, Link::to_flip(number, slot));
        }
        for (Index slot = 0; slot < 2; ++slot) {
            const Index face = record.new_face[slot];
            if (face >= last_.size()) last_.resize(face + 1);
            last_[face] = Link::to_flip(number, slot);
        }
        flips_.push_back(record);
    }

    // Follows the last link of an old face with another one.
    Link chain(Index face, Link link) {
        const Link made_by = last_[face];
        if (!made_by.is_valid()) {
            first_[face] = link;
        } else if (made_by.is_merge()) {
            merges_[made_by.merge()].next = link;
        } else {
            flips_[made_by.flip()].next[made_by.slot()] = link;
        }
        return made_by;
    }

    [[nodiscard]] Link first_link(Way way, Index face) const {
        const std::vector<Link>& links = way == Way::Forward ? first_ : last_;
        return face < links.size() ? links[face] : Link();
    }

    Index num_faces_;  // Of the beginning.
    std::vector<FlipRecord> flips_;
    std::vector<MergeRecord> merges_;
    std::vector<Link> first_;  // By face of the beginning: the link that changes it first.
    std::vector<Link> last_;   // By face of the end: the link that made it.
};

}  // namespace agvd::detail
