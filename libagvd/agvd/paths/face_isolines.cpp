#include "agvd/paths/face_isolines.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace agvd {
namespace {

// A share of the level: reaches that differ by less are equal.
constexpr double equal_reaches = 1e-12;
// A share of the level: shorter pieces of a curve are rounding.
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

// A circle, or a line, and the points that are seen from its centre: on the left of up to two
// lines. Its own places are given by directions: unit vectors from the centre, or ways along the
// line from its origin.
struct LevelCurve {
    Vec2 centre;  // Of a line the unit vector towards the site.
    double radius;
    SightLine line;  // The nearer side is on its left; along has length 1.
    Index site;
    std::array<SightLine, 2> seen;
    std::size_t num_seen;

    [[nodiscard]] bool is_line() const { return radius == infinity; }
    [[nodiscard]] Vec2 at(const Vec2& direction) const {
        if (is_line()) return line.origin + direction;
        return centre + radius * direction;
    }
    [[nodiscard]] Vec2 direction_to(const Vec2& p) const {
        if (is_line()) return p - line.origin;
        return (p - centre) / radius;
    }
    // How far a direction lies behind another one.
    [[nodiscard]] double way(const Vec2& from, const Vec2& to) const {
        return is_line() ? (to - from).dot(line.along) : radius * cross(from, to);
    }
    [[nodiscard]] Vec2 between(const Vec2& from, const Vec2& to) const {
        if (is_line()) return at((from + to) / 2);
        return centre + radius * (from + to).normalized();
    }
    // Whether it reaches p by less than `slack` more.
    [[nodiscard]] bool reaches(const Vec2& p, double slack) const {
        return is_line() ? line.height(p) > -slack : (p - centre).norm() < radius + slack;
    }
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

// A piece of a curve between two directions.
struct CurvePart {
    Vec2 from, to;
    PieceKind kind;
    Index arc = no_index;  // The arc that it is a part of.
};

class FaceLevel {
public:
    FaceLevel(const std::array<Vec2, 3>& corners, double level, std::vector<FaceArc>& arcs)
        : corners_(corners), level_(level), arcs_(arcs), first_arc_(size()) {
        for (std::size_t k = 0; k < 3; ++k) {
            sides_[k] = {corners[k], corners[(k + 1) % 3] - corners[k]};
            size_ = std::max(size_, sides_[k].along.norm());
        }
    }

    void run(std::span<const PlanarRelay> relays, bool with_bends) {
        for (const PlanarRelay& relay : relays) add_relay(relay, with_bends);
        if (is_covered_) return;
        for (const LevelCurve& curve : curves_) {
            const auto is_within = [&](const Vec2& corner) {
                return curve.is_line() ? curve.line.height(corner) >= 0
                                       : (corner - curve.centre).norm() <= curve.radius;
            };
            if (std::all_of(corners_.begin(), corners_.end(), is_within)) continue;
            cut(curve);
        }
        join();
    }

private:
    [[nodiscard]] Index size() const { return static_cast<Index>(arcs_.size()); }

    void add_relay(const PlanarRelay& relay, bool with_bends) {
        const bool is_parallel = relay.is_parallel;
        const double least =
            is_parallel ? std::min(relay.at_begin, relay.at_end)
            : relay.sees_all
                ? relay.weight
                : relay.weight + distance_to_segment(relay.image, relay.begin, relay.end);
        if (!(least < level_)) return;
        const Vec2& u = relay.image;
        if (is_parallel && u == Vec2(0, 0)) {
            is_covered_ = true;
            return;
        }
        const SightLine before = is_parallel ? SightLine{relay.begin, u}
                                             : SightLine{relay.image, relay.image - relay.begin};
        const SightLine behind = is_parallel ? SightLine{relay.end, -u}
                                             : SightLine{relay.image, relay.end - relay.image};
        const SightLine no_line{Vec2(0, 0), Vec2(0, 0)};
        const auto add = [&](const Vec2& centre, double weight,
                             const std::array<SightLine, 2>& seen, std::size_t num_seen) {
            if (!(weight < level_)) return;
            curves_.push_back({centre, level_ - weight, no_line, relay.site, seen, num_seen});
        };
        if (is_parallel) {
            const SightLine line{(relay.weight - level_) * u, {u.y(), -u.x()}};
            curves_.push_back({u, infinity, line, relay.site, {before, behind}, 2});
        } else {
            add(relay.image, relay.weight, {before, behind}, relay.sees_all ? 0 : 2);
        }
        if (!with_bends || relay.sees_all) return;
        add(relay.begin, relay.at_begin, {SightLine{before.origin, -before.along}, behind}, 1);
        add(relay.end, relay.at_end, {SightLine{behind.origin, -behind.along}, before}, 1);
    }

