// An arc is halved until, on each part, one relay of either site is proved to be the nearest.
//
// Notation: m is the bisector's point opposite to the middle of a part, whose ends are at most h
// from m; f and g are the distance through the nearest relay and its gradient, f' and g' those of
// another relay, rho is the length of the path's last piece. Distances through a relay are convex,
// and |x - focus| <= rho + u . (x - m) + |x - m|^2 / (2 rho). So on the part
//   f' - f >= f'(m) - f(m) - |g' - g| h - h^2 / (2 rho).
#include "agvd/diagram/arc_shapes.h"

#include <cmath>

namespace agvd {
namespace {

// Distances that differ by less are equal: a share of them and of the triangle's size.
constexpr double equal_reaches = 2e-13;
constexpr int most_halvings = 48;
constexpr int most_choices = 6;  // Of the relays at the middle of one part.
constexpr int most_doublings = 16;  // Of the pieces of one conic.

struct Middle {
    Vec2 point;
    std::array<Reach, 2> reaches;

    [[nodiscard]] Conic conic() const {
        return {{reaches[0].from, reaches[1].from},
                {reaches[0].distance - reaches[0].last_piece,
                 reaches[1].distance - reaches[1].last_piece}};
    }
};

class ArcShaper {
public:
    ArcShaper(const std::array<Relays, 2>& relays, double size) : relays_(relays), size_(size) {}

    struct Piece {
        Vec2 end;
        ArcKind kind;
        Conic conic;
    };

    std::vector<Piece> run(const Chord& ends) {
        halve(ends, 0);
        return std::move(pieces_);
    }

private:
    [[nodiscard]] double slack(double distance) const {
        return equal_reaches * (size_ + distance);
    }
    [[nodiscard]] bool is_same(const Reach& a, const Reach& b) const {
        const double slack_here = slack(a.distance);
        return std::abs((a.distance - a.last_piece) - (b.distance - b.last_piece)) <= slack_here &&
               (a.from - b.from).norm() <= slack_here;
    }

    [[nodiscard]] std::array<Reach, 2> reaches_at(const Vec2& p) const {
        return {least_reach(relays_[0], p), least_reach(relays_[1], p)};
    }

    [[nodiscard]] std::optional<Middle> find_middle(const Chord& part) const {
        const Vec2 centre = (part.from + part.to) / 2;
        const double length = (part.to - part.from).norm();
        Middle middle{centre, reaches_at(centre)};
        for (int i = 0; i < most_choices; ++i) {
            const auto& [a, b] = middle.reaches;
            if (!std::isfinite(a.distance + b.distance)) return {};
            middle.point = middle.conic().opposite(part.from, part.to, 0.5);
            if (!((middle.point - centre).norm() <= length)) break;
            const std::array<Reach, 2> here = reaches_at(middle.point);
            const bool is_chosen = is_same(here[0], a) && is_same(here[1], b);
            middle.reaches = here;
            if (is_chosen) return middle;
        }
        return bisect(part, centre);
    }

    // Where one site becomes nearer than the other on the normal of a chord; none within a length.
    [[nodiscard]] std::optional<Middle> bisect(const Chord& part, const Vec2& centre) const {
        const Vec2 along = part.to - part.from;
        const Vec2 normal(-along.y(), along.x());
        const auto gap = [&](const std::array<Reach, 2>& r) { return r[0].distance - r[1].distance; };
        double low = -1, high = 1;  // Lengths of the chord, the left site is nearer at `high`.
        if (!(gap(reaches_at(centre + normal)) < 0 && gap(reaches_at(centre - normal)) > 0)) {
            return {};
        }
        Middle middle;
        for (int i = 0; i < most_halvings; ++i) {
            const double at = (low + high) / 2;
            middle.point = centre + at * normal;
            middle.reaches = reaches_at(middle.point);
            (gap(middle.reaches) > 0 ? low : high) = at;
        }
        return middle;
    }

    // Whether the path to `end` by the same last corner is the shortest there, too.
    [[nodiscard]] bool reaches_end(std::size_t site, const Reach& at_middle,
                                   const Vec2& end) const {
        const double straight =
            at_middle.distance - at_middle.last_piece + (end - at_middle.from).norm();
        const double least = least_reach(relays_[site], end).distance;
        return std::abs(straight - least) <= slack(least);
    }

