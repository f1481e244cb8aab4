// A chord crosses the input's edges beside its arc; Newton along the edge finds the arc's own
// point. A piece is halved, at a point of the arc, unless its arc crosses the same edges and no
// others: each part of the arc lies in the triangle of its chord and its tangents, which must lie
// in the face.
#include "agvd/diagram/arc_on_input.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "agvd/diagram/bisectors.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

constexpr int most_depth = 40;
constexpr int most_halvings_of_piece = 200;
constexpr int most_steps_along_edge = 12;
// A share of a face's longest side: points so near to a side lie on it.
constexpr double beside_face = 1e-12;
// A chord is not halved if it is no longer than this many times the distance of its ends from the
// conic.
constexpr double most_beside = 8;
// A crossing moves at most so many lengths of the segment that tells the arc's direction.
constexpr double farthest_move = 100;

double length_of(const InputSegment& segment) { return (segment.at_end - segment.at_begin).norm(); }

// The side of the first segment's face through which the arc comes to the second.
std::optional<Index> side_between(const Surface& input, const InputSegment& before,
                                  const InputSegment& behind) {
    std::optional<Index> best;
    for (Index k = 0; k < 3; ++k) {
        const Index h = 3 * before.begin.face.value() + k;
        const Index twin = input.twin[h];
        if (twin == no_index || FaceId(Surface::face(twin)) != behind.begin.face) continue;
        const auto height = [&](Index side) { return before.end.barycentric[(side + 2) % 3]; };
        if (!best || height(k) < height(*best % 3)) best = h;
    }
    return best;
}

// Where a conic crosses a side near a share of its way; not finite if Newton does not find it.
double crossing_near(const Conic& conic, const Vec2& tail, const Vec2& along, double at) {
    for (int i = 0; i < most_steps_along_edge; ++i) {
        const Vec2 p = tail + at * along;
        const double step = conic.gap(p) / conic.gradient(p).dot(along);
        at -= step;
        if (!(std::abs(step) > 1e-15)) break;
    }
    return at;
}

}  // namespace

Motion InputSegment::motion() const {
    const Vec2 here = base_end - base_begin, there = at_end - at_begin;
    const Vec2 both(here.dot(there), cross(here, there));
    const Vec2 axis = both.norm() > 0 ? Vec2(both.normalized()) : Vec2(1, 0);
    return {axis, at_begin - Motion{axis, {0, 0}}(base_begin)};
}

Conic moved(const Motion& motion, const Conic& conic) {
    return {{motion(conic.focus[0]), motion(conic.focus[1])}, conic.weight};
}

void ArcMapper::map(const Conic& conic, bool is_line, const SurfacePoint& begin,
                    const SurfacePoint& end, std::vector<InputSegment>& out) {
    conic_ = conic;
    is_line_ = is_line;
    face_ = begin.face.value();
    halvings_left_ = most_halvings_of_piece;
    map_between({begin, position_in_frame(base_.surface(), begin, 3 * face_)},
                {end, position_in_frame(base_.surface(), end, 3 * face_)}, 0, out);
}

void ArcMapper::map_between(const BasePoint& begin, const BasePoint& end, int depth,
                            std::vector<InputSegment>& out) {
    cut(begin, end);
    if (depth < most_depth && halvings_left_ > 0 && !follow_arc()) {
        --halvings_left_;
        const Vec2 top = conic_.between(begin.at, end.at, 0.5);
        const BasePoint middle{to_surface(base_.surface(), face_, top), top};
        map_between(begin, middle, depth + 1, out);
        map_between(middle, end, depth + 1, out);
        return;
    }
    out.insert(out.end(), segments_.begin(), segments_.end());
}

