// Shares the sites among components by area and boundary length (shares.h). For each component
// places sites on the boundary loops, then inner sites by one of three methods: scatter.h,
// eliminate.h or farthest_points.h.
#include "remesh/sites/sample_sites.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/topology.h"
#include "remesh/sites/boundary_curves.h"
#include "remesh/sites/eliminate.h"
#include "remesh/sites/farthest_points.h"
#include "remesh/sites/scatter.h"
#include "remesh/sites/shares.h"
#include "remesh/sites/sized_components.h"

namespace remesh {
namespace {

// Candidates per site for elimination; more gain little ([yuksel2015] Sec. 3).
constexpr Index candidates_per_site = 5;
// Few sites need a better choice, as their places must keep the topology of a small part.
constexpr Index least_candidates = 60;
constexpr Index most_samples = no_index / candidates_per_site;

// The boundary loops of each component.
std::vector<std::vector<std::vector<Index>>> find_loops(const Surface& surface,
                                                        const std::vector<Component>& components) {
    std::vector<std::vector<std::vector<Index>>> loops(components.size());
    std::vector<std::vector<Index>> all = boundary_loops(surface);
    if (all.empty()) return loops;
    std::vector<Index> component_of(surface.num_faces());
    for (Index i = 0; i < components.size(); ++i) {
        for (const Index f : components[i].faces) component_of[f] = i;
    }
    for (std::vector<Index>& loop : all) {
        loops[component_of[Surface::face(loop[0])]].push_back(std::move(loop));
    }
    return loops;
}

// The mean of the local lengths along a loop; 1 without.
double sized_mean(const Surface& surface, const std::vector<Index>& loop, const SizeField* sizes) {
    if (sizes == nullptr) return 1;
    return detail::sized_length(surface, loop, nullptr) /
           detail::sized_length(surface, loop, sizes);
}

// At most `most` sites on the loops of a component, with a wider spacing if necessary; none if even
// three on each loop are too many.
std::vector<SurfacePoint> sample_boundary(const Surface& surface,
                                          const std::vector<std::vector<Index>>& loops,
                                          double spacing, Index most, const SizeField* sizes) {
    constexpr double widening = 1.1;
    while (true) {
        std::vector<SurfacePoint> sites;
        for (const std::vector<Index>& loop : loops) {
            const double length = sized_mean(surface, loop, sizes);
            const auto corners = find_corners(surface, loop, spacing * length);
            const auto more = sample_loop(surface, loop, corners, spacing,
                                          sizes != nullptr ? sizes->function() : UnitAt{});
            sites.insert(sites.end(), more.begin(), more.end());
        }
        if (sites.size() <= most) return sites;
        if (sites.size() == 3 * loops.size()) return {};
        spacing *= widening;
    }
}

// `count` points strictly inside faces of a component, besides those on its rim; fewer if it is too
// small for that many.
std::vector<SurfacePoint> place_inside(const Surface& surface, const Component& component,
                                       const std::vector<SurfacePoint>& rim, Index count,
                                       double spacing, std::uint64_t stream,
                                       const SamplingOptions& options, const Progress& progress) {
    if (options.init == Init::Farthest) {
        return detail::farthest_points(surface, component, rim, count, spacing, options.seed,
                                       stream, options.num_threads, progress, options.sizes);
    }
    const bool is_blue = options.init == Init::BlueNoise;
    const Index scattered =
        is_blue ? std::max(candidates_per_site * count, least_candidates) : count;
    auto points = detail::scatter(surface, component, scattered, options.seed, stream, progress,
                                  options.sizes);
    if (!is_blue || points.size() < count) {
        std::vector<SurfacePoint> all;
        all.reserve(points.size());
        for (const detail::ScatteredPoint& p : points) all.push_back(p.point);
        return all;
    }
    for (const SurfacePoint& p : rim) {
        points.push_back({p, position(surface.mesh.view(), p)});
    }
    std::vector<double> unit;
    for (const detail::ScatteredPoint& p : points) {
        if (options.sizes != nullptr) unit.push_back(options.sizes->at(p.point));
    }
    return detail::eliminate(surface, points, static_cast<Index>(rim.size()), count, spacing,
                             options.num_threads, progress, unit);
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
    const Progress begin = within(options.progress, 0, 0);
    const std::vector<Component> components =
        detail::sized_components(surface, options.sizes, begin);
    const bool keeps_boundary = options.init != Init::Random && options.boundary == Boundary::Keep;
    const auto loops = find_loops(surface, components);
    std::vector<double> boundary_length(components.size(), 0);
    for (Index i = 0; keeps_boundary && i < components.size(); ++i) {
        for (const std::vector<Index>& loop : loops[i]) {
            if (options.sizes != nullptr) {
                boundary_length[i] += detail::sized_length(surface, loop, options.sizes);
                continue;
            }
            for (const Index h : loop) boundary_length[i] += surface.length_of(h);
        }
    }
    const std::vector<Index> quota =
        detail::share_out(components, boundary_length, options.num_samples);

    std::vector<SurfacePoint> sites;
    sites.reserve(options.num_samples);
    for (Index i = 0; i < components.size(); ++i) {
        if (quota[i] == 0) continue;
        const double spacing =
            detail::spacing_of(quota[i], components[i].area(), boundary_length[i]);
        std::vector<SurfacePoint> rim;
        if (keeps_boundary && !loops[i].empty()) {
            rim = sample_boundary(surface, loops[i], spacing, quota[i], options.sizes);
        }
        const Index inner = quota[i] - static_cast<Index>(rim.size());
        const double done = static_cast<double>(sites.size()) / options.num_samples;
        const auto points = place_inside(surface, components[i], rim, inner, spacing, i, options,
                                         within(options.progress, done, done));
        if (points.size() < inner) {
            throw ConstraintUnmet(
                "the component of face " + std::to_string(components[i].faces[0]) +
                " is too small for " + std::to_string(quota[i]) +
                " different points; use fewer samples, or move the mesh to the origin");
        }
        sites.insert(sites.end(), rim.begin(), rim.end());
        sites.insert(sites.end(), points.begin(), points.end());
        poll(options.progress, static_cast<double>(sites.size()) / options.num_samples);
    }
    return sites;
}

std::vector<SurfacePoint> sample_inner_sites(const Surface& surface,
                                             std::span<const SurfacePoint> rim, Index count,
                                             double spacing, const SamplingOptions& options) {
    const Progress begin = within(options.progress, 0, 0);
    const std::vector<Component> components =
        detail::sized_components(surface, options.sizes, begin);
    std::vector<Index> component_of(surface.num_faces());
    std::vector<double> lacking;
    for (Index i = 0; i < components.size(); ++i) {
        for (const Index f : components[i].faces) component_of[f] = i;
        const double length = detail::sized_boundary_length(surface, components[i], options.sizes);
        lacking.push_back(
            std::max(detail::inner_sites(components[i].area(), length, spacing), 0.0));
    }
    if (std::all_of(lacking.begin(), lacking.end(), [](double n) { return n == 0; })) {
        for (Index i = 0; i < components.size(); ++i) lacking[i] = components[i].area();
    }
    std::vector<Index> quota = detail::apportion(lacking, count);
    // Closed components have no sites on curves.
    std::vector<Index> wanted;
    wanted.reserve(components.size());
    for (const Component& c : components) {
        wanted.push_back(c.boundary_loops == 0 ? detail::recognisable_samples(c) : 0);
    }
    if (components.size() > 1) detail::lift_small(wanted, quota);
    std::vector<std::vector<SurfacePoint>> rim_of(components.size());
    for (const SurfacePoint& site : rim) {
        rim_of[component_of[site.face.value()]].push_back(site);
    }
    std::vector<SurfacePoint> sites;
    for (Index i = 0; i < components.size(); ++i) {
        if (quota[i] == 0) continue;
        const double done = static_cast<double>(sites.size()) / count;
        const auto points = place_inside(surface, components[i], rim_of[i], quota[i], spacing, i,
                                         options, within(options.progress, done, done));
        sites.insert(sites.end(), points.begin(), points.end());
    }
    return sites;
}

}  // namespace remesh
