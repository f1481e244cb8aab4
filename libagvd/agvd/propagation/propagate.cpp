#include "agvd/propagation/propagate.h"

#include "agvd/mesh/distinct_points.h"
#include "agvd/propagation/option_checks.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/steiner_engine.h"
#include "agvd/propagation/vertex_engine.h"
#include "agvd/propagation/window_engine.h"

namespace agvd {

namespace {

// \param bounds  gives the DistanceBounds, which only windows want.
template <typename Bounds>
Propagation carry(const Surface& surface, const Corners& corners, const Bounds& bounds,
                  std::span<const SurfacePoint> sites, const PropagationOptions& options) {
    poll(options.progress, 0);
    if (options.engine == Engine::Vertex) {
        return propagate_vertices(surface, corners, sites, options);
    }
    return propagate_windows(surface, corners, bounds(), sites, options);
}

// Of the distinct sites. The others own nothing, but their windows would go as far as those of the
// site they lie on.
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

const char* engine_name(Engine engine) {
    switch (engine) {
        case Engine::Window:
            return "window";
        case Engine::Steiner:
            return "steiner";
        case Engine::Vertex:
            return "vertex";
    }
    return "unknown";
}

Propagation propagate(const Surface& surface, std::span<const SurfacePoint> sites,
                      const PropagationOptions& options) {
    const auto run = [&](std::span<const SurfacePoint> distinct) {
        if (options.engine == Engine::Steiner) return propagate_steiner(surface, distinct, options);
        const Corners corners(surface, options.num_threads, within(options.progress, 0, 0));
        const auto bounds = [&] {  // The arcs go before the windows come.
            const Progress begin = within(options.progress, 0, 0);
            return distance_bounds(surface, ArcGraph(surface, corners, begin),
                                   corners.mean_length(), distinct, options.num_threads, begin);
        };
        return carry(surface, corners, bounds, distinct, options);
    };
    return propagate_distinct(surface, sites, options, run);
}

Propagation propagate(const Surface& surface, const SurfaceLayout& layout,
                      std::span<const SurfacePoint> sites, const PropagationOptions& options) {
    const auto run = [&](std::span<const SurfacePoint> distinct) {
        if (options.engine == Engine::Steiner) return propagate_steiner(surface, distinct, options);
        const Corners& corners = layout.corners();
        const auto bounds = [&] {
            return distance_bounds(surface, layout.arcs(), corners.mean_length(), distinct,
                                   options.num_threads, within(options.progress, 0, 0));
        };
        return carry(surface, corners, bounds, distinct, options);
    };
    return propagate_distinct(surface, sites, options, run);
}

}  // namespace agvd
