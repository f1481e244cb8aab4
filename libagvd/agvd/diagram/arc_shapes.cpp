// An arc is followed from conic to conic. One ends where paths by its last corner do not see the
// arc any more, at a ray from that corner; the next begins with the paths that do. Where another
// path is nearer at the end, it is so from a ridge on, and the part is halved until, on each half,
// one relay of either site is proved to be the nearest.
//
// Notation of that proof: m is the bisector's point opposite to the middle of a part, whose ends
// are at most h from m; f and g are the distance through the nearest relay and its gradient, f' and
// g' those of another relay, rho is the length of the path's last piece. Distances through a relay
// are convex, and |x - focus| <= rho + u . (x - m) + |x - m|^2 / (2 rho). So on the part
//   f' - f >= f'(m) - f(m) - |g' - g| h - h^2 / (2 rho).
#include "agvd/diagram/arc_shapes.h"

#include <cmath>

namespace agvd {
namespace {

// Distances that differ by less are equal: a share of them and of the triangle's size.
constexpr double equal_reaches = 2e-13;
// A share of it: so near to a ray the paths beyond are looked for.
constexpr double beside_ray = 1e-9;
constexpr int most_halvings = 48;
constexpr int most_ridge_steps = 12;
constexpr int most_choices = 6;     // Of the relays at the middle of one part.
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
        follow(ends);
        return std::move(pieces_);
    }

private:
    // What paths through a relay have in common on one side of a ray, or between two.
    struct Sight {
        Vec2 focus;
        double weight;
        std::array<Vec2, 2> rays;  // Directions from the focus in which it ends.
        std::size_t num_rays;

        [[nodiscard]] double distance(const Vec2& p) const {
            return weight + root(p.x() - focus.x(), p.y() - focus.y());
        }
    };

    // The nearest at a point; of tied ones a straight path before bent ones.
    [[nodiscard]] Sight choose(std::size_t site, const Vec2& p) const {
        Sight best{p, infinity, {p, p}, 0};
        double least = infinity;
        const auto offer = [&](const Vec2& focus, double weight, double handicap, const Vec2& ray,
                               const Vec2& other_ray, std::size_t num_rays) {
            const double distance = handicap + weight + root(p.x() - focus.x(), p.y() - focus.y());
            if (!(distance < least)) return;
            least = distance;
            best = {focus, weight, {ray, other_ray}, num_rays};
        };
        for (const PlanarRelay& relay : relays_[site]) {
            const Vec2 to_begin = relay.begin - relay.image, to_end = relay.end - relay.image;
            const Vec2 chord = p - relay.image;
            if (relay.sees_all) {
                offer(relay.image, relay.weight, 0, to_begin, to_end, 0);
            } else if (cross(to_begin, chord) > 0) {
                offer(relay.begin, relay.at_begin, slack(relay.at_begin), to_begin, to_end, 1);
            } else if (cross(to_end, chord) < 0) {
                offer(relay.end, relay.at_end, slack(relay.at_end), to_end, to_begin, 1);
            } else {
                offer(relay.image, relay.weight, 0, to_begin, to_end, 2);
            }
        }
        return best;
    }

    using Sights = std::array<Sight, 2>;
    [[nodiscard]] Sights choose(const Vec2& p) const { return {choose(0, p), choose(1, p)}; }

    // Where one conic ends, and what goes on there.
    struct Step {
        Vec2 end;
        Vec2 along;  // Of the arc there; unit length.
        Sights next;
        bool is_last;
    };

    void set_end(const Conic& conic, const Vec2& from, const Vec2& end, Step& step) const {
        const Vec2 across = conic.gradient(end);
        step.end = end;
        step.along = Vec2(-across.y(), across.x());
        if (step.along.dot(end - from) < 0) step.along = -step.along;
        step.along.normalize();
        const double sign = step.is_last ? -1 : 1;
        step.next = choose(end + sign * beside_ray * size_ * step.along);
    }

    // Calls visit(point) for the points that are as far from the conic's sites as through a relay.
    // Conics with a focus in common meet where their polar equations about it do, which is linear
    // in the direction u: u . (N1 c2 - N2 c1) = N1 D2 - N2 D1, with N = |c|^2 - D^2.
    template <typename Visit>
    static void for_each_meeting(const Conic& conic, std::size_t k, const PlanarRelay& relay,
                                 const Visit& visit) {
        const Vec2 c1 = conic.focus[1 - k] - conic.focus[k], c2 = relay.image - conic.focus[k];
        const double d1 = conic.weight[1 - k] - conic.weight[k],
                     d2 = relay.weight - conic.weight[k];
        const double n1 = c1.squaredNorm() - d1 * d1, n2 = c2.squaredNorm() - d2 * d2;
        const Vec2 normal = n1 * c2 - n2 * c1;
        const double norm_sq = normal.squaredNorm(), height = n1 * d2 - n2 * d1;
        const double rest = norm_sq - height * height;
        if (!(rest >= 0) || !(norm_sq > 0)) return;
        const double half = std::sqrt(rest);
        const Vec2 across(-normal.y(), normal.x());
        for (const double sign : {-1.0, 1.0}) {
            visit(conic.on_ray(k, (height * normal + sign * half * across) / norm_sq));
        }
    }

