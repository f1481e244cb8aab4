// The boundary gets its sites by a plan of its curves first, then the inside of each component.
#include "remesh/sites/sampling.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "remesh/sites/network_plan.h"
#include "remesh/sites/shares.h"

namespace remesh {
namespace {

// Candidates per site for elimination; more gain little ([yuksel2015] Sec. 3).
constexpr Index candidates_per_site = 5;
// Few sites need a better choice, as their positions must keep the topology of a small part.
constexpr Index least_candidates = 60;
constexpr Index most_samples = no_index / candidates_per_site;

// `count` points strictly inside faces of a component, besides those on its rim; fewer if it is too
// small for that many.
// \param done  the fraction that progress reports.
std::vector<SurfacePoint> sample_inside(const Surface& surface, const Component& component,
                                        const std::vector<SurfacePoint>& rim, Index count,
                                        double spacing, std::uint64_t stream,
                                        const SamplingOptions& given, double done) {
    SamplingOptions options = given;
    options.progress = within(given.progress, done, done);
    if (options.init == Init::Farthest) {
        return detail::farthest_points(surface, component, rim, count, spacing, stream, options);
    }
    const bool is_blue = options.init == Init::BlueNoise;
    const Index scattered =
        is_blue ? std::max(candidates_per_site * count, least_candidates) : count;
    auto points = detail::scatter(surface, component, scattered, stream, options);
    if (!is_blue || points.size() < count) return points;
    points.insert(points.end(), rim.begin(), rim.end());
    return detail::eliminate(surface, points, static_cast<Index>(rim.size()), count, spacing,
                             options.num_threads, options.progress,
                             lengths_at(options.sizes, points));
}

// Sites strictly inside the faces of each component, by a quota.
// \param spacing_of  gives the spacing of a component.
template <typename SpacingOf>
std::vector<SurfacePoint> sample_components(const Surface& surface,
                                            const std::vector<Component>& components,
                                            const std::vector<Index>& quota,
                                            std::span<const SurfacePoint> rim,
                                            const SpacingOf& spacing_of,
                                            const SamplingOptions& options) {
    const std::vector<Index> component_of = label_components(surface.twin).of_face;
    std::vector<std::vector<SurfacePoint>> rim_of(components.size());
    for (const SurfacePoint& site : rim) {
        rim_of[component_of[site.face.value()]].push_back(site);
    }
    const Index count = std::accumulate(quota.begin(), quota.end(), Index{0});
    std::vector<SurfacePoint> sites;
    for (Index i = 0; i < components.size(); ++i) {
        if (quota[i] == 0) continue;
        const double done = static_cast<double>(sites.size()) / count;
        const auto points = sample_inside(surface, components[i], rim_of[i], quota[i],
                                          spacing_of(i), i, options, done);
        sites.insert(sites.end(), points.begin(), points.end());
    }
    return sites;
}

// Sites on the boundary and inside; empty if they are too few for the boundary, or there is none.
std::vector<SurfacePoint> sample_with_boundary(const Surface& surface,
                                               const SamplingOptions& options) {
    if (std::ranges::count(surface.twin, no_index) == 0) return {};
    const Progress begin = within(options.progress, 0, 0);
    const NetworkPlan plan =
        plan_network(surface, std::vector<std::uint8_t>(surface.num_edges(), 0),
                     options.num_samples, {}, options.num_threads, begin, options.sizes);
    if (plan.network.curves.empty()) return {};
    std::vector<SurfacePoint> sites = curve_sites_at(plan.network, plan.cut, plan.along).sites;
    const auto inner =
        sample_inner_sites(surface, sites, options.num_samples - static_cast<Index>(sites.size()),
                           plan.spacing, options);
    sites.insert(sites.end(), inner.begin(), inner.end());
    return sites;
}

}  // namespace

const char* init_name(Init init) {
    switch (init) {
        case Init::Random:
            return "random";
        case Init::BlueNoise:
            return "blue-noise";
        case Init::Farthest:
            return "farthest";
    }
    return "unknown";
}

std::vector<SurfacePoint> sample_sites(const Surface& surface, const SamplingOptions& options) {
    if (options.num_samples < 1) {
        throw InvalidOption("num_samples is 0; use 1 or more");
    }
    if (options.num_samples > most_samples) {
        throw InvalidOption("num_samples is " + std::to_string(options.num_samples) +
                            "; use at most " + std::to_string(most_samples));
    }
    check_num_threads(options.num_threads);
    if (surface.num_faces() == 0) {
        throw InvalidInput("the surface has no face; check that the file holds a surface");
    }
    poll(options.progress, 0);
    std::vector<SurfacePoint> sites;
    if (options.init != Init::Random && options.boundary == Boundary::Keep) {
        sites = sample_with_boundary(surface, options);
    }
    if (sites.empty()) {
        const Progress begin = within(options.progress, 0, 0);
        const std::vector<Component> components =
            detail::sized_components(surface, options.sizes, begin);
        const std::vector<Index> quota = detail::share_out(components, options.num_samples);
        const auto spacing_of = [&](Index i) {
            return detail::spacing_of(quota[i], components[i].area());
        };
        sites = sample_components(surface, components, quota, {}, spacing_of, options);
    }
    if (sites.size() < options.num_samples) {
        throw ConstraintUnmet("a component is too small for its share of " +
                              std::to_string(options.num_samples) +
                              " different points; use fewer samples, or move the mesh to the "
                              "origin");
    }
    poll(options.progress, 1);
    return sites;
}

std::vector<SurfacePoint> sample_inner_sites(const Surface& surface,
                                             std::span<const SurfacePoint> rim, Index count,
                                             double spacing, const SamplingOptions& options) {
    const Progress begin = within(options.progress, 0, 0);
    const std::vector<Component> components =
        detail::sized_components(surface, options.sizes, begin);
    const std::vector<Index> quota =
        detail::share_out_inner(surface, components, count, spacing, options.sizes);
    return sample_components(
        surface, components, quota, rim, [&](Index) { return spacing; }, options);
}

}  // namespace remesh
