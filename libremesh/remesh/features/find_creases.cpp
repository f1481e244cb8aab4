#include "remesh/features/find_creases.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agvd/core/error.h"
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
constexpr double least_spur = 1, least_island = 3, least_network = 1.5, short_chain = 1;

constexpr double most_short = 0.5;  // Share.
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
    const double sharpness = std::clamp((angle - weak) / (std::numbers::pi / 2 - weak), 0., 1.);
    return sharpness / (1 + (beside / angle) * (beside / angle));
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
    std::vector<double> weights = detail::turn_beside(set, angles, reach * h, poller);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        ticker.tick();
        if (set.has(e)) weights[e] = worth(angles[e], weights[e], weak_share * strong);
    }
    detail::prune(set, weights,
                  {.least_spur = least_spur * h,
                   .least_island = least_island * h,
                   .least_network = least_network * h,
                   .short_chain = short_chain * h,
                   .most_short = most_short},
                  poller);
    return set.take_flags();
}

}  // namespace remesh
