#include "agvd/propagation/propagate.h"

#include <memory>
#include <optional>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/option_checks.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/steiner/steiner_engine.h"
#include "agvd/propagation/vertex_engine.h"
#include "agvd/propagation/window/window_engine.h"

namespace agvd {

namespace {

// \param bounds  a function that gives the DistanceBounds; only the window engine calls it.
template <typename Bounds>
Propagation carry(const Surface& surface, std::shared_ptr<const Corners> corners,
                  const Bounds& bounds, std::span<const SurfacePoint> sites,
                  const PropagationOptions& options) {
    poll(options.progress, 0);
    if (options.engine == Engine::Vertex) {
        return propagate_vertices(surface, *corners, sites, options);
    }
    DistanceBounds known = bounds();
    return propagate_windows(surface, std::move(corners), std::move(known), sites, options);
}

DistanceBounds find_bounds(const Surface& surface, const SurfaceLayout& layout,
                           std::span<const SurfacePoint> sites, const PropagationOptions& options) {
    return distance_bounds(surface, layout, sites, options.num_threads,
                           within(options.progress, 0, 0));
}

// Propagates the distinct sites only. A site that lies on an earlier one owns nothing, but its
// windows would run as far as those of the earlier one.
template <typename Run>
Propagation propagate_distinct(const Surface& surface, std::span<const SurfacePoint> sites,
                               const PropagationOptions& options, const Run& run) {
    check_options(surface, options);
    check_sites(surface, sites);
    const std::vector<Index> distinct = distinct_points(surface, sites);
    if (distinct.size() == sites.size()) return run(sites);
    Propagation result = run(points_of(sites, distinct));
    const auto rename = [&](SiteId& site) {
        if (site.is_valid()) site = SiteId(distinct[site.value()]);
    };
    for (SiteId& site : result.vertex_site) rename(site);
    for (Relay& relay : result.relays) rename(relay.site);
    return result;
}

}  // namespace

Propagation propagate(const Surface& surface, std::span<const SurfacePoint> sites,
                      const PropagationOptions& options) {
    const auto run = [&](std::span<const SurfacePoint> distinct) {
        if (options.engine == Engine::Steiner) return propagate_steiner(surface, distinct, options);
        if (options.engine == Engine::Window) return propagate_windows(surface, distinct, options);
        poll(options.progress, 0);
        const Corners corners(surface, options.num_threads, within(options.progress, 0, 0));
        return propagate_vertices(surface, corners, distinct, options);
    };
    return propagate_distinct(surface, sites, options, run);
}

Propagation propagate(const Surface& surface, const SurfaceLayout& layout,
                      std::span<const SurfacePoint> sites, const PropagationOptions& options) {
    const auto run = [&](std::span<const SurfacePoint> distinct) {
        if (options.engine == Engine::Steiner) return propagate_steiner(surface, distinct, options);
        const auto bounds = [&] { return find_bounds(surface, layout, distinct, options); };
        return carry(surface, layout.shared_corners(), bounds, distinct, options);
    };
    return propagate_distinct(surface, sites, options, run);
}

Propagation propagate(const Surface& surface, SurfaceLayout&& layout,
                      std::span<const SurfacePoint> sites, const PropagationOptions& options) {
    std::optional<SurfaceLayout> owned(std::move(layout));
    const auto run = [&](std::span<const SurfacePoint> distinct) {
        if (options.engine == Engine::Steiner) return propagate_steiner(surface, distinct, options);
        const auto bounds = [&] {
            DistanceBounds found = find_bounds(surface, *owned, distinct, options);
            owned.reset();
            return found;
        };
        return carry(surface, owned->shared_corners(), bounds, distinct, options);
    };
    return propagate_distinct(surface, sites, options, run);
}

}  // namespace agvd
