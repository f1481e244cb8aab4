// Sites on curves slide along their curves; the others move inside their patches.
#include "remesh/pipeline/place_sites.h"

#include <utility>

#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/sites/relax_network.h"
#include "remesh/sites/sampling.h"

namespace remesh::detail {
PlacedSites place_sites(const Domain& domain, const StageContext& context) {
    const auto& [options, result] = context;
    const int steps = is_relaxed(options) ? options.relax_steps : 0;
    const StageClock clock(steps > 0 ? Stage::Relax : Stage::Sample, result);
    const RelaxOptions relax{.steps = steps,
                             .num_threads = options.num_threads,
                             .progress = progress_of(Stage::Relax, options),
                             .sizes = domain.sizes};
    const auto& [network, given] = *domain.plan;
    const SamplingOptions sampling{.num_samples = options.num_samples,
                                   .init = options.init,
                                   .boundary = options.boundary,
                                   .seed = options.seed,
                                   .num_threads = options.num_threads,
                                   .progress = progress_of(Stage::Sample, options),
                                   .sizes = domain.sizes};
    NetworkSites made =
        given ? relax_network_sites(domain.prepared, network, given->curves, given->inner, relax)
              : sample_network_sites(domain.prepared, network, sampling, relax);
    PlacedSites placed{.sites = std::move(made.sites),
                       .curves = std::move(made.curves),
                       .narrow_points = std::move(made.narrow_points),
                       .dividing = std::move(made.dividing),
                       .divided_chain = std::move(made.divided_chain)};
    placed.chain = chain_edges(network.network, network.cut, placed.curves);
    result.relaxation = std::move(made.levels);
    result.features.vertices = num_result_vertices(network.network, placed.curves);
    result.junctions.vertices = num_junction_vertices(network.network, placed.curves);
    return placed;
}

}  // namespace remesh::detail
