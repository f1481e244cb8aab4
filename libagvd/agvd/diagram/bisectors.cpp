// The point of a bisector opposite the middle of a chord is found by Newton on f_a - f_b along the
// normal, a Voronoi vertex by Newton on (f_a - f_b, f_b - f_c), where f is the distance from a
// site, through the relay that is nearest at the start; at a root relays are chosen again.
#include "agvd/diagram/bisectors.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace agvd {
namespace {

// Equalities are met up to this share of the triangle's longest side: below it lies rounding.
constexpr double convergence = 1e-11;
constexpr int max_newton_steps = 25;
constexpr int max_arc_depth = 4;  // At most 2^4 pieces an arc and face.
// A search that strays this far (share of the size) from its start does not come back.
constexpr double lost = 2;

// Height over the side from corner k to k + 1.
double signed_height(const TriangleSites& triangle, const Vec2& p, std::size_t k) {
    const Vec2& a = triangle.corners[k];
    const Vec2& b = triangle.corners[(k + 1) % 3];
    const double length = (b - a).norm();
    return length > 0 ? cross(b - a, p - a) / length : 0;
}

// How far a point lies outside; 0: inside.
double outside(const TriangleSites& triangle, const Vec2& p) {
    double least = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2& a = triangle.corners[k];
        if (cross(triangle.corners[(k + 1) % 3] - a, p - a) < 0) {
            least = std::min(least, signed_height(triangle, p, k));
        }
    }
    return -least;
}

// The point, moved towards the centroid until it is inside.
Vec2 moved_inside(const TriangleSites& triangle, const Vec2& p) {
    const auto& corners = triangle.corners;
    const Vec2 centroid = (corners[0] + corners[1] + corners[2]) / 3;
    double keep = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double at_p = signed_height(triangle, p, k);
        const double at_centroid = signed_height(triangle, centroid, k);
        if (at_p < 0 && at_centroid > 0) {
            keep = std::min(keep, at_centroid / (at_centroid - at_p));
        }
    }
    return centroid + keep * (p - centroid);
}

// Null without relays.
const PlanarRelay* nearest_relay(Relays relays, const Vec2& p) {
    const PlanarRelay* best = nullptr;
    double least = infinity;
    for (const PlanarRelay& relay : relays) {
        const double distance = reach(relay, p).distance;
        if (distance < least) {
            least = distance;
            best = &relay;
        }
    }
    return best;
}

// The gradient of a distance at p; 0 at the end of the last piece itself.
Vec2 gradient(const Vec2& p, const Reach& reach) {
    return reach.last_piece > 0 ? Vec2((p - reach.from) / reach.last_piece) : Vec2(0, 0);
}

// Whether the bisector of two sites clearly strays from a chord by less than the tolerance (share
// of the chord): by Kantorovich's theorem, for one Newton step across its middle.
// \param a, b  of the two sites at the middle.
bool is_nearly_straight(const Vec2& chord, const Vec2& middle, const Reach& a, const Reach& b,
                        double tolerance) {
    const double least = std::min(a.last_piece, b.last_piece);
    if (!(least > 0) || !std::isfinite(a.distance + b.distance)) return false;
    // Everything times the chord's length.
    const Vec2 turn = (middle - a.from) / a.last_piece - (middle - b.from) / b.last_piece;
    const double slope = std::abs(cross(chord, turn));
    const double gap = std::abs(a.distance - b.distance);
    const double squared_length = chord.squaredNorm();
    // The slope changes by at most 2 / (least - stray) a unit.
    return 2 * gap <= tolerance * slope && 8 * gap * squared_length <= least * slope * slope;
}

bool is_straight(Relays a, Relays b, const Chord& chord, double tolerance) {
    const Vec2 middle = (chord.from + chord.to) / 2;
    return is_nearly_straight(chord.to - chord.from, middle, least_reach(a, middle),
                              least_reach(b, middle), tolerance);
}

struct Sampling {
    const TriangleSites& triangle;
    Relays a, b;
    double tolerance;
    Arcs& out;
};

