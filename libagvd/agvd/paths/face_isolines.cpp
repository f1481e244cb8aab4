#include "agvd/paths/face_isolines.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace agvd {
namespace {

// A share of the level: reaches that differ by less are equal.
constexpr double equal_reaches = 1e-12;
// A share of the level: shorter pieces of a circle are rounding.
constexpr double shortest_piece = 1e-12;
// A share of a side: farther from the face, a point is outside.
constexpr double beside_face = 1e-6;
// Cosine of the longest arc's angle.
constexpr double longest_arc = -0.5;

// A side of a line, on its left.
struct SightLine {
    Vec2 origin, along;

    [[nodiscard]] double height(const Vec2& p) const { return cross(along, p - origin); }
};

// A circle, and the points that are seen from its centre: on the left of up to two lines.
struct LevelCircle {
    Vec2 centre;
    double radius;
    Index site;
    std::array<SightLine, 2> seen;
    std::size_t num_seen;

    [[nodiscard]] bool sees(const Vec2& p) const {
        return (num_seen < 1 || seen[0].height(p) >= 0) && (num_seen < 2 || seen[1].height(p) >= 0);
    }
};

// Grows with the angle, from 0 to below 4.
double pseudo_angle(const Vec2& v) {
    const double share = v.y() / (std::abs(v.x()) + std::abs(v.y()));
    if (v.x() < 0) return 2 - share;
    return v.y() < 0 ? 4 + share : share;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double length_sq = along.squaredNorm();
    const double at = length_sq > 0 ? std::clamp((p - a).dot(along) / length_sq, 0.0, 1.0) : 0;
    return (p - a - at * along).norm();
}

enum class PieceKind : std::uint8_t { Kept, Outside, Hidden };

// A piece of a circle between two directions from its centre.
struct CirclePiece {
    Vec2 from, to;
    PieceKind kind;
    Index arc = no_index;  // That it is a part of.
};

class FaceLevel {
public:
    FaceLevel(const std::array<Vec2, 3>& corners, double level, std::vector<FaceArc>& arcs)
        : corners_(corners), level_(level), arcs_(arcs), first_arc_(size()) {
        for (std::size_t k = 0; k < 3; ++k) {
            sides_[k] = {corners[k], corners[(k + 1) % 3] - corners[k]};
        }
    }

    void run(std::span<const PlanarRelay> relays, bool with_bends) {
        for (const PlanarRelay& relay : relays) add_relay(relay, with_bends);
        for (const LevelCircle& circle : circles_) {
            const auto is_within = [&](const Vec2& corner) {
                return (corner - circle.centre).norm() <= circle.radius;
            };
            if (std::all_of(corners_.begin(), corners_.end(), is_within)) continue;
            cut(circle);
        }
        join();
    }

private:
    [[nodiscard]] Index size() const { return static_cast<Index>(arcs_.size()); }

    void add_relay(const PlanarRelay& relay, bool with_bends) {
        const double least =
            relay.sees_all ? 0 : distance_to_segment(relay.image, relay.begin, relay.end);
        if (!(relay.weight + least < level_)) return;
        const SightLine before{relay.image, relay.image - relay.begin};
        const SightLine behind{relay.image, relay.end - relay.image};
        const auto add = [&](const Vec2& centre, double weight,
                             const std::array<SightLine, 2>& seen, std::size_t num_seen) {
            if (!(weight < level_)) return;
            circles_.push_back({centre, level_ - weight, relay.site, seen, num_seen});
        };
        add(relay.image, relay.weight, {before, behind}, relay.sees_all ? 0 : 2);
        if (!with_bends || relay.sees_all) return;
        add(relay.begin, relay.at_begin, {SightLine{relay.image, -before.along}, behind}, 1);
        add(relay.end, relay.at_end, {SightLine{relay.image, -behind.along}, before}, 1);
    }

