#include "remesh/pipeline/check_result.h"

#include <stdexcept>

#include "remesh/curves/glue.h"
#include "remesh/pipeline/locked.h"

namespace remesh::detail {
namespace {

// Welds the sheets. Checks that as many edges have more than two faces as the chain has along
// junctions.
void weld_junctions(const CurveNetwork& network, std::span<const ChainEdge> chain, BuiltMesh& built,
                    RemeshResult& result) {
    built.sites = take(built.sites, weld_sheets(built.first_of_group, built.mesh));
    result.junctions.welded_edges = num_branched_edges(built.mesh.triangles);
    Index num_wanted = 0;
    for (const ChainEdge& edge : chain) {
        const bool is_branched = network.curves[edge.curve].sides.size() > 2;
        if (is_branched && edge.side == 0) ++num_wanted;
    }
    if (result.junctions.welded_edges != num_wanted) throw NetworkFailed{};
}

}  // namespace

Topology check_result(const CleanedInput& cleaned, const Domain& domain,
                      std::span<const ChainEdge> chain, BuiltMesh& built,
                      const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Check, result);
    const Progress progress = progress_of(Stage::Check, options);
    poll(progress, 1);
    Topology topology = analyze_topology(built.mesh.view(), within(progress, 1, 1));
    if (!topology.is_manifold || !topology.is_oriented ||
        !same_topology(topology, cleaned.topology)) {
        if (domain.plan) throw NetworkFailed{};
        throw std::logic_error("the result does not have the topology of the input");
    }
    if (!has_locked(*domain.whole, cleaned.locked, built.mesh)) throw NetworkFailed{};
    if (domain.has_junctions() && options.junctions == Junctions::Keep) {
        weld_junctions(domain.plan->network.network, chain, built, result);
    }
    if (domain.plan && options.vertex_count == VertexCount::Exact &&
        built.mesh.positions.size() != built.num_wanted) {
        throw NetworkFailed{};
    }
    return topology;
}

}  // namespace remesh::detail
