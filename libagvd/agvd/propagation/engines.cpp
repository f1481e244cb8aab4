#include "agvd/propagation/engines.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/steiner/steiner_nodes.h"

namespace agvd {
namespace {

void check_steiner_options(const Surface& surface, const PropagationOptions& options) {
    if (options.steiner_points < 0 || options.steiner_points > max_steiner_points) {
        throw InvalidOption("the number of Steiner points per edge is " +
                            std::to_string(options.steiner_points) + "; use 0 to " +
                            std::to_string(max_steiner_points));
    }
    if (!(options.lambda > 0)) {
        throw InvalidOption("lambda is " + std::to_string(options.lambda) +
                            "; use a number above 0");
    }
    if (options.max_error && *options.max_error == 0) {
        throw InvalidOption(
            "the Steiner engine cannot be exact; use the window engine or an error above 0");
    }
    if (!NodeNumbers::suffice(surface, static_cast<Index>(options.steiner_points))) {
        throw InvalidOption(
            "this mesh with " + std::to_string(options.steiner_points) +
            " Steiner points per edge needs more than 2^32 nodes; use fewer Steiner points");
    }
    if (!options.relay_faces.empty() || options.max_distance < infinity) {
        throw InvalidOption(
            "the Steiner engine keeps relays in mixed faces only, and goes everywhere; use the "
            "window engine for relay_faces and max_distance");
    }
}

void check_options(const Surface& surface, const PropagationOptions& options) {
    if (options.max_error && !(*options.max_error >= 0 && *options.max_error < 1)) {
        throw InvalidOption("the maximal error is " + std::to_string(*options.max_error) +
                            "; use a number from 0 (exact) to below 1");
    }
    if (!(options.max_distance >= 0)) {
        throw InvalidOption("the maximal distance is " + std::to_string(options.max_distance) +
                            "; use a number of 0 or more");
    }
    const std::vector<Index>& faces = options.relay_faces;
    if (!std::is_sorted(faces.begin(), faces.end()) ||
        (!faces.empty() && faces.back() >= surface.num_faces())) {
        throw InvalidOption(
            "relay_faces are not ascending faces of the mesh; sort them, and use "
            "numbers below " +
            std::to_string(surface.num_faces()));
    }
    if (options.engine == Engine::Steiner) check_steiner_options(surface, options);
}

// Propagates the distinct sites only. A site that lies on an earlier one owns nothing, but its
// windows would run as far as those of the earlier one. `run_windows` is the window engine.
template <typename Run>
Propagation propagate_distinct(const Surface& surface, std::span<const SurfacePoint> sites,
                               const PropagationOptions& options, const Run& run_windows) {
    check_options(surface, options);
    check_sites(surface, sites);
    const auto run = [&](std::span<const SurfacePoint> distinct) {
        if (options.engine == Engine::Steiner) return propagate_steiner(surface, distinct, options);
        return run_windows(distinct);
    };
    const std::vector<Index> distinct = distinct_points(surface, sites);
    if (distinct.size() == sites.size()) return run(sites);
    Propagation result = run(take(sites, distinct));
    const auto rename = [&](SiteId& site) {
        if (site.is_valid()) site = SiteId(distinct[site.value()]);
    };
    for (SiteId& site : result.vertex_site) rename(site);
    for (Relay& relay : result.relays) rename(relay.site);
    return result;
}

}  // namespace

std::vector<Index> all_faces(const Surface& surface) {
    std::vector<Index> faces(surface.num_faces());
    std::iota(faces.begin(), faces.end(), Index{0});
    return faces;
}

std::optional<Index> mixed_index_of(const Propagation& propagation, Index face) {
    const auto& mixed = propagation.mixed_faces;
    const auto found = std::lower_bound(mixed.begin(), mixed.end(), face);
    if (found == mixed.end() || *found != face) return std::nullopt;
    return static_cast<Index>(found - mixed.begin());
}

const char* engine_name(Engine engine) { return engine == Engine::Steiner ? "steiner" : "window"; }

Propagation propagate(const Surface& surface, std::span<const SurfacePoint> sites,
                      const PropagationOptions& options) {
    return propagate_distinct(surface, sites, options, [&](std::span<const SurfacePoint> distinct) {
        SurfaceLayout layout(surface, options.num_threads, within(options.progress, 0, 0));
        return propagate_windows(surface, std::move(layout), distinct, options);
    });
}

Propagation propagate(const Surface& surface, SurfaceLayout layout,
                      std::span<const SurfacePoint> sites, const PropagationOptions& options) {
    return propagate_distinct(surface, sites, options, [&](std::span<const SurfacePoint> distinct) {
        return propagate_windows(surface, std::move(layout), distinct, options);
    });
}

}  // namespace agvd
