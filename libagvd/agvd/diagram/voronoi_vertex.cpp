// A Voronoi vertex p has equal distances f_a(p) = f_b(p) = f_c(p) from three sites, each the least
// over the site's relays. Newton on (f_a - f_b, f_b - f_c) finds it, with the relays that are the
// nearest at the start; where it converges they are chosen again, until they stay the same.
#include "agvd/diagram/voronoi_vertex.h"

#include <algorithm>
#include <cassert>
#include <optional>

namespace agvd {
namespace {

// A search that strays this far (share of the size) from its start does not come back.
constexpr double lost = 2;

struct EqualPoint {
    Vec2 position;
    double distance;
    // Two points may be equally far from three sites: positive at the one around which the sites
    // lie counter-clockwise.
    double turn;
};

// The nearest relays of three sites at a point.
struct Chosen {
    std::array<const PlanarRelay*, 3> relays;
    Vec2 at;

    [[nodiscard]] bool is_complete() const {
        return relays[0] != nullptr && relays[1] != nullptr && relays[2] != nullptr;
    }
};

Chosen choose(const std::array<Relays, 3>& sites, const Vec2& p) {
    return {{nearest_relay(sites[0], p), nearest_relay(sites[1], p), nearest_relay(sites[2], p)},
            p};
}

std::optional<EqualPoint> find_equal(double size, const std::array<Relays, 3>& sites,
                                     const Vec2& start) {
    Vec2 p = start;
    Chosen chosen = choose(sites, p);
    for (int i = 0; i < max_newton_steps; ++i) {
        if (!chosen.is_complete()) return {};
        const Reach a = reach(*chosen.relays[0], p);
        const Reach b = reach(*chosen.relays[1], p);
        const Reach c = reach(*chosen.relays[2], p);
        const double distance = std::max({a.distance, b.distance, c.distance});
        if (!std::isfinite(distance)) return {};
        const Vec2 residual(a.distance - b.distance, b.distance - c.distance);
        const Vec2 at_b = gradient(p, b);
        const Vec2 first = gradient(p, a) - at_b;
        const Vec2 second = at_b - gradient(p, c);
        const double determinant = cross(first, second);
        if (std::max(std::abs(residual.x()), std::abs(residual.y())) <=
            convergence * (size + distance)) {
            if (p == chosen.at) return EqualPoint{p, distance, determinant};
            chosen = choose(sites, p);  // Others may be nearer here.
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

VertexPlace find_voronoi_vertex(const TriangleSites& triangle,
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
    const Vec2 places[] = {at.position, after.position, before.position};
    const VertexPlace at_end = least_unequal(triangle, places, sites);
    if (at_end.violation <= inside_tolerance * triangle.size) return at_end;
    return {centroid, least_reach(relays[1], centroid).distance, no_voronoi_vertex * triangle.size};
}

VertexPlace least_unequal(const TriangleSites& triangle, std::span<const Vec2> places,
                          const std::array<Index, 3>& sites) {
    assert(!places.empty());
    VertexPlace best{places[0], 0, infinity};
    for (const Vec2& p : places) {
        std::array<double, 3> distances;
        for (std::size_t k = 0; k < 3; ++k) {
            distances[k] = least_reach(relays_of_site(triangle, sites[k]), p).distance;
        }
        const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
        const double violation = *most - *least;
        if (violation < best.violation || (&p == places.data())) {
            best = {p, *most, std::isfinite(*most) ? violation : infinity};
        }
    }
    return best;
}

}  // namespace agvd