void sample(const Sampling& sampling, const Chord& chord, int depth) {
    const auto& [triangle, a, b, tolerance, out] = sampling;
    if (depth == max_arc_depth || is_straight(a, b, chord, tolerance)) return;
    const auto point = project(triangle, a, b, chord);
    if (!point) return;
    const Vec2& p = point->position;
    if ((p - (chord.from + chord.to) / 2).norm() <= tolerance * (chord.to - chord.from).norm()) {
        return;
    }
    sample(sampling, {chord.from, p}, depth + 1);
    out.points.push_back(p);
    out.point_distance.push_back(point->distance);
    sample(sampling, {p, chord.to}, depth + 1);
}

// Distance of p through a relay, all in the frame of its half-edge; as reach() in any frame.
Reach reach_in_frame(const Relay& r, const Vec2& p) {
    if (is_parallel(r)) return reach_parallel(to_planar_parallel(r, {}), p);
    const double dx = p.x() - r.x;
    const double dy = p.y() - r.y;
    if (r.y < 0) {
        const double side = r.y * dx;
        const double left = (r.begin - r.x) * dy + side;
        const double right = (r.end - r.x) * dy + side;
        if (left > 0 || right < 0) {
            const double bend = left > 0 ? r.begin : r.end;
            const double rest = root(p.x() - bend, p.y());
            return {r.weight + root(bend - r.x, r.y) + rest, {bend, 0}, rest};
        }
    }
    const double length = root(dx, dy);
    return {r.weight + length, {r.x, r.y}, length};
}

// One of two sites, as the relays know it.
struct Known {
    Index site;
    bool agrees_at_from = false;
    bool agrees_at_to = false;
    Reach at_middle{infinity, {0, 0}, 0};
    std::size_t frame = 0;  // Of at_middle.
};

struct EqualPoint {
    Vec2 position;
    double distance;
    // Of two such points, positive at that around which the sites lie counter-clockwise.
    double turn;
};

std::optional<EqualPoint> find_equal(double size, const std::array<Relays, 3>& sites,
                                     const Vec2& start) {
    Vec2 p = start;
    Vec2 chosen_at;
    std::array<const PlanarRelay*, 3> nearest;
    const auto choose = [&] {
        chosen_at = p;
        for (std::size_t k = 0; k < 3; ++k) nearest[k] = nearest_relay(sites[k], p);
        return nearest[0] != nullptr && nearest[1] != nullptr && nearest[2] != nullptr;
    };
    if (!choose()) return {};
    for (int i = 0; i < max_newton_steps; ++i) {
        const Reach a = reach(*nearest[0], p);
        const Reach b = reach(*nearest[1], p);
        const Reach c = reach(*nearest[2], p);
        const double distance = std::max({a.distance, b.distance, c.distance});
        if (!std::isfinite(distance)) return {};
        const Vec2 residual(a.distance - b.distance, b.distance - c.distance);
        const Vec2 at_b = gradient(p, b);
        const Vec2 first = gradient(p, a) - at_b;
        const Vec2 second = at_b - gradient(p, c);
        const double determinant = cross(first, second);
        if (std::max(std::abs(residual.x()), std::abs(residual.y())) <=
            convergence * (size + distance)) {
            if (p == chosen_at) return EqualPoint{p, distance, determinant};
            if (!choose()) return {};  // Others may be nearer here.
            continue;
        }
        if (!(std::abs(determinant) > convergence)) return {};
        Vec2 step(second.y() * residual.x() - first.y() * residual.y(),
                  first.x() * residual.y() - second.x() * residual.x());
        step /= determinant;
        const double norm = step.norm();
        if (norm > size / 2) step *= size / (2 * norm);
        p -= step;
        if ((p - start).squaredNorm() > lost * lost * size * size) return {};
    }
    return {};
}

}  // namespace

double longest_side(const std::array<Vec2, 3>& corners) {
    return std::sqrt(
        std::max({(corners[1] - corners[0]).squaredNorm(), (corners[2] - corners[1]).squaredNorm(),
                  (corners[0] - corners[2]).squaredNorm()}));
}

Relays relays_of_site(const TriangleSites& triangle, Index site) {
    for (const TriangleSites::Group& group : triangle.groups) {
        if (group.site == site) return group.relays;
    }
    return {};
}

