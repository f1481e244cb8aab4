#include "agvd/propagation/propagate.h"

#include <string>

#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/steiner_engine.h"
#include "agvd/propagation/steiner_points.h"
#include "agvd/propagation/vertex_engine.h"
#include "agvd/propagation/window_engine.h"

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
        throw InvalidOption("this mesh with " + std::to_string(options.steiner_points) +
                            " Steiner points per edge needs more than 2^32 nodes; use fewer");
    }
}

void check(const Surface& surface, std::span<const SurfacePoint> sites,
           const PropagationOptions& options) {
    check_sites(surface, sites);
    if (options.max_error && !(*options.max_error >= 0 && *options.max_error < 1)) {
        throw InvalidOption("the maximal error is " + std::to_string(*options.max_error) +
                            "; use a number from 0 (exact) to below 1");
    }
    if (options.engine == Engine::Steiner) check_steiner_options(surface, options);
    if (options.engine == Engine::Vertex && options.max_error) {
        throw InvalidOption(
            "the vertex engine knows no error bound; leave max_error unset, or use the window or "
            "the Steiner engine");
    }
}

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
    check(surface, sites, options);
    if (options.engine == Engine::Steiner) return propagate_steiner(surface, sites, options);
    const Corners corners(surface, options.num_threads);
    const auto bounds = [&] {  // The arcs go before the windows come.
        return distance_bounds(surface, ArcGraph(surface, corners), corners.mean_length(), sites,
                               options.num_threads);
    };
    return carry(surface, corners, bounds, sites, options);
}

Propagation propagate(const Surface& surface, const SurfaceLayout& layout,
                      std::span<const SurfacePoint> sites, const PropagationOptions& options) {
    check(surface, sites, options);
    if (options.engine == Engine::Steiner) return propagate_steiner(surface, sites, options);
    const Corners& corners = layout.corners();
    const auto bounds = [&] {
        return distance_bounds(surface, layout.arcs(), corners.mean_length(), sites,
                               options.num_threads);
    };
    return carry(surface, corners, bounds, sites, options);
}

}  // namespace agvd