    // Adds the directions in which a circle meets a line.
    void meet(const LevelCircle& circle, const SightLine& line) {
        const double length = line.along.norm();
        if (!(length > 0)) return;
        const Vec2 along = line.along / length;
        const double height = cross(along, circle.centre - line.origin);
        const double half_sq = (circle.radius - height) * (circle.radius + height);
        if (!(half_sq >= 0)) return;
        const Vec2 foot = Vec2(along.y(), -along.x()) * height;
        const double half = std::sqrt(half_sq);
        add_direction(circle, foot + half * along);
        add_direction(circle, foot - half * along);
    }
    void meet(const LevelCircle& circle, const LevelCircle& other) {
        const Vec2 between = other.centre - circle.centre;
        const double distance_sq = between.squaredNorm();
        if (!(distance_sq > 0)) return;
        const double sum = circle.radius + other.radius, difference = circle.radius - other.radius;
        if (!(difference * difference <= distance_sq && distance_sq <= sum * sum)) return;
        const double at = (1 + difference * sum / distance_sq) / 2;
        const double half_sq = circle.radius * circle.radius / distance_sq - at * at;
        const double half = std::sqrt(std::max(half_sq, 0.0));
        const Vec2 across(-between.y(), between.x());
        add_direction(circle, at * between + half * across);
        add_direction(circle, at * between - half * across);
    }
    // Unless the circle is clearly outside the face there: such a change does not matter.
    void add_direction(const LevelCircle& circle, const Vec2& v) {
        const double length = v.norm();
        if (!(length > 0)) return;
        const Vec2 p = circle.centre + v * (circle.radius / length);
        for (const SightLine& side : sides_) {
            if (side.height(p) < -beside_face * side.along.squaredNorm()) return;
        }
        directions_.push_back(v / length);
    }

    // Cuts a circle at all directions where something may change, and takes the pieces that count.
    void cut(const LevelCircle& circle) {
        directions_ = {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)};
        for (const SightLine& side : sides_) meet(circle, side);
        for (const LevelCircle& other : circles_) {
            if (&other != &circle) meet(circle, other);
            for (std::size_t k = 0; k < other.num_seen; ++k) meet(circle, other.seen[k]);
        }
        std::sort(directions_.begin(), directions_.end(),
                  [](const Vec2& a, const Vec2& b) { return pseudo_angle(a) < pseudo_angle(b); });
        pieces_.clear();
        for (std::size_t i = 0; i < directions_.size(); ++i) {
            const Vec2& from = directions_[i];
            const Vec2& to = directions_[(i + 1) % directions_.size()];
            if (!(circle.radius * cross(from, to) > shortest_piece * level_)) continue;
            const Vec2 middle = circle.centre + circle.radius * (from + to).normalized();
            pieces_.push_back({from, to, judge(circle, middle)});
        }
        take_pieces(circle);
    }

    // Makes arcs of the pieces that count: an arc of several, where it stays short enough.
    void take_pieces(const LevelCircle& circle) {
        const std::size_t count = pieces_.size();
        for (std::size_t i = 0; i < count; ++i) {
            CirclePiece& piece = pieces_[i];
            if (piece.kind != PieceKind::Kept) continue;
            const Vec2 end = circle.centre + circle.radius * piece.to;
            if (i > 0 && pieces_[i - 1].kind == PieceKind::Kept) {
                FaceArc& last = arcs_.back();
                const Vec2 start = (last.begin.at - circle.centre) / circle.radius;
                if (cross(start, piece.to) > 0 && start.dot(piece.to) > longest_arc) {
                    last.end.at = end;
                    piece.arc = pieces_[i - 1].arc;
                    continue;
                }
            }
            piece.arc = size();
            const Vec2 begin = circle.centre + circle.radius * piece.from;
            arcs_.push_back({circle.centre, circle.radius, circle.site, {begin}, {end}});
        }
        for (std::size_t i = 0; i < count; ++i) {
            const CirclePiece& before = pieces_[i];
            const CirclePiece& behind = pieces_[(i + 1) % count];
            const bool is_kept = before.kind == PieceKind::Kept;
            if (is_kept && behind.kind == PieceKind::Outside) on_side(arcs_[before.arc].end);
            if (behind.kind != PieceKind::Kept) continue;
            if (before.kind == PieceKind::Outside) on_side(arcs_[behind.arc].begin);
            if (is_kept && before.arc != behind.arc) arcs_[before.arc].next = behind.arc;
        }
    }

