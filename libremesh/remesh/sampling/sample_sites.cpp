#include "remesh/sampling/sample_sites.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "agvd/core/error.h"
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

// What each component's topology needs, then the rest by area with the largest remainders rounded
// up.
std::vector<Index> share_out(const std::vector<Component>& components, Index num_samples) {
    std::vector<Index> quota;
    std::uint64_t needed = 0;
    double area = 0;
    for (const Component& c : components) {
        quota.push_back(minimum_samples(c.genus(), c.boundary_loops));
        needed += quota.back();
        area += c.area();
    }
    if (num_samples < needed) {
        throw agvd::ConstraintUnmet(
            "the topology of the mesh (" + std::to_string(components.size()) +
            " components) needs at least " + std::to_string(needed) + " samples, not " +
            std::to_string(num_samples) + "; ask for that many or more");
    }
    const auto rest = num_samples - static_cast<Index>(needed);
    Index given = 0;
    std::vector<std::pair<double, Index>> remainder;  // (negative, component)
    for (Index i = 0; i < quota.size(); ++i) {
        const double share = rest * (components[i].area() / area) * (1 - 1e-12);  // Sum <= rest.
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
    const std::vector<Index> quota = share_out(components, options.num_samples);

    std::vector<agvd::SurfacePoint> sites;
    sites.reserve(options.num_samples);
    for (Index i = 0; i < components.size(); ++i) {
        const bool is_blue = options.init == Init::BlueNoise;
        const Index count =
            is_blue ? std::max(candidates_per_site * quota[i], least_candidates) : quota[i];
        const auto points = detail::scatter(surface, components[i], count, options.seed, i);
        if (points.size() < quota[i]) {
            throw agvd::ConstraintUnmet(
                "the component of face " + std::to_string(components[i].faces[0]) +
                " is so small for its coordinates that it holds no " + std::to_string(quota[i]) +
                " different points; ask for fewer samples or move the mesh to the origin");
        }
        if (is_blue) {
            const auto kept = detail::eliminate(surface, points, quota[i], components[i].area(),
                                                options.num_threads);
            sites.insert(sites.end(), kept.begin(), kept.end());
        } else {
            for (const detail::ScatteredPoint& p : points) sites.push_back(p.point);
        }
        agvd::poll(options.progress, static_cast<double>(sites.size()) / options.num_samples);
    }
    return sites;
}

}  // namespace remesh
