// The share of noisy candidates sets how strict pruning is: little on parts, much on scans. Lengths
// are in spacings unless stated.
#include "remesh/curves/find_creases.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/curves/crease_chains.h"
#include "remesh/curves/walk.h"

namespace remesh {
namespace {

// Faces lower than this have no reliable normal: rounding to float moves vertices by some 3e-6
// spacings at 2000 sites. With 3e-3 fillets depended on the triangles.
constexpr double narrow = 1e-3;
// How far around a crease the surface is examined.
constexpr double reach = 0.5;
// An edge is noise if surrounding_turn() is above this share of its angle. The median over all
// edges above 40 degrees, 2000 sites, is 0 to .13 on seven parts and .69 to 1.5 on eight scans.
constexpr double noise_contrast = 0.5;
// The finest scale, in mean lengths of the noisy edges.
constexpr double noise_edges = 4;
// Share of the crease angle. Below it an edge has no weight, and no crease continues along it.
constexpr double weak_share = 0.625;
constexpr double most_gap = 1;
constexpr double least_spur = 1;
constexpr double least_island = 3;

// The least values of a network that stays, without noise and with prevailing noise.
struct NetworkRule {
    double least_merit;
    double short_chain;
    double least_density;  // Merit per length.
};
constexpr NetworkRule on_parts = {1, 1, 0.05};
constexpr NetworkRule on_scans = {2.5, 3, 0.4};

void check(const CreaseOptions& options) {
    if (!(options.angle > 0 && options.angle < 180)) {
        throw InvalidOption("angle is " + std::to_string(options.angle) +
                            "; use degrees above 0 and below 180");
    }
    check_num_threads(options.num_threads);
    if (!(options.spacing > 0 && std::isfinite(options.spacing))) {
        throw InvalidOption("spacing is " + std::to_string(options.spacing) +
                            "; use a finite number above 0");
    }
}

// The weight of an edge: 0 if weak, 1 at a right angle; less where the surface around it turns as
// much as the edge itself.
double weight_of(double angle, double surrounding, double weak) {
    const double full = std::max(std::numbers::pi / 2, weak / weak_share);
    const double sharpness = std::clamp((angle - weak) / (full - weak), 0., 1.);
    const double noisiness = surrounding / (noise_contrast * angle);
    return sharpness / (1 + noisiness * noisiness);
}

struct Noise {
    double share = 0;        // Of the length of the edges above the angle, 0 to 1.
    double edge_length = 0;  // Mean.
};

// An edge is noisy if the surface around it turns as much. Under strong noise most edges are above
// the angle and no others are left around them; then most chains are short.
Noise find_noise(const detail::CreaseSet& set, const std::vector<double>& angles,
                 const std::vector<double>& surrounding, double shortest, Poller& poller) {
    const std::vector<double>& length = set.surface().length;
    double all = 0, noise = 0, in_short_chains = 0;
    Index num_noisy = 0;
    for (const detail::CreaseChain& chain : detail::chains_of(set, poller)) {
        all += chain.length;
        if (chain.length < shortest) in_short_chains += chain.length;
        for (const Index e : chain.edges) {
            if (surrounding[e] <= noise_contrast * angles[e]) continue;
            noise += length[e];
            ++num_noisy;
        }
    }
    if (all == 0) return {};
    // With few sites, up to a third is in short chains even on parts.
    return {std::max(noise / all, 2 * in_short_chains / all - 1),
            num_noisy > 0 ? noise / num_noisy : 0};
}

// The rules at a spacing.
detail::PruningRules pruning_rules(double spacing, const Noise& noise) {
    const double strictness = std::min(1., 2 * noise.share);
    const double scale = std::max(spacing, strictness * noise_edges * noise.edge_length);
    const auto between = [&](double NetworkRule::*value) {
        return on_parts.*value + strictness * (on_scans.*value - on_parts.*value);
    };
    return {.least_spur = least_spur * scale,
            .least_island = least_island * scale,
            .least_network = between(&NetworkRule::least_merit) * scale,
            .short_chain = between(&NetworkRule::short_chain) * scale,
            .least_density = between(&NetworkRule::least_density)};
}

// The surface beside an edge is straight as long as the middle of the way is nearer to its chord
// than this share of the distance. A round one, meshed finely, then loses a quarter of that.
constexpr double most_bend = 1.0 / 16;
// This share of the distance counts as lost: half an angle is more than its sine.
constexpr double least_lost = 0.9;
constexpr double shortest_leg = 0.1;  // In heights of the lower face.

// The end of the way from the middle of an edge over the face of a half-edge and on, at most so
// long, as far as the surface is straight.
Vec3 straight_end(const Surface& surface, Index h, double length, double bend) {
    const auto& p = surface.mesh.positions;
    const SurfacePoint from = point_on(h, 0.5);
    const Vec3 axis = (p[surface.head(h)] - p[surface.tail(h)]).normalized();
    const Vec3 up = p[surface.tail(Surface::previous(h))] - p[surface.tail(h)];
    const Vec3 way = length * (up - axis.dot(up) * axis).normalized();
    const auto at = [&](double part) {
        return position(surface.mesh.view(), detail::walk_straight(surface, from, part * way).end);
    };
    const Vec3 start = position(surface.mesh.view(), from);
    const auto is_straight = [&](double part) {
        return distance_to_segment(at(part / 2), start, at(part)) <= bend;
    };
    double straight = 0, bent = 1.0 / 32;
    for (; straight < 1 && is_straight(bent); bent *= 2) straight = bent;
    for (int i = 0; i < 3 && straight > 0 && straight < 1; ++i) {
        const double middle = (straight + bent) / 2;
        (is_straight(middle) ? straight : bent) = middle;
    }
    return at(straight);
}

// Prunes the edges above the angle and adds the weak edges that continue them.
void apply_scale(detail::CreaseSet& set, const std::vector<double>& angles, double angle,
                 double spacing, Poller& poller) {
    const double weak = weak_share * angle;
    std::vector<double> weights = detail::surrounding_turn(set, angles, reach * spacing, poller);
    const Noise noise = find_noise(set, angles, weights, 2 * spacing, poller);
    Ticker ticker(poller);
    for (Index e = set.next(0); e < weights.size(); e = set.next(e + 1)) {
        ticker.tick();
        weights[e] = weight_of(angles[e], weights[e], weak);
    }
    const detail::CarryRules carry{.least_angle = weak, .most_gap = most_gap * spacing};
    detail::close_gaps(set, angles, carry, poller);
    detail::prune(set, weights, pruning_rules(spacing, noise), poller);
    detail::extend_ends(set, angles, carry, poller);
}

}  // namespace

std::vector<std::uint8_t> find_creases(const Surface& surface, const CreaseOptions& options) {
    check(options);
    Poller poller(options.progress);
    Ticker ticker(poller);
    const double angle = options.angle * degree;
    const std::vector<double> angles =
        detail::edge_angles(surface, narrow * options.spacing, options.num_threads, poller);
    detail::CreaseSet set(surface);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        ticker.tick();
        if (angles[e] > angle) set.add(e);
    }
    if (options.is_automatic) apply_scale(set, angles, angle, options.spacing, poller);
    return set.take_flags();
}

