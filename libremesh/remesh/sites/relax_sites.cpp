// Relaxation from start to end: evens out bad starts, then runs the steps on the levels. Sampled
// sites start with a quarter of their number, are relaxed, and get the others in the middles
// between neighbours. If their triangulation does not resemble the surface, all sites are sampled
// at once; if that of all sites does not either, they are not relaxed.
#include "remesh/sites/relax_sites.h"

#include <algorithm>
#include <memory>
#include <string>

#include "agvd/core/parallel.h"
#include "agvd/core/progress.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/sites/levels.h"
#include "remesh/sites/site_dual.h"
#include "remesh/sites/size_field.h"

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
// and leave too few sites elsewhere.
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
std::optional<Index> coarse_count(const Surface& surface, Index count, int num_threads,
                                  const Progress& progress) {
    Poller poller(progress);
    const Index num_components = label_components(surface.twin, num_threads, poller).count;
    const double euler = euler_of(surface);
    // The sum is V + E, with E = 3 V - 3 chi; with a boundary E is slightly smaller.
    const double coarse = coarse_margin * (count + 3 * euler) / 4 + 1;
    if (coarse < static_cast<double>(least_coarse_sites * num_components)) return std::nullopt;
    const auto result = static_cast<Index>(coarse);
    if (result > count || !gives_neighbours(surface, result)) return std::nullopt;
    if (num_crowded(surface, result) > most_crowded * coarse) return std::nullopt;
    return result;
}

// Relaxes a level from scratch; null if its triangulation does not resemble the surface.
std::unique_ptr<Relaxation> start(const PreparedSurface& surface, std::vector<SurfacePoint> sites,
                                  const RelaxOptions& options, std::span<const Index> corners,
                                  Levels& levels) {
    const DistanceBounds labels = levels.label(sites);
    std::vector<Triangle> triangles = levels.triangulate(labels, sites);
    auto relaxation = std::make_unique<Relaxation>(
        surface.input(), detail::TriangulatedSites{std::move(sites), std::move(triangles)},
        options.is_fixed, options.num_threads, levels.progress());
    if (is_hopeless(*relaxation)) return nullptr;
    levels.run(*relaxation, &labels, corners);
    if (is_hopeless(*relaxation)) return nullptr;
    return relaxation;
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
    const auto relaxation = start(surface, sites, options, options.corners, levels);
    return levels.finish(relaxation ? relaxation->sites() : std::move(sites));
}

RelaxResult sample_relaxed_sites(const PreparedSurface& surface, const SamplingOptions& sampling,
                                 const RelaxOptions& options) {
    check_options(options, 0);
    const Surface& input = surface.input();
    const auto one_after_the_other = [&] {
        return relax_sites(surface, sample_sites(input, sampling), options);
    };
    const std::optional<Index> coarse =
        coarse_count(surface.base.surface(), sampling.num_samples, options.num_threads,
                     within(options.progress, 0, 0));
    if (!coarse || options.steps == 0) return one_after_the_other();
    SamplingOptions first = sampling;
    first.num_samples = *coarse;
    Levels levels(surface, options, 2);
    first.progress = levels.progress();
    const auto relaxation = start(surface, sample_sites(input, first), options, {}, levels);
    if (!relaxation) return one_after_the_other();

    const std::vector<SurfacePoint>& sites = relaxation->sites();
    std::optional<detail::TriangulatedSites> fine = detail::subdivide(
        input, sites, relaxation->weights(), detail::label_dual(surface.base, levels.label(sites)),
        sampling.num_samples, lengths_at(options.sizes, sites));
    if (!fine) return one_after_the_other();
    Relaxation last(input, *std::move(fine), {}, options.num_threads, levels.progress());
    levels.run(last, nullptr, options.corners);
    if (is_hopeless(last)) return one_after_the_other();
    return levels.finish(last.sites());
}

}  // namespace remesh
