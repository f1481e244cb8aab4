// On an uncut surface relaxation moves sites anywhere; with a plan, those of curves stay on their
// curves. The sharp corners of a boundary that is kept get a site each.
#include "remesh/pipeline/place_sites.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/cleaned_input.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/sites/relax_network.h"
#include "remesh/sites/sampling.h"
#include "remesh/sites/shares.h"

namespace remesh::detail {
namespace {

// Sharp corners of the boundary of an uncut surface.
std::vector<Index> boundary_corners(const Domain& domain) {
    std::vector<Index> corners;
    for (const std::vector<Index>& loop : boundary_loops(*domain.whole)) {
        const std::vector<Index> some = find_corners(*domain.whole, loop, domain.spacing);
        corners.insert(corners.end(), some.begin(), some.end());
    }
    std::sort(corners.begin(), corners.end());
    return corners;
}

// If so, sample_relaxed_sites samples too.
bool is_coarse_to_fine(const RemeshOptions& options) {
    return !options.sites && options.init == Init::BlueNoise && options.relax_steps > 0;
}

SamplingOptions sampling_of(const RemeshOptions& options, Index num_samples,
                            const SizeField* sizes) {
    return {.num_samples = num_samples,
            .init = options.init,
            .boundary = options.boundary,
            .seed = options.seed,
            .num_threads = options.num_threads,
            .progress = progress_of(Stage::Sample, options),
            .sizes = sizes};
}

PlacedSites place_uncut(const CleanedInput& cleaned, const Domain& domain,
                        const StageContext& context) {
    const auto& [options, result] = context;
    // Surplus vertices are removed later, as far as the topology allows.
    const SamplingOptions sampling = sampling_of(
        options, std::max(options.num_samples, minimum_samples(cleaned.topology)), domain.sizes);
    PlacedSites placed;
    {
        const StageClock clock(Stage::Sample, result);
        if (options.sites) {
            placed.sites = given_sites(cleaned, *domain.whole, *options.sites);
        } else if (!is_coarse_to_fine(options)) {
            placed.sites = sample_sites(*domain.whole, sampling);
        }
        if (options.boundary == Boundary::Keep) placed.boundary_corners = boundary_corners(domain);
    }
    if (is_relaxed(options)) {
        const StageClock clock(Stage::Relax, result);
        const RelaxOptions relax{.steps = options.relax_steps,
                                 .boundary = options.boundary,
                                 .corners = placed.boundary_corners,
                                 .num_threads = options.num_threads,
                                 .progress = progress_of(Stage::Relax, options),
                                 .sizes = domain.sizes};
        RelaxResult relaxed = is_coarse_to_fine(options)
                                  ? sample_relaxed_sites(domain.prepared, sampling, relax)
                                  : relax_sites(domain.prepared, std::move(placed.sites), relax);
        placed.sites = std::move(relaxed.sites);
        result.relaxation = std::move(relaxed.levels);
    }
    if (options.sites) {
        placed.sites = take(placed.sites, distinct_points(*domain.whole, placed.sites));
    }
    return placed;
}

// Sites on curves slide along their curves.
PlacedSites place_on_network(const Domain& domain, const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Relax, result);
    const RelaxOptions relax{.steps = is_relaxed(options) ? options.relax_steps : 0,
                             .num_threads = options.num_threads,
                             .progress = progress_of(Stage::Relax, options),
                             .sizes = domain.sizes};
    const auto& [network, patches, given] = *domain.plan;
    NetworkSites made =
        given
            ? relax_network_sites(domain.prepared, network, given->curves, given->inner, relax)
            : sample_network_sites(domain.prepared, network,
                                   sampling_of(options, options.num_samples, domain.sizes), relax);
    PlacedSites placed{.sites = std::move(made.sites), .curves = std::move(made.curves)};
    placed.chain = chain_edges(network.network, network.cut, placed.curves);
    result.relaxation = std::move(made.levels);
    result.features.vertices = num_result_vertices(network.network, placed.curves);
    result.junctions.vertices = num_junction_vertices(network.network, placed.curves);
    return placed;
}

}  // namespace

Index PlacedSites::num_other_copies(const Domain& domain) const {
    if (!domain.plan) return 0;
    return static_cast<Index>(curves.sites.size()) -
           num_result_vertices(domain.plan->network.network, curves);
}

PlacedSites place_sites(const CleanedInput& cleaned, const Domain& domain,
                        const StageContext& context) {
    return domain.plan ? place_on_network(domain, context) : place_uncut(cleaned, domain, context);
}

}  // namespace remesh::detail