// The segments of a chord, one in each face.
void ArcMapper::cut(const BasePoint& begin, const BasePoint& end) {
    points_.clear();
    segments_.clear();
    base_.to_input(begin.point, end.point, points_);
    const auto place = [&](const SurfacePoint& p) {
        return position_in_frame(input_, p, 3 * p.face.value());
    };
    double length = 0;
    for (std::size_t i = 0; i < points_.size(); i += 2) {
        segments_.push_back({points_[i], points_[i + 1], place(points_[i]), place(points_[i + 1]),
                             begin.at, end.at});
        length += length_of(segments_.back());
    }
    double passed = 0;
    const auto at = [&]() -> Vec2 {
        const double share = length > 0 ? passed / length : 0;
        return (1 - share) * begin.at + share * end.at;
    };
    for (InputSegment& segment : segments_) {
        segment.base_begin = at();
        passed += length_of(segment);
        if (&segment != &segments_.back()) segment.base_end = at();
    }
    std::size_t last = 0;
    for (std::size_t i = 1; i < segments_.size(); ++i) {
        if (segments_[i].begin.face != segments_[last].begin.face) {
            segments_[++last] = segments_[i];
        } else {
            segments_[last].end = segments_[i].end;
            segments_[last].at_end = segments_[i].at_end;
            segments_[last].base_end = segments_[i].base_end;
        }
    }
    segments_.resize(last + 1);
}

// Moves the crossings onto the arc. False, and some are moved: it takes another way.
bool ArcMapper::follow_arc() {
    for (std::size_t i = 0; i + 1 < segments_.size(); ++i) {
        if (!move_crossing(segments_[i], segments_[i + 1])) return false;
    }
    if (is_line_) return true;
    for (const InputSegment& segment : segments_) {
        if (!stays_in_face(segment)) return false;
    }
    return true;
}

bool ArcMapper::move_crossing(InputSegment& before, InputSegment& behind) const {
    const std::optional<Index> side = side_between(input_, before, behind);
    if (!side) return false;
    // The longer segment tells the direction better. Its first end may have been moved.
    const bool by_before = length_of(before) >= length_of(behind);
    const InputSegment& known = by_before ? before : behind;
    const Motion motion = known.motion();
    const Index h = by_before ? *side : input_.twin[*side];
    const auto corners = face_corners(input_, Surface::face(h));
    const Vec2& tail = corners[h % 3];
    const Vec2 along = corners[(h + 1) % 3] - tail;
    const Vec2 start = by_before ? before.at_end : behind.at_begin;
    const double at = crossing_near(moved(motion, conic_), tail, along,
                                    (start - tail).dot(along) / along.squaredNorm());
    if (!(at > 0 && at < 1)) return false;
    const Vec2 p = tail + at * along;
    if ((p - start).norm() > farthest_move * length_of(known)) return false;
    const Motion back{{motion.axis.x(), -motion.axis.y()}, {0, 0}};
    before.base_end = behind.base_begin = back(p - motion.origin);
    before.end = point_on(*side, by_before ? at : 1 - at);
    behind.begin = across_edge(input_, before.end, *side);
    before.at_end = position_in_frame(input_, before.end, 3 * before.end.face.value());
    behind.at_begin = position_in_frame(input_, behind.begin, 3 * behind.begin.face.value());
    return true;
}

bool ArcMapper::stays_in_face(const InputSegment& segment) const {
    const Conic conic = moved(segment.motion(), conic_);
    const Vec2 chord = segment.at_end - segment.at_begin;
    const Vec2 first = conic.gradient(segment.at_begin), last = conic.gradient(segment.at_end);
    const auto corners = face_corners(input_, segment.begin.face.value());
    const double size = longest_side(corners);
    // Below the rounding of the face's size it does not matter where the tangents meet.
    if (conic.most_stray(segment.at_begin, segment.at_end) <= beside_face * size) return true;
    const Vec2 apex =
        segment.at_begin + chord.dot(last) / cross(first, last) * Vec2(-first.y(), first.x());
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 side = corners[(k + 1) % 3] - corners[k];
        if (cross(side, apex - corners[k]) >= -beside_face * size * side.norm()) continue;
        // With errors in the distances the arc's ends lie beside the conic.
        const double beside = std::max(std::abs(conic.gap(segment.at_begin)) / first.norm(),
                                       std::abs(conic.gap(segment.at_end)) / last.norm());
        return chord.norm() <= most_beside * beside;
    }
    return true;
}

}  // namespace agvd
