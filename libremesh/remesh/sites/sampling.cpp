// Boundary loops get their sites first, then the inside of each component.
#include "remesh/sites/sampling.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "remesh/sites/shares.h"

namespace remesh {
namespace {

// Candidates per site for elimination; more gain little ([yuksel2015] Sec. 3).
constexpr Index candidates_per_site = 5;
// Few sites need a better choice, as their positions must keep the topology of a small part.
constexpr Index least_candidates = 60;
constexpr Index most_samples = no_index / candidates_per_site;

// #F
std::vector<Index> components_of_faces(const Surface& surface,
                                       const std::vector<Component>& components) {
    std::vector<Index> component_of(surface.num_faces());
    for (Index i = 0; i < components.size(); ++i) {
        for (const Index f : components[i].faces) component_of[f] = i;
    }
    return component_of;
}

// The boundary loops of each component.
std::vector<std::vector<std::vector<Index>>> find_loops(const Surface& surface,
                                                        const std::vector<Component>& components) {
    std::vector<std::vector<std::vector<Index>>> loops(components.size());
    std::vector<std::vector<Index>> all = boundary_loops(surface);
    if (all.empty()) return loops;
    const std::vector<Index> component_of = components_of_faces(surface, components);
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
            const auto more = detail::sample_loop(surface, loop, spacing * length, spacing,
                                                  length_function(sizes));
            sites.insert(sites.end(), more.begin(), more.end());
        }
        if (sites.size() <= most) return sites;
        if (sites.size() == 3 * loops.size()) return {};
        spacing *= widening;
    }
}

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
                             options.num_threads, options.progress, unit);
}

// Positions at even distances in the unit from `begin` on, before `end`.
std::vector<double> even_positions(const Curve& curve, double begin, double end, double fewest,
                                   double spacing, const UnitAt& unit_at) {
    const auto intervals_of = [&](double length) {
        return static_cast<Index>(std::max(fewest, std::round(length / spacing)));
    };
    std::vector<double> positions;
    if (!unit_at) {
        const Index intervals = intervals_of(end - begin);
        for (Index k = 0; k < intervals; ++k) {
            positions.push_back(begin + (end - begin) * k / intervals);
        }
        return positions;
    }
    // Steps of half a spacing at most, and their sums.
    std::vector<double> position{begin}, count{0};
    while (position.back() < end) {
        const double from = position.back();
        const double step = spacing * unit_at(point_on_curve(curve, from)) / 2;
        const double to = end - from < 1.5 * step ? end : from + step;
        count.push_back(count.back() +
                        (to - from) / unit_at(point_on_curve(curve, (from + to) / 2)));
        position.push_back(to);
    }
    const Index intervals = intervals_of(count.back());
    for (Index k = 0, i = 0; k < intervals; ++k) {
        const double wanted = count.back() * k / intervals;
        while (i + 2 < position.size() && count[i + 1] < wanted) ++i;
        const double share = (wanted - count[i]) / (count[i + 1] - count[i]);
        positions.push_back(position[i] + share * (position[i + 1] - position[i]));
    }
    return positions;
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
        const auto points =
            sample_inside(surface, components[i], rim, inner, spacing, i, options, done);
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
    const std::vector<Index> quota =
        detail::share_out_inner(surface, components, count, spacing, options.sizes);
    const std::vector<Index> component_of = components_of_faces(surface, components);
    std::vector<std::vector<SurfacePoint>> rim_of(components.size());
    for (const SurfacePoint& site : rim) {
        rim_of[component_of[site.face.value()]].push_back(site);
    }
    std::vector<SurfacePoint> sites;
    for (Index i = 0; i < components.size(); ++i) {
        if (quota[i] == 0) continue;
        const double done = static_cast<double>(sites.size()) / count;
        const auto points =
            sample_inside(surface, components[i], rim_of[i], quota[i], spacing, i, options, done);
        sites.insert(sites.end(), points.begin(), points.end());
    }
    return sites;
}

std::vector<Index> find_corners(const Surface& surface, const std::vector<Index>& loop,
                                double spacing) {
    std::vector<Index> corners;
    for (const std::size_t i : corners_of_curve(surface, curve_of_loop(surface, loop), spacing)) {
        corners.push_back(surface.tail(loop[i]));
    }
    return corners;
}

std::vector<SurfacePoint> detail::sample_loop(const Surface& surface,
                                              const std::vector<Index>& loop, double corner_spacing,
                                              double spacing, const UnitAt& unit_at) {
    const Curve curve = curve_of_loop(surface, loop);
    std::vector<double> ends;  // Positions on the loop where its pieces begin.
    for (const std::size_t i : corners_of_curve(surface, curve, corner_spacing)) {
        ends.push_back(curve.up_to[i]);
    }
    if (ends.empty()) ends.push_back(0);
    // Least number of intervals of a piece, so that the loop gets three sites.
    const double fewest = std::ceil(3.0 / static_cast<double>(ends.size()));
    std::vector<SurfacePoint> sites;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const double begin = ends[i];
        const double end = i + 1 < ends.size() ? ends[i + 1] : ends[0] + curve.length();
        for (const double position : even_positions(curve, begin, end, fewest, spacing, unit_at)) {
            sites.push_back(point_on_curve(curve, position));
        }
    }
    return sites;
}

}  // namespace remesh
