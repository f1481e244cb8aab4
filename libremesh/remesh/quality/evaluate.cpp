#include "remesh/quality/evaluate.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "agvd/core/error.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface.h"
#include "remesh/clean/soup.h"
#include "remesh/curves/find_creases.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/sites.h"

namespace remesh {
namespace {

// Puts the name of the mesh before the text of errors.
template <typename Use>
auto naming(const std::string& mesh, const Use& use) {
    try {
        return use();
    } catch (const InvalidInput& error) {
        throw InvalidInput(mesh + ": " + error.what());
    }
}

bool has_creases(const CleanResult& original, std::size_t num_vertices, int num_threads) {
    if (original.counts.split_edges > 0) return true;
    const Surface surface = build_surface(original.mesh.view(), num_threads);
    const std::vector<std::uint8_t> creases = find_creases(
        surface, {.spacing = mean_spacing(
                      surface, std::max<std::size_t>(SamplingOptions{}.num_samples, num_vertices)),
                  .num_threads = num_threads});
    return std::find(creases.begin(), creases.end(), 1) != creases.end();
}

MeshFigures measure(const MeshView& mesh, int num_threads, const Progress& progress) {
    MeshFigures figures = measure_figures(mesh, progress);
    figures.self_intersections = find_self_intersections(mesh, num_threads, progress);
    return figures;
}

// \param original  of a size that can be computed on.
Evaluation evaluate_in_scale(const MeshView& original, const MeshView& result,
                             const EvaluationOptions& options) {
    // The result is not repaired, since its defects are measured: only that can be checked.
    naming("result", [&] { detail::check_elements(result); });
    const Progress& all = options.progress;
    const CleanResult clean = naming("original", [&] {
        return clean_input(original,
                           {.num_threads = options.num_threads, .progress = within(all, 0, 0.1)});
    });
    Evaluation evaluation;
    EvaluationOptions measuring = options;
    measuring.progress = within(all, 0.1, 0.5);
    evaluation.distance = surface_distance(clean.mesh.view(), result, measuring);
    evaluation.cleaned = clean.counts;
    evaluation.original = measure(clean.mesh.view(), options.num_threads, within(all, 0.5, 0.8));
    evaluation.result = measure(result, options.num_threads, within(all, 0.8, 0.95));
    evaluation.features = feature_coverage(clean.mesh.view(), result, within(all, 0.95, 1));
    evaluation.has_creases =
        evaluation.features && has_creases(clean, result.positions.size(), options.num_threads);
    const Topology& topology = evaluation.result.topology;
    evaluation.topology_kept = topology.is_manifold && topology.is_oriented &&
                               same_topology(evaluation.original.topology, topology);
    return evaluation;
}

// Scales the lengths back: the meshes were measured times 2^-exponent.
void scale_back(Evaluation& evaluation, int exponent) {
    for (Topology* topology : {&evaluation.original.topology, &evaluation.result.topology}) {
        for (ComponentTopology& c : topology->components) c.area = std::ldexp(c.area, 2 * exponent);
    }
    if (evaluation.distance) {
        SurfaceDistance& d = *evaluation.distance;
        for (OneSidedDistance* side : {&d.from_original, &d.from_result}) {
            for (double* length : {&side->mean, &side->rms, &side->max}) {
                *length = std::ldexp(*length, exponent);
            }
            for (double& coordinate : side->farthest) coordinate = std::ldexp(coordinate, exponent);
        }
        d.diagonal = std::ldexp(d.diagonal, exponent);
    }
    if (!evaluation.features) return;
    FeatureCoverage& f = *evaluation.features;
    for (double* length : {&f.length, &f.result_length, &f.diagonal}) {
        *length = std::ldexp(*length, exponent);
    }
}

}  // namespace

MeshFigures measure_figures(const MeshView& mesh, const Progress& progress) {
    return {.vertices = static_cast<Index>(mesh.positions.size()),
            .faces = static_cast<Index>(mesh.triangles.size()),
            .topology = analyze_topology(mesh, progress),
            .triangles = measure_triangles(mesh, progress),
            .self_intersections = {}};
}

Evaluation evaluate(const MeshView& original, const MeshView& result,
                    const EvaluationOptions& options) {
    const double size = box_of(original).longest_side();
    if (is_in_scale(size)) return evaluate_in_scale(original, result, options);
    const int exponent = std::ilogb(size);
    const TriangleMesh normal = scaled(original, -exponent);
    const TriangleMesh normal_result = scaled(result, -exponent);
    Evaluation evaluation = evaluate_in_scale(normal.view(), normal_result.view(), options);
    scale_back(evaluation, exponent);
    return evaluation;
}

}  // namespace remesh
