// The bisector of two sites a and b has equal distances f_a = f_b, each the least over the site's
// relays. Its point opposite the middle m of a chord is m + s n with the chord's normal n: Newton
// on f_a - f_b along that normal.
#include "agvd/diagram/bisector.h"

#include <algorithm>
#include <cmath>

#include "agvd/diagram/straight_arc.h"

namespace agvd {
namespace {

// Relays chosen at one point of a bisector stand for their sites this far along (share of the
// chord).
constexpr double near_enough = 0.02;
constexpr int max_arc_depth = 4;  // At most 2^4 pieces an arc and face.

bool is_straight(Relays a, Relays b, const Chord& chord, double tolerance) {
    const Vec2 middle = (chord.from + chord.to) / 2;
    return is_nearly_straight(chord.to - chord.from, middle, least_reach(a, middle),
                              least_reach(b, middle), tolerance);
}

struct Sampling {
    const TriangleSites& triangle;
    Relays a, b;
    double tolerance;
    LocalDiagram& out;
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

}  // namespace

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
            if (std::abs(s - chosen_at) <= near_enough * length) {
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
                     const Chord& chord, double tolerance, LocalDiagram& out) {
    sample({triangle, relays_of_site(triangle, sites[0]), relays_of_site(triangle, sites[1]),
            tolerance, out},
           chord, 0);
}

double arc_undercut(const TriangleSites& triangle, const std::array<Index, 2>& sites,
                    const Chord& chord) {
    const auto point = project(triangle, relays_of_site(triangle, sites[0]),
                               relays_of_site(triangle, sites[1]), chord);
    return point ? undercut(triangle, point->position, point->distance, sites) : 0;
}

}  // namespace agvd