double undercut(const TriangleSites& triangle, const Vec2& p, double distance,
                std::span<const Index> sites) {
    double least = distance;
    for (const TriangleSites::Group& group : triangle.groups) {
        if (std::find(sites.begin(), sites.end(), group.site) != sites.end()) continue;
        least = std::min(least, least_reach(group.relays, p).distance);
    }
    return distance - least;
}

std::optional<BisectorPoint> project(const TriangleSites& triangle, Relays a, Relays b,
                                     const Chord& chord) {
    const Vec2 along = chord.to - chord.from;
    const double length = along.norm();
    if (!(length > inside_tolerance * triangle.size)) return {};
    const Vec2 normal(-along.y() / length, along.x() / length);
    const Vec2 middle = (chord.from + chord.to) / 2;
    const PlanarRelay* on_a = nullptr;  // The relays that are nearest at `chosen_at`.
    const PlanarRelay* on_b = nullptr;
    double chosen_at = 0;
    double s = 0;
    for (int i = 0; i < max_newton_steps; ++i) {
        const Vec2 p = middle + s * normal;
        if (on_a == nullptr) {
            on_a = nearest_relay(a, p);
            on_b = nearest_relay(b, p);
            chosen_at = s;
            if (on_a == nullptr || on_b == nullptr) return {};
        }
        const Reach ra = reach(*on_a, p);
        const Reach rb = reach(*on_b, p);
        const double gap = ra.distance - rb.distance;
        const double distance = std::max(ra.distance, rb.distance);
        if (std::abs(gap) <= convergence * (triangle.size + distance)) {
            if (s == chosen_at) {
                if (!(outside(triangle, p) <= inside_tolerance * triangle.size)) return {};
                return BisectorPoint{p, distance};
            }
            on_a = nullptr;  // Others may be nearer here.
            continue;
        }
        const double slope = (gradient(p, ra) - gradient(p, rb)).dot(normal);
        if (!(std::abs(slope) > convergence)) return {};
        s = std::clamp(s - gap / slope, -length / 2, length / 2);
    }
    return {};
}

void sample_bisector(const TriangleSites& triangle, const std::array<Index, 2>& sites,
                     const Chord& chord, double tolerance, Arcs& out) {
    sample({triangle, relays_of_site(triangle, sites[0]), relays_of_site(triangle, sites[1]),
            tolerance, out},
           chord, 0);
}

double arc_undercut(const TriangleSites& triangle, const std::array<Index, 2>& sites,
                    const Chord& chord) {
    if (!((chord.to - chord.from).norm() > inside_tolerance * triangle.size)) return 0;
    const auto point = project(triangle, relays_of_site(triangle, sites[0]),
                               relays_of_site(triangle, sites[1]), chord);
    if (!point) return no_voronoi_vertex * triangle.size;
    return undercut(triangle, point->position, point->distance, sites);
}

bool joins_straight(std::span<const Relay> relays, const std::array<Vec2, 3>& corners,
                    const Breakpoint& from, const Breakpoint& to, double slack, double tolerance) {
    const Vec2 middle = (from.position + to.position) / 2;
    struct Frame {
        Vec2 along;
        Vec2 from, to, middle;
    };
    std::array<Frame, 3> frames;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2& tail = corners[k];
        const Vec2 edge = corners[k == 2 ? 0 : k + 1] - tail;
        const Vec2 along = edge / edge.norm();
        const auto moved = [&](const Vec2& p) {
            const Vec2 d = p - tail;
            return Vec2(along.dot(d), cross(along, d));
        };
        frames[k] = {along, moved(from.position), moved(to.position), moved(middle)};
    }
    Known known[] = {{from.site_after}, {to.site_after}};
    for (const Relay& relay : relays) {
        Known* const site = relay.site.value() == from.site_after ? &known[0]
                            : relay.site.value() == to.site_after ? &known[1]
                                                                  : nullptr;
        if (site == nullptr) continue;
        const std::size_t k = relay.half_edge % 3;
        const Frame& frame = frames[k];
        site->agrees_at_from = site->agrees_at_from ||
                               reach_in_frame(relay, frame.from).distance <= from.distance + slack;
        site->agrees_at_to =
            site->agrees_at_to || reach_in_frame(relay, frame.to).distance <= to.distance + slack;
        const Reach at_middle = reach_in_frame(relay, frame.middle);
        if (at_middle.distance < site->at_middle.distance) {
            site->at_middle = at_middle;
            site->frame = k;
        }
    }
    for (Known& site : known) {
        if (!site.agrees_at_from || !site.agrees_at_to) return false;
        const Vec2& along = frames[site.frame].along;
        const Vec2 image = site.at_middle.from;
        site.at_middle.from =
            corners[site.frame] + image.x() * along + image.y() * Vec2(-along.y(), along.x());
    }
    return is_nearly_straight(to.position - from.position, middle, known[0].at_middle,
                              known[1].at_middle, tolerance);
}

