#include "remesh/quality/evaluate.h"

#include <string>

#include "agvd/core/error.h"
#include "remesh/quality/self_intersections.h"

namespace remesh {
namespace {

CleanResult clean_original(const agvd::MeshView& original) {
    try {
        return clean_input(original);
    } catch (const agvd::InvalidInput& error) {
        throw agvd::InvalidInput(std::string("original: ") + error.what());
    }
}

// The result is not repaired: its defects are what is to be told. It must only be measurable.
void check_result(const agvd::MeshView& mesh) {
    const auto fail = [](const std::string& text) { throw agvd::InvalidInput("result: " + text); };
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (mesh.positions[v].allFinite()) continue;
        fail("vertex " + std::to_string(v) +
             " has a coordinate that is not finite; correct or delete it");
    }
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        for (const agvd::Index v : mesh.triangles[f]) {
            if (v < mesh.positions.size()) continue;
            fail("face " + std::to_string(f) + " names vertex " + std::to_string(v) +
                 ", but there are only " + std::to_string(mesh.positions.size()) +
                 " (counted from 0); correct or delete it");
        }
    }
}

MeshFigures measure(const agvd::MeshView& mesh, int num_threads) {
    return {.vertices = static_cast<agvd::Index>(mesh.positions.size()),
            .faces = static_cast<agvd::Index>(mesh.triangles.size()),
            .topology = analyze_topology(mesh),
            .triangles = measure_triangles(mesh),
            .self_intersections = find_self_intersections(mesh, num_threads)};
}

}  // namespace

Evaluation evaluate(const agvd::MeshView& original, const agvd::MeshView& result,
                    const EvaluationOptions& options) {
    check_result(result);
    const CleanResult clean = clean_original(original);
    Evaluation evaluation;
    evaluation.distance = surface_distance(clean.mesh.view(), result, options);
    evaluation.cleaned = clean.counts;
    evaluation.original = measure(clean.mesh.view(), options.num_threads);
    evaluation.result = measure(result, options.num_threads);
    const Topology& topology = evaluation.result.topology;
    evaluation.topology_kept = topology.is_manifold && topology.is_oriented &&
                               same_topology(evaluation.original.topology, topology);
    return evaluation;
}

}  // namespace remesh