std::vector<std::uint8_t> find_hinges(const Surface& surface, double spacing, double distance,
                                      int num_threads, const Progress& progress) {
    Poller poller(progress);
    const std::vector<double> angles =
        detail::edge_angles(surface, narrow * spacing, num_threads, poller);
    const double longest = box_of(surface.mesh.view(), num_threads).longest_side();
    const double bend = most_bend * distance;
    std::vector<std::uint8_t> is_hinge(surface.num_edges(), 0);
    const auto look_at = [&](Index e) {
        if (!(angles[e] > 0 && 2 * distance <= longest * angles[e])) return;
        const Index h = surface.edge_half[e], twin = surface.twin[h];
        // It loses the distance at least. Rounding keeps the ends of shorter legs off the edge.
        const double leg =
            std::max(2 * distance / angles[e],
                     shortest_leg * std::min(surface.apex[h].y(), surface.apex[twin].y()));
        const Vec3 a = straight_end(surface, h, leg, bend);
        const Vec3 b = straight_end(surface, twin, leg, bend);
        const Vec3 middle = position(surface.mesh.view(), point_on(h, 0.5));
        is_hinge[e] = distance_to_segment(middle, a, b) > least_lost * distance;
    };
    parallel_each(surface.num_edges(), 256, num_threads, look_at, poller);
    return is_hinge;
}

const char* junctions_name(Junctions junctions) {
    return junctions == Junctions::Keep ? "keep" : "apart";
}

}  // namespace remesh