    // Whether a chord lies beside all that is seen through a relay.
    static bool is_hidden(const PlanarRelay& relay, const Vec2& from, const Vec2& to) {
        if (relay.sees_all) return false;
        const Vec2 to_begin = relay.begin - relay.image, to_end = relay.end - relay.image;
        const Vec2 first = from - relay.image, last = to - relay.image;
        return (cross(to_begin, first) > 0 && cross(to_begin, last) > 0) ||
               (cross(to_end, first) < 0 && cross(to_end, last) < 0);
    }

    // Where paths straight through another relay become the nearest before `end`.
    [[nodiscard]] std::optional<Vec2> find_meeting(const Conic& conic, const Vec2& from,
                                                   const Vec2& along, const Vec2& end) const {
        std::optional<Vec2> found;
        const double length = (end - from).norm();
        double nearest = length * length;
        for (std::size_t k = 0; k < 2; ++k) {
            const Vec2& focus = conic.focus[k];
            const double at_from = conic.weight[k] + (from - focus).norm();
            const double at_end = conic.weight[k] + (end - focus).norm();
            for (const PlanarRelay& relay : relays_[k]) {
                if (is_hidden(relay, from, end)) continue;
                // Gaps change by at most 2 a unit.
                const double gap = relay.weight + (from - relay.image).norm() - at_from +
                                   relay.weight + (end - relay.image).norm() - at_end;
                if (gap > 2 * length ||
                    (relay.image - focus).squaredNorm() <= slack(at_from) * slack(at_from)) {
                    continue;
                }
                for_each_meeting(conic, k, relay, [&](const Vec2& z) {
                    const double distance_sq = (z - from).squaredNorm();
                    if (!(distance_sq < nearest) || !((z - from).dot(along) > beside_ray * size_)) {
                        return;
                    }
                    if (!relay.sees_all && (cross(relay.begin - relay.image, z - relay.image) > 0 ||
                                            cross(relay.end - relay.image, z - relay.image) < 0)) {
                        return;
                    }
                    const double through = relay.weight + (z - relay.image).norm();
                    const double here = conic.weight[k] + (z - focus).norm();
                    if (!(std::abs(through - here) <= beside_ray * (size_ + here))) return;
                    found = z;
                    nearest = distance_sq;
                });
            }
        }
        return found;
    }

    // Where the conic meets the nearest ray ahead or another path's, or the arc's end.
    [[nodiscard]] Step find_end(const Conic& conic, const Sights& sights, const Vec2& from,
                                const Vec2& along, const Vec2& to) const {
        Step step{to, along, sights, true};
        Vec2 end = to;
        double nearest = (to - from).squaredNorm();
        for (std::size_t site = 0; site < 2; ++site) {
            for (std::size_t k = 0; k < sights[site].num_rays; ++k) {
                const Vec2 z = conic.on_ray(site, sights[site].rays[k]);
                const double distance = (z - from).squaredNorm();
                if (!(distance < nearest) || !((z - from).dot(along) > beside_ray * size_))
                    continue;
                end = z;
                nearest = distance;
                step.is_last = false;
            }
        }
        if (const auto meeting = find_meeting(conic, from, along, end)) {
            end = *meeting;
            step.is_last = false;
        }
        set_end(conic, from, end, step);
        return step;
    }

