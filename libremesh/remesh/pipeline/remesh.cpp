#include "remesh/pipeline/remesh.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "agvd/core/parallel.h"
#include "agvd/mesh/scale.h"
#include "remesh/pipeline/run.h"

namespace remesh {
namespace {

void check_options(const RemeshOptions& options, std::size_t num_faces) {
    if (options.num_samples < 1) {
        throw agvd::InvalidOption("num_samples is 0; use 1 or more");
    }
    if (options.repair_rounds < 0) {
        throw agvd::InvalidOption("repair_rounds is " + std::to_string(options.repair_rounds) +
                                  "; use 0 or more");
    }
    if (options.relax_steps < 0) {
        throw agvd::InvalidOption("relax_steps is " + std::to_string(options.relax_steps) +
                                  "; use 0 or more");
    }
    if (!(options.drop_components >= 0 && options.drop_components <= 1)) {
        throw agvd::InvalidOption("drop_components is " + std::to_string(options.drop_components) +
                                  "; use a share from 0 to 1");
    }
    if (!(options.feature_angle > 0 && options.feature_angle < 180)) {
        throw agvd::InvalidOption("feature_angle is " + std::to_string(options.feature_angle) +
                                  "; use degrees above 0 and below 180");
    }
    if (!options.face_labels.empty() && options.face_labels.size() != num_faces) {
        throw agvd::InvalidOption("face_labels has " + std::to_string(options.face_labels.size()) +
                                  " labels, but the mesh has " + std::to_string(num_faces) +
                                  " faces; give one for each, or none");
    }
    agvd::check_num_threads(options.num_threads);
}

// Scales the lengths of a result back: it was computed from the mesh times 2^-exponent.
void scale_back(RemeshResult& result, int exponent) {
    result.mesh = agvd::scaled(result.mesh.view(), exponent);
    Verdict& verdict = result.verdict;
    for (double* length :
         {&result.features.length, &result.features.dropped_length, &verdict.spacing,
          &verdict.thinnest_wall, &verdict.largest_distance, &verdict.diagonal}) {
        *length = std::ldexp(*length, exponent);
    }
    for (double& coordinate : verdict.farthest) coordinate = std::ldexp(coordinate, exponent);
    for (ComponentTopology& component : result.input_topology.components) {
        component.area = std::ldexp(component.area, 2 * exponent);
    }
    for (RelaxLevel& level : result.relaxation) {
        for (double& energy : level.energy) energy = std::ldexp(energy, 4 * exponent);
    }
}

RemeshResult run(const detail::InputMesh& input, const RemeshOptions& options) {
    check_options(options, input.view.triangles.size());
    const double size = agvd::box_of(input.view, options.num_threads).longest_side();
    if (agvd::is_in_scale(size)) return detail::run_stages(input, options);
    const int exponent = std::ilogb(size);
    agvd::TriangleMesh normal = agvd::scaled(input.view, -exponent);
    RemeshResult result = detail::run_stages({normal.view(), &normal}, options);
    scale_back(result, exponent);
    return result;
}

}  // namespace

RemeshResult remesh(const agvd::MeshView& mesh, const RemeshOptions& options) {
    return run({mesh, nullptr}, options);
}

RemeshResult remesh_moved(agvd::TriangleMesh mesh, const RemeshOptions& options) {
    return run({mesh.view(), &mesh}, options);
}

}  // namespace remesh