    [[nodiscard]] PieceKind judge(const LevelCircle& circle, const Vec2& p) const {
        for (const SightLine& side : sides_) {
            if (side.height(p) < 0) return PieceKind::Outside;
        }
        if (!circle.sees(p)) return PieceKind::Hidden;
        const auto own = &circle - circles_.data();
        for (std::ptrdiff_t i = 0; i < std::ssize(circles_); ++i) {
            const LevelCircle& other = circles_[static_cast<std::size_t>(i)];
            if (i == own || !other.sees(p)) continue;
            const double slack = (i < own ? 1 : -1) * equal_reaches * level_;
            if ((p - other.centre).norm() < other.radius + slack) return PieceKind::Hidden;
        }
        return PieceKind::Kept;
    }

    // Puts an end on the side that is nearest to it.
    void on_side(FaceArcEnd& end) const {
        double least = infinity;
        for (Index k = 0; k < 3; ++k) {
            const SightLine& side = sides_[k];
            const double height = std::abs(side.height(end.at)) / side.along.norm();
            if (height < least) {
                least = height;
                end.side = k;
            }
        }
    }

    // Lets the ends inside the face follow one another: the nearest first.
    void join() {
        struct Pair {
            double distance_sq;
            Index before, after;
        };
        std::vector<Pair> pairs;
        std::vector<bool> is_entered(size() - first_arc_, false);
        for (Index i = first_arc_; i < size(); ++i) {
            if (arcs_[i].next != no_index) is_entered[arcs_[i].next - first_arc_] = true;
        }
        for (Index i = first_arc_; i < size(); ++i) {
            if (arcs_[i].next != no_index || arcs_[i].end.side != no_index) continue;
            for (Index j = first_arc_; j < size(); ++j) {
                if (is_entered[j - first_arc_] || arcs_[j].begin.side != no_index) continue;
                pairs.push_back({(arcs_[i].end.at - arcs_[j].begin.at).squaredNorm(), i, j});
            }
        }
        std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
            return std::tie(a.distance_sq, a.before, a.after) <
                   std::tie(b.distance_sq, b.before, b.after);
        });
        for (const auto& [distance_sq, before, after] : pairs) {
            if (arcs_[before].next != no_index || is_entered[after - first_arc_]) continue;
            arcs_[before].next = after;
            is_entered[after - first_arc_] = true;
        }
        // Rounding: what has no partner inside lies on a side.
        for (Index i = first_arc_; i < size(); ++i) {
            FaceArc& arc = arcs_[i];
            if (arc.next == no_index && arc.end.side == no_index) on_side(arc.end);
            if (!is_entered[i - first_arc_] && arc.begin.side == no_index) on_side(arc.begin);
        }
    }

    const std::array<Vec2, 3>& corners_;
    double level_;
    std::vector<FaceArc>& arcs_;
    Index first_arc_;
    std::array<SightLine, 3> sides_;
    std::vector<LevelCircle> circles_;
    std::vector<Vec2> directions_;     // Of the circle at hand, from its centre.
    std::vector<CirclePiece> pieces_;  // Of that circle, counter-clockwise.
};

}  // namespace

void append_face_arcs(const std::array<Vec2, 3>& corners, std::span<const PlanarRelay> relays,
                      double level, bool with_bends, std::vector<FaceArc>& arcs) {
    FaceLevel(corners, level, arcs).run(relays, with_bends);
}

}  // namespace agvd