    [[nodiscard]] bool is_one_conic(const Chord& part, const Middle& middle) const {
        const Vec2& m = middle.point;
        const double h = std::max((part.from - m).norm(), (part.to - m).norm());
        for (const std::size_t site : {0, 1}) {
            const Reach& best = middle.reaches[site];
            if (!reaches_end(site, best, part.from) || !reaches_end(site, best, part.to)) {
                return false;
            }
            const double bend = best.last_piece > 0 ? h * h / (2 * best.last_piece) : infinity;
            const Vec2 along = gradient(m, best);
            for (const PlanarRelay& relay : relays_[site]) {
                const Reach other = reach(relay, m);
                if (is_same(other, best)) continue;
                const double turn = (gradient(m, other) - along).norm();
                if (!(other.distance - best.distance - turn * h - bend >= -slack(best.distance))) {
                    return false;
                }
            }
        }
        return true;
    }

    void halve(const Chord& part, int depth) {
        const std::optional<Middle> middle = find_middle(part);
        const bool is_point = (part.to - part.from).norm() <= equal_reaches * size_;
        if (depth > 0 && (is_point || depth == most_halvings)) {
            // Its neighbours' conics meet here.
            if (!pieces_.empty()) pieces_.back().end = part.to;
            if (!pieces_.empty() || !middle) return;
        }
        if (!middle) {
            add({part.to, ArcKind::Chord, {}});
        } else if (is_point || depth == most_halvings || is_one_conic(part, *middle)) {
            const Conic conic = middle->conic();
            add({part.to, conic.is_line() ? ArcKind::Line : ArcKind::Hyperbola, conic});
        } else {
            halve({part.from, middle->point}, depth + 1);
            halve({middle->point, part.to}, depth + 1);
        }
    }

    void add(const Piece& piece) {
        if (!pieces_.empty()) {
            Piece& last = pieces_.back();
            const Conic &a = last.conic, &b = piece.conic;
            const double equal = slack(a.weight[0] + (piece.end - a.focus[0]).norm());
            const auto is_equal = [&](std::size_t k) {
                return (a.focus[k] - b.focus[k]).norm() <= equal &&
                       std::abs(a.weight[k] - b.weight[k]) <= equal;
            };
            if (last.kind == piece.kind && is_equal(0) && is_equal(1)) {
                last.end = piece.end;
                return;
            }
        }
        pieces_.push_back(piece);
    }

    const std::array<Relays, 2>& relays_;
    double size_;
    std::vector<Piece> pieces_;
};

// Appends points between the ends of a piece, such that it strays from the polyline by less than
// both tolerances.
void draw_conic(const Conic& conic, const Chord& chord, const ArcDrawing& drawing, int depth,
                std::vector<Vec2>& points) {
    const Vec2 along = chord.to - chord.from;
    const double length = along.norm();
    if (!(length > 0) || depth == most_doublings) return;
    const Vec2 top = conic.opposite(chord.from, chord.to, 0.5);
    const double height = std::abs(cross(along, top - chord.from)) / length;
    // The height over the chord is concave, so that it is the largest at most so many times this.
    const double at = along.dot(top - chord.from) / (length * length);
    const double most = height / std::min(at, 1 - at);
    if (!(at > 0 && at < 1) || most <= std::min(drawing.tolerance, drawing.chord_tolerance * length)) return;
    draw_conic(conic, {chord.from, top}, drawing, depth + 1, points);
    points.push_back(top);
    draw_conic(conic, {top, chord.to}, drawing, depth + 1, points);
}

}  // namespace

void shape_arc(double size, const std::array<Relays, 2>& relays, const Chord& ends,
               const ArcDrawing& drawing, Index arc, Arcs& out) {
    const Index first = size_of(out.points);
    Vec2 from = ends.from;
    const std::vector<ArcShaper::Piece> pieces = ArcShaper(relays, size).run(ends);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const auto& [to, kind, conic] = pieces[i];
        if (kind == ArcKind::Hyperbola) {
            // With errors in the distances the ends lie beside the conic.
            const Chord on_it{conic.moved_onto(from), conic.moved_onto(to)};
            draw_conic(conic, on_it, drawing, 0, out.points);
        }
        if (i + 1 < pieces.size()) out.points.push_back(to);
        const Index end = size_of(out.points) - first - (i + 1 < pieces.size() ? 1 : 0);
        out.shapes.push_back({arc, end, kind, conic});
        from = to;
    }
    for (Index i = first; i < out.points.size(); ++i) {
        out.point_distance.push_back(least_reach(relays[0], out.points[i]).distance);
    }
    out.arcs[arc].first_point = first;
    out.arcs[arc].num_points = size_of(out.points) - first;
}

}  // namespace agvd
