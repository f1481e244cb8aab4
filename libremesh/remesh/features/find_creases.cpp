#include "remesh/features/find_creases.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agvd/core/error.h"
#include "remesh/features/carry_creases.h"
#include "remesh/features/edge_angles.h"
#include "remesh/features/prune_creases.h"
#include "remesh/features/turn_beside.h"

namespace remesh {
namespace {

using agvd::Index;

constexpr double degree = std::numbers::pi / 180;

// All in spacings. Faces lower than this have no direction of their own.
constexpr double thin = 1e-3;
// How far beside a crease the surface is looked at.
constexpr double reach = 0.5;
// Where the surface beside an edge turns more than this share of the edge's angle, it is noise.
// (The median over what is above 40 degrees is .00 to .13 on parts and .69 to 1.5 on scans.)
constexpr double noise_contrast = 0.5;
// In edges of the noise: no scale is finer.
constexpr double noise_edges = 4;

constexpr double most_gap = 1;
constexpr double least_spur = 1, least_island = 3, least_network = 2.5, short_chain = 3;

constexpr double most_short = 0.65;  // Share.
// Of the angle of a crease: what counts as nothing.
constexpr double weak_share = 0.625;

void check(const CreaseOptions& options) {
    if (!(options.angle > 0 && options.angle < 180)) {
        throw agvd::InvalidOption("the angle of creases must lie between 0 and 180 degrees");
    }
    if (!(options.spacing > 0 && std::isfinite(options.spacing))) {
        throw agvd::InvalidOption("the spacing of creases must be above 0");
    }
}

// What an edge is worth: 0 if weak, 1 at a right angle; less where the surface beside it turns as
// much as at the edge itself.
double worth(double angle, double beside, double weak) {
    const double full = std::max(std::numbers::pi / 2, weak / weak_share);
    const double sharpness = std::clamp((angle - weak) / (full - weak), 0., 1.);
    const double noisiness = beside / (noise_contrast * angle);
    return sharpness / (1 + noisiness * noisiness);
}

struct Noise {
    double share = 0;        // Of the length of the edges above the angle, 0 to 1.
    double edge_length = 0;  // Mean.
};

// Where the surface beside an edge turns as at the edge itself. Where noise is so strong that most
// edges are above the angle, nothing is left beside them; then most chains are short.
Noise find_noise(const detail::CreaseSet& set, const std::vector<double>& angles,
                 const std::vector<double>& beside, double shortest, agvd::Poller& poller) {
    const std::vector<double>& length = set.surface().length;
    double all = 0, noise = 0, in_short_chains = 0;
    Index num_noisy = 0;
    for (const detail::CreaseChain& chain : detail::chains_of(set, poller)) {
        all += chain.length;
        if (chain.length < shortest) in_short_chains += chain.length;
        for (const Index e : chain.edges) {
            if (beside[e] <= noise_contrast * angles[e]) continue;
            noise += length[e];
            ++num_noisy;
        }
    }
    if (all == 0) return {};
    // On parts up to a third is in short chains, with few sites.
    return {std::max(noise / all, 2 * in_short_chains / all - 1),
            num_noisy > 0 ? noise / num_noisy : 0};
}

}  // namespace

std::vector<std::uint8_t> find_creases(const agvd::Surface& surface, const CreaseOptions& options) {
    check(options);
    agvd::Poller poller(options.progress);
    agvd::Ticker ticker(poller);
    const double strong = options.angle * degree;
    const double h = options.spacing;
    const std::vector<double> angles =
        detail::edge_angles(surface, thin * h, options.num_threads, poller);
    detail::CreaseSet set(surface);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        ticker.tick();
        if (angles[e] > strong) set.add(e);
    }
    if (!options.is_automatic) return set.take_flags();
    const detail::CarryRules carry{.least_angle = weak_share * strong, .most_gap = most_gap * h};
    std::vector<double> weights = detail::turn_beside(set, angles, reach * h, poller);
    const Noise noise = find_noise(set, angles, weights, 2 * h, poller);
    const double strictness = std::min(1., 2 * noise.share);
    const double scale = std::max(h, strictness * noise_edges * noise.edge_length);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        ticker.tick();
        if (set.has(e)) weights[e] = worth(angles[e], weights[e], weak_share * strong);
    }
    detail::close_gaps(set, angles, carry, poller);
    detail::prune(set, weights,
                  {.least_spur = least_spur * scale,
                   .least_island = least_island * scale,
                   .least_network = std::lerp(1., least_network, strictness) * scale,
                   .short_chain = std::lerp(1., short_chain, strictness) * scale,
                   .most_short = most_short},
                  poller);
    detail::extend_ends(set, angles, carry, poller);
    return set.take_flags();
}

}  // namespace remesh