VertexCandidate find_voronoi_vertex(const TriangleSites& triangle,
                                    const std::array<IntervalStart, 3>& intervals, bool thorough) {
    const auto& [before, at, after] = intervals;
    const std::array<Index, 3> sites{before.site, at.site, after.site};
    const std::array<Relays, 3> relays{relays_of_site(triangle, sites[0]),
                                       relays_of_site(triangle, sites[1]),
                                       relays_of_site(triangle, sites[2])};
    const Vec2 centroid = (at.position + after.position + before.position) / 3;
    const Vec2 starts[] = {centroid, (at.position + after.position) / 2,
                           (after.position + before.position) / 2,
                           (before.position + at.position) / 2};
    for (const Vec2& start : std::span(starts).first(thorough ? 4 : 2)) {
        const auto found = find_equal(triangle.size, relays, start);
        if (found && !(found->turn > 0)) continue;  // The other one: from elsewhere.
        const double gap = found ? outside(triangle, found->position) : infinity;
        if (gap > inside_tolerance * triangle.size) {
            if (thorough) continue;
            break;
        }
        const Vec2& p = found->position;
        return {gap > 0 ? moved_inside(triangle, p) : p, found->distance,
                undercut(triangle, p, found->distance, sites)};
    }
    // Cells may meet at the very end of an interval, where distances have no derivative.
    const Vec2 positions[] = {at.position, after.position, before.position};
    const VertexCandidate at_end = least_unequal(triangle, positions, sites);
    if (at_end.violation <= inside_tolerance * triangle.size) return at_end;
    return {centroid, least_reach(relays[1], centroid).distance, no_voronoi_vertex * triangle.size};
}

VertexCandidate settled_vertex(const std::array<Relays, 3>& relays, const VertexCandidate& vertex) {
    constexpr int most_steps = 3;
    VertexCandidate best = vertex;
    double least = infinity;
    Vec2 p = vertex.position;
    for (int i = 0; i < most_steps; ++i) {
        const Reach a = least_reach(relays[0], p), b = least_reach(relays[1], p),
                    c = least_reach(relays[2], p);
        const Vec2 residual(a.distance - b.distance, b.distance - c.distance);
        if (!(residual.norm() < least)) break;
        least = residual.norm();
        best.position = p;
        best.distance = std::max({a.distance, b.distance, c.distance});
        const Vec2 first = gradient(p, a) - gradient(p, b),
                   second = gradient(p, b) - gradient(p, c);
        p -= Vec2(second.y() * residual.x() - first.y() * residual.y(),
                  first.x() * residual.y() - second.x() * residual.x()) /
             cross(first, second);
    }
    return best;
}

VertexCandidate least_unequal(const TriangleSites& triangle, std::span<const Vec2> positions,
                              const std::array<Index, 3>& sites) {
    assert(!positions.empty());
    VertexCandidate best{positions[0], 0, infinity};
    for (const Vec2& p : positions) {
        std::array<double, 3> distances;
        for (std::size_t k = 0; k < 3; ++k) {
            distances[k] = least_reach(relays_of_site(triangle, sites[k]), p).distance;
        }
        const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
        const double violation = *most - *least;
        if (violation < best.violation || (&p == positions.data())) {
            best = {p, *most, std::isfinite(*most) ? violation : infinity};
        }
    }
    return best;
}

}  // namespace agvd
