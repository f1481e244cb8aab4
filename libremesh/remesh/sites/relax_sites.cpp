// Relaxation from start to end: evens out bad starts, then runs the steps on the levels. Sampled
// sites start with a quarter of their number, are relaxed, and get the others in the middles
// between neighbours. If their triangulation does not resemble the surface, all sites are sampled
// at once; if that of all sites does not either, they are not relaxed.
#include "remesh/sites/relax_sites.h"

#include <algorithm>
#include <optional>
#include <string>

#include "agvd/core/parallel.h"
#include "agvd/core/progress.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/sites/even_out.h"
#include "remesh/sites/levels.h"
#include "remesh/sites/subdivide.h"
#include "remesh/sites/walk.h"

namespace remesh {
namespace {

using detail::gives_neighbours;
using detail::is_hopeless;
using detail::Levels;
using detail::Relaxation;

// Least number of coarse sites for each component: with fewer, the middles give no triangulation.
constexpr std::size_t least_coarse_sites = 32;
// Slightly more coarse sites than a quarter, as some pairs may lack a middle.
constexpr double coarse_margin = 1.002;
// A loop of the boundary needs three sites even if it is shorter than three spacings. Where this
// takes more than this share of the coarse sites, middles between them would crowd at small holes
// and leave too few sites elsewhere. Bunny with 60 holes of 3 to 12 edges, N = 2000: RMS distance
// .103 to .092 %.
constexpr double most_crowded = 0.05;
constexpr double least_sites_of_loop = 3;

void check_options(const RelaxOptions& options, std::size_t num_sites) {
    if (options.steps < 0) {
        throw InvalidOption("steps is " + std::to_string(options.steps) + "; use 0 or more");
    }
    if (!(options.tolerance >= 0)) {
        throw InvalidOption("tolerance is " + std::to_string(options.tolerance) +
                            "; use 0 or more");
    }
    check_num_threads(options.num_threads);
    if (!options.is_fixed.empty() && options.is_fixed.size() != num_sites) {
        throw InvalidOption("is_fixed has " + std::to_string(options.is_fixed.size()) +
                            " entries, but there are " + std::to_string(num_sites) +
                            " sites; give one for each, or none");
    }
}

// Sites that loops of the boundary need beyond those that fit onto them at the mean spacing.
double num_crowded(const Surface& surface, Index num_sites) {
    const double spacing = mean_spacing(surface, num_sites);
    double sum = 0;
    for (const std::vector<Index>& loop : boundary_loops(surface)) {
        double length = 0;
        for (const Index h : loop) length += surface.length_of(h);
        sum += std::max(least_sites_of_loop - length / spacing, 0.0);
    }
    return sum;
}

// The number of coarse sites that gives `count` sites together with the middles between them;
// nothing if it is too small.
std::optional<Index> coarse_count(const Surface& surface, Index count, const Progress& progress) {
    Poller poller(progress);
    const Index num_components = label_components(surface.twin, Ticker(poller)).count;
    const double euler = euler_of(surface);
    // The sum is V + E, with E = 3 V - 3 chi; with a boundary E is slightly smaller.
    const double coarse = coarse_margin * (count + 3 * euler) / 4 + 1;
    if (coarse < static_cast<double>(least_coarse_sites * num_components)) return std::nullopt;
    const auto result = static_cast<Index>(coarse);
    if (result > count || !gives_neighbours(surface, result)) return std::nullopt;
    if (num_crowded(surface, result) > most_crowded * coarse) return std::nullopt;
    return result;
}

}  // namespace

RelaxResult relax_sites(const PreparedSurface& surface, std::vector<SurfacePoint> sites,
                        const RelaxOptions& options) {
    check_options(options, sites.size());
    check_sites(surface.input(), sites);
    Levels levels(surface, options, 1);
    if (options.steps == 0 || sites.empty()) return levels.finish(std::move(sites));
    detail::even_out(surface, sites, options.is_fixed, options.num_threads, levels.progress(),
                     options.sizes);
    const DistanceBounds labels = levels.label(sites);
    Relaxation relaxation(surface.input(), sites,
                          detail::triangulate_sites(surface, labels, sites, {}, options.num_threads,
                                                    levels.progress()),
                          options.is_fixed, {}, options.num_threads, levels.progress());
    if (is_hopeless(relaxation)) return levels.finish(std::move(sites));
    levels.run(relaxation, &labels, options.corners);
    if (is_hopeless(relaxation)) return levels.finish(std::move(sites));
    return levels.finish(relaxation.sites());
}

RelaxResult sample_relaxed_sites(const PreparedSurface& surface, const SamplingOptions& sampling,
                                 const RelaxOptions& options) {
    check_options(options, 0);
    const Surface& input = surface.input();
    const auto one_after_the_other = [&] {
        return relax_sites(surface, sample_sites(input, sampling), options);
    };
    const std::optional<Index> coarse =
        coarse_count(surface.base.surface(), sampling.num_samples, within(options.progress, 0, 0));
    if (!coarse || options.steps == 0) return one_after_the_other();
    SamplingOptions first = sampling;
    first.num_samples = *coarse;
    Levels levels(surface, options, 2);
    first.progress = levels.progress();
    std::vector<SurfacePoint> sites = sample_sites(input, first);
    DistanceBounds labels = levels.label(sites);
    Relaxation relaxation(input, std::move(sites),
                          detail::label_triangles(surface.base.surface(), labels), {}, {},
                          options.num_threads, levels.progress());
    if (is_hopeless(relaxation)) return one_after_the_other();
    levels.run(relaxation, &labels, {});
    if (is_hopeless(relaxation)) return one_after_the_other();

    labels = levels.label(relaxation.sites());
    std::optional<detail::TriangulatedSites> fine = detail::subdivide(
        input, relaxation.sites(), relaxation.weights(), detail::label_dual(surface.base, labels),
        sampling.num_samples,
        options.sizes != nullptr ? options.sizes->at(relaxation.sites()) : std::vector<double>{});
    if (!fine) return one_after_the_other();
    Relaxation last(input, std::move(fine->sites), std::move(fine->triangles), {},
                    std::move(fine->weights), options.num_threads, levels.progress());
    levels.run(last, nullptr, options.corners);
    if (is_hopeless(last)) return one_after_the_other();
    return levels.finish(last.sites());
}

}  // namespace remesh