    // Adds the directions in which a curve meets a line.
    void meet(const LevelCurve& curve, const SightLine& line) {
        if (curve.is_line()) {
            const double sine = cross(line.along, curve.line.along);
            if (sine == 0) return;
            return add_direction(curve,
                                 curve.line.along * (-line.height(curve.line.origin) / sine));
        }
        for_chord(curve, line, [&](const Vec2& v) { add_direction(curve, v); });
    }
    // Calls visit(way from the centre of a circle) for both places where it meets a line.
    template <typename Visit>
    static void for_chord(const LevelCurve& circle, const SightLine& line, const Visit& visit) {
        const double length = line.along.norm();
        if (!(length > 0)) return;
        const Vec2 along = line.along / length;
        const double height = cross(along, circle.centre - line.origin);
        const double half_sq = (circle.radius - height) * (circle.radius + height);
        if (!(half_sq >= 0)) return;
        const Vec2 foot = Vec2(along.y(), -along.x()) * height;
        const double half = std::sqrt(half_sq);
        visit(foot + half * along);
        visit(foot - half * along);
    }
    void meet(const LevelCurve& circle, const LevelCurve& other) {
        if (other.is_line()) return meet(circle, other.line);
        if (circle.is_line()) {
            return for_chord(other, circle.line, [&](const Vec2& v) {
                const Vec2 way = other.centre + v - circle.line.origin;
                add_direction(circle, circle.line.along * way.dot(circle.line.along));
            });
        }
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
    // Unless the curve is clearly outside the face there: such a change does not matter.
    void add_direction(const LevelCurve& curve, const Vec2& v) {
        const double length = v.norm();
        if (!curve.is_line() && !(length > 0)) return;
        const Vec2 p =
            curve.is_line() ? curve.at(v) : Vec2(curve.centre + v * (curve.radius / length));
        for (const SightLine& side : sides_) {
            if (side.height(p) < -beside_face * side.along.squaredNorm()) return;
        }
        directions_.push_back(curve.is_line() ? v : Vec2(v / length));
    }

    // Cuts a curve at all directions where something may change, and takes the pieces that count.
    void cut(const LevelCurve& curve) {
        if (curve.is_line()) {
            const Vec2 beyond = 4 * (size_ + curve.line.origin.norm()) * curve.line.along;
            directions_ = {-beyond, beyond};
        } else {
            directions_ = {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)};
        }
        for (const SightLine& side : sides_) meet(curve, side);
        for (const LevelCurve& other : curves_) {
            if (&other != &curve) meet(curve, other);
            for (std::size_t k = 0; k < other.num_seen; ++k) meet(curve, other.seen[k]);
        }
        std::sort(directions_.begin(), directions_.end(), [&](const Vec2& a, const Vec2& b) {
            return curve.is_line() ? a.dot(curve.line.along) < b.dot(curve.line.along)
                                   : pseudo_angle(a) < pseudo_angle(b);
        });
        pieces_.clear();
        for (std::size_t i = 0; i < directions_.size(); ++i) {  // Of a line the last way goes back.
            const Vec2& from = directions_[i];
            const Vec2& to = directions_[(i + 1) % directions_.size()];
            if (!(curve.way(from, to) > shortest_piece * level_)) continue;
            pieces_.push_back({from, to, judge(curve, curve.between(from, to))});
        }
        take_pieces(curve);
    }

    // Makes arcs of the pieces that count: an arc of several, where it stays short enough.
    void take_pieces(const LevelCurve& curve) {
        const std::size_t count = pieces_.size();
        for (std::size_t i = 0; i < count; ++i) {
            CurvePart& piece = pieces_[i];
            if (piece.kind != PieceKind::Kept) continue;
            const Vec2 end = curve.at(piece.to);
            if (i > 0 && pieces_[i - 1].kind == PieceKind::Kept) {
                FaceArc& last = arcs_.back();
                const Vec2 start = curve.direction_to(last.begin.at);
                if (curve.is_line() ||
                    (cross(start, piece.to) > 0 && start.dot(piece.to) > longest_arc)) {
                    last.end.at = end;
                    piece.arc = pieces_[i - 1].arc;
                    continue;
                }
            }
            piece.arc = size();
            const Vec2 begin = curve.at(piece.from);
            arcs_.push_back({curve.centre, curve.radius, curve.site, {begin}, {end}});
        }
        for (std::size_t i = 0; i < count; ++i) {
            const CurvePart& before = pieces_[i];
            const CurvePart& behind = pieces_[(i + 1) % count];
            const bool is_kept = before.kind == PieceKind::Kept;
            if (is_kept && behind.kind == PieceKind::Outside) on_side(arcs_[before.arc].end);
            if (behind.kind != PieceKind::Kept) continue;
            if (before.kind == PieceKind::Outside) on_side(arcs_[behind.arc].begin);
            if (is_kept && before.arc != behind.arc) arcs_[before.arc].next = behind.arc;
        }
    }

    [[nodiscard]] PieceKind judge(const LevelCurve& curve, const Vec2& p) const {
        for (const SightLine& side : sides_) {
            if (side.height(p) < 0) return PieceKind::Outside;
        }
        if (!curve.sees(p)) return PieceKind::Hidden;
        const auto own = &curve - curves_.data();
        for (std::ptrdiff_t i = 0; i < std::ssize(curves_); ++i) {
            const LevelCurve& other = curves_[static_cast<std::size_t>(i)];
            if (i == own || !other.sees(p)) continue;
            const double slack = (i < own ? 1 : -1) * equal_reaches * level_;
            if (other.reaches(p, slack)) return PieceKind::Hidden;
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
    double size_ = 0;          // Of the face.
    bool is_covered_ = false;  // A region holds the face: no point is as far as the level.
    std::vector<LevelCurve> curves_;
    std::vector<Vec2> directions_;   // Of the curve at hand.
    std::vector<CurvePart> pieces_;  // Of that curve, counter-clockwise.
};

}  // namespace

void append_face_arcs(const std::array<Vec2, 3>& corners, std::span<const PlanarRelay> relays,
                      double level, bool with_bends, std::vector<FaceArc>& arcs) {
    FaceLevel(corners, level, arcs).run(relays, with_bends);
}

}  // namespace agvd
