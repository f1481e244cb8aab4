#include "remesh/sampling/sample_sites.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "agvd/core/error.h"
#include "remesh/sampling/boundary_curves.h"
#include "remesh/sampling/components.h"
#include "remesh/sampling/eliminate.h"
#include "remesh/sampling/scatter.h"

namespace remesh {
namespace {

using agvd::Index;
using detail::Component;

// Candidates of which elimination leaves one; more gives little ([yuksel2015] Sec. 3).
constexpr Index candidates_per_site = 5;
// Few sites need a better choice than that, as their places are what keeps a small part's topology.
constexpr Index least_candidates = 60;
constexpr Index most_samples = agvd::no_index / candidates_per_site;

// Distance of neighbours in a mesh of equilateral triangles with this number of vertices, those on
// the boundary included: 2 N less the boundary's L / h is the number of triangles, sqrt(3) / 4 h^2
// the area of each.
double spacing_of(double num_vertices, double area, double boundary_length) {
    const double half = boundary_length / (4 * num_vertices);
    return half + std::sqrt(half * half + 2 * area / (std::numbers::sqrt3 * num_vertices));
}

// What each component's topology needs, then the rest by the vertices that such a mesh would have
// there, with the largest remainders rounded up.
std::vector<Index> share_out(const std::vector<Component>& components,
                             const std::vector<double>& boundary_length, Index num_samples) {
    std::vector<Index> quota;
    std::uint64_t needed = 0;
    double area = 0, length = 0;
    for (Index i = 0; i < components.size(); ++i) {
        quota.push_back(minimum_samples(components[i].genus(), components[i].boundary_loops));
        needed += quota.back();
        area += components[i].area();
        length += boundary_length[i];
    }
    if (num_samples < needed) {
        throw agvd::ConstraintUnmet(
            "the topology of the mesh (" + std::to_string(components.size()) +
            " components) needs at least " + std::to_string(needed) + " samples, not " +
            std::to_string(num_samples) + "; ask for that many or more");
    }
    const double spacing = spacing_of(num_samples, area, length);
    const auto vertices = [&](double area_share, double length_share) {
        return 2 / std::numbers::sqrt3 * area_share / (spacing * spacing) +
               length_share / (2 * spacing);
    };
    const auto rest = num_samples - static_cast<Index>(needed);
    Index given = 0;
    std::vector<std::pair<double, Index>> remainder;  // (negative, component)
    for (Index i = 0; i < quota.size(); ++i) {
        const double share =
            rest * (1 - 1e-12) *  // Sum <= rest.
            (vertices(components[i].area(), boundary_length[i]) / vertices(area, length));
        const auto whole = static_cast<Index>(share);
        quota[i] += whole;
        given += whole;
        remainder.emplace_back(whole - share, i);
    }
    std::sort(remainder.begin(), remainder.end());
    for (std::size_t i = 0; given < rest; ++given, ++i) {
        ++quota[remainder[i % remainder.size()].second];
    }
    return quota;
}

// The boundary loops of each component.
std::vector<std::vector<std::vector<Index>>> find_loops(const agvd::Surface& surface,
                                                        const std::vector<Component>& components) {
    std::vector<std::vector<std::vector<Index>>> loops(components.size());
    std::vector<std::vector<Index>> all = agvd::boundary_loops(surface);
    if (all.empty()) return loops;
    std::vector<Index> component_of(surface.num_faces());
    for (Index i = 0; i < components.size(); ++i) {
        for (const Index f : components[i].faces) component_of[f] = i;
    }
    for (std::vector<Index>& loop : all) {
        loops[component_of[agvd::Surface::face(loop[0])]].push_back(std::move(loop));
    }
    return loops;
}

// Sites on the loops of one component; at most `most` of them, with a wider spacing if need be.
std::vector<agvd::SurfacePoint> sample_boundary(const agvd::Surface& surface,
                                                const std::vector<std::vector<Index>>& loops,
                                                double spacing, Index most) {
    constexpr double widening = 1.1;
    while (true) {
        std::vector<agvd::SurfacePoint> sites;
        for (const std::vector<Index>& loop : loops) {
            const auto corners = find_corners(surface, loop, spacing);
            const auto more = sample_loop(surface, loop, corners, spacing);
            sites.insert(sites.end(), more.begin(), more.end());
        }
        if (sites.size() <= most) return sites;
        if (sites.size() == 3 * loops.size()) return {};
        spacing *= widening;
    }
}

}  // namespace

Index minimum_samples(int genus, int boundary_loops) {
    if (boundary_loops == 0) {
        if (genus == 2) return 10;  // The one orientable surface that misses the bound.
        return static_cast<Index>(std::ceil((7 + std::sqrt(1.0 + 48.0 * genus)) / 2));
    }
    // E <= V (V - 1) / 2 with all vertices on the boundary; loops have three vertices each,
    // unshared.
    const double euler = 2.0 - 2.0 * genus - boundary_loops;
    const double bound = std::ceil((5 + std::sqrt(25 - 24 * euler)) / 2);
    return std::max(static_cast<Index>(bound), static_cast<Index>(3 * boundary_loops));
}

std::vector<agvd::SurfacePoint> sample_sites(const agvd::Surface& surface,
                                             const SamplingOptions& options) {
    if (options.num_samples < 1) {
        throw agvd::InvalidOption("the number of samples is 0; ask for at least 1");
    }
    if (options.num_samples > most_samples) {
        throw agvd::InvalidOption("more than " + std::to_string(most_samples) +
                                  " samples cannot be handled; ask for fewer");
    }
    if (options.num_threads < 0) {
        throw agvd::InvalidOption("the number of threads is negative; use 0 for all cores");
    }
    if (surface.num_faces() == 0) {
        throw agvd::InvalidInput("the surface has no face to put samples on; check the input");
    }
    agvd::poll(options.progress, 0);
    const std::vector<Component> components = detail::find_components(surface);
    const bool is_blue = options.init == Init::BlueNoise;
    const bool keeps_boundary = is_blue && options.boundary == Boundary::Keep;
    const auto loops = find_loops(surface, components);
    std::vector<double> boundary_length(components.size(), 0);
    for (Index i = 0; keeps_boundary && i < components.size(); ++i) {
        for (const std::vector<Index>& loop : loops[i]) {
            for (const Index h : loop) boundary_length[i] += surface.length_of(h);
        }
    }
    const std::vector<Index> quota = share_out(components, boundary_length, options.num_samples);

    std::vector<agvd::SurfacePoint> sites;
    sites.reserve(options.num_samples);
    for (Index i = 0; i < components.size(); ++i) {
        const double spacing = spacing_of(quota[i], components[i].area(), boundary_length[i]);
        std::vector<agvd::SurfacePoint> rim;
        if (keeps_boundary && !loops[i].empty()) {
            rim = sample_boundary(surface, loops[i], spacing, quota[i]);
        }
        const Index inner = quota[i] - static_cast<Index>(rim.size());
        const Index count =
            is_blue ? std::max(candidates_per_site * inner, least_candidates) : inner;
        auto points = detail::scatter(surface, components[i], count, options.seed, i);
        if (points.size() < inner) {
            throw agvd::ConstraintUnmet(
                "the component of face " + std::to_string(components[i].faces[0]) +
                " is so small for its coordinates that it holds no " + std::to_string(quota[i]) +
                " different points; ask for fewer samples or move the mesh to the origin");
        }
        sites.insert(sites.end(), rim.begin(), rim.end());
        if (is_blue) {
            for (const agvd::SurfacePoint& p : rim) {
                points.push_back({p, agvd::position(surface.mesh.view(), p)});
            }
            const auto kept = detail::eliminate(surface, points, static_cast<Index>(rim.size()),
                                                inner, spacing, options.num_threads);
            sites.insert(sites.end(), kept.begin(), kept.end());
        } else {
            for (const detail::ScatteredPoint& p : points) sites.push_back(p.point);
        }
        agvd::poll(options.progress, static_cast<double>(sites.size()) / options.num_samples);
    }
    return sites;
}

}  // namespace remesh