    // Where the conic meets the one of its site `k` and another path to that: Newton on both gaps.
    [[nodiscard]] std::optional<Vec2> find_ridge(const Conic& conic, std::size_t k,
                                                 const Sight& other, const Vec2& from,
                                                 const Vec2& to) const {
        const Conic ridge{{conic.focus[k], other.focus}, {conic.weight[k], other.weight}};
        const double before = ridge.gap(from), behind = ridge.gap(to);
        if (!(before < 0 && behind > 0)) return {};
        const double share = std::clamp(before / (before - behind), 0.0, 1.0);
        Vec2 p = (1 - share) * from + share * to;
        for (int i = 0; i < most_ridge_steps; ++i) {
            const Vec2 gaps(conic.gap(p), ridge.gap(p));
            const Vec2 first = conic.gradient(p), second = ridge.gradient(p);
            const double determinant = cross(first, second);
            const Vec2 step = Vec2(second.y() * gaps.x() - first.y() * gaps.y(),
                                   first.x() * gaps.y() - second.x() * gaps.x()) /
                              determinant;
            if (!std::isfinite(step.x() + step.y())) return {};
            p -= step;
            if (step.norm() <= equal_reaches * size_) break;
        }
        const double passed = (p - from).dot(to - from) / (to - from).squaredNorm();
        if (!(passed > -beside_ray && passed < 1 + beside_ray)) return {};
        if (!(std::abs(conic.gap(p)) + std::abs(ridge.gap(p)) <= slack(other.distance(p)))) {
            return {};
        }
        return p;
    }

    // The site that another path reaches sooner at a conic's end; none if its paths are the
    // nearest.
    [[nodiscard]] std::optional<std::size_t> overtaken(const Conic& conic, const Step& step) const {
        for (std::size_t k = 0; k < 2; ++k) {
            const double here = conic.weight[k] + (step.end - conic.focus[k]).norm();
            if (!(here <= step.next[k].distance(step.end) + 2 * slack(here))) return k;
        }
        return {};
    }

    // Ends a conic where another path becomes the nearest, if one does before its end. Where that
    // path comes into sight only later, another one did before it: the part is halved.
    void stop_at_ridge(const Conic& conic, const Vec2& from, Step& step) const {
        std::optional<std::size_t> k = overtaken(conic, step);
        if (!k) return;
        step.is_last = false;
        Vec2 before = from;
        const double least = equal_reaches * size_;
        for (int i = 0; i < most_halvings && (step.end - before).norm() > least; ++i) {
            const Sight other = step.next[*k];
            if (const auto ridge = find_ridge(conic, *k, other, before, step.end)) {
                set_end(conic, from, *ridge, step);
                const std::optional<std::size_t> then = overtaken(conic, step);
                // Beyond a flat ridge rounding would not tell the two apart.
                if (!then) step.next[*k] = other;
                if (!then) return;
                k = then;
                continue;
            }
            Step middle = step;
            set_end(conic, from, conic.opposite(before, step.end, 0.5), middle);
            if (const auto there = overtaken(conic, middle)) {
                k = there;
                step = middle;
            } else {
                before = middle.end;
            }
        }
    }

    void follow(const Chord& ends) {
        Vec2 from = ends.from;
        Vec2 along = (ends.to - ends.from).normalized();
        Sights sights = choose(from + beside_ray * size_ * along);
        const std::size_t most_pieces = 2 * (relays_[0].size() + relays_[1].size()) + 8;
        for (std::size_t i = 0; i < most_pieces; ++i) {
            const Conic conic{{sights[0].focus, sights[1].focus},
                              {sights[0].weight, sights[1].weight}};
            if (!std::isfinite(conic.weight[0] + conic.weight[1])) break;
            Step step = find_end(conic, sights, from, along, ends.to);
            stop_at_ridge(conic, from, step);
            add({step.end, conic.is_line() ? ArcKind::Line : ArcKind::Hyperbola, conic});
            if (step.is_last) return;
            from = step.end;
            along = step.along;
            sights = step.next;
        }
        halve({from, ends.to}, 0);
    }

    [[nodiscard]] double slack(double distance) const { return equal_reaches * (size_ + distance); }
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
        const auto gap = [&](const std::array<Reach, 2>& r) {
            return r[0].distance - r[1].distance;
        };
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
        for (std::size_t site = 0; site < 2; ++site) {
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
        const bool is_end = is_point || depth == most_halvings || halvings_left_ == 0;
        if (depth > 0 && is_end) {
            // Its neighbours' conics meet here.
            if (!pieces_.empty()) pieces_.back().end = part.to;
            if (!pieces_.empty() || !middle) return;
        }
        if (!middle) {
            add({part.to, ArcKind::Chord, {}});
        } else if (is_end || is_one_conic(part, *middle)) {
            const Conic conic = middle->conic();
            add({part.to, conic.is_line() ? ArcKind::Line : ArcKind::Hyperbola, conic});
        } else {
            --halvings_left_;
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
    int halvings_left_ = 1000;
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
    const double rounding = equal_reaches * (conic.weight[0] + (top - conic.focus[0]).norm());
    if (!(at > 0 && at < 1) ||
        most <= std::max(rounding, std::min(drawing.tolerance, drawing.chord_tolerance * length))) {
        return;
    }
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
