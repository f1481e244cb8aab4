#include "remesh/pipeline/remesh.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "agvd/mesh/scale.h"
#include "remesh/pipeline/run.h"

namespace remesh {
namespace {

using agvd::Index;
using detail::run_pipeline;
using detail::TooFewSamples;

// Rounds of new sites where the result self-intersects.
constexpr int max_mends = 4;

void check_options(const RemeshOptions& options, std::size_t num_faces) {
    if (options.num_samples < 1) {
        throw agvd::InvalidOption("num_samples is 0; ask for at least 1");
    }
    if (options.repair_rounds < 0) {
        throw agvd::InvalidOption("repair_rounds is " + std::to_string(options.repair_rounds) +
                                  "; use 0 or more");
    }
    if (options.relax_steps < 0) {
        throw agvd::InvalidOption("relax_steps is " + std::to_string(options.relax_steps) +
                                  "; use 0 or more");
    }
    if (!(options.drop_components >= 0 && options.drop_components <= 100)) {
        throw agvd::InvalidOption("drop_components is " + std::to_string(options.drop_components) +
                                  "; use a percentage from 0 to 100");
    }
    if (!(options.feature_angle > 0 && options.feature_angle < 180)) {
        throw agvd::InvalidOption("feature_angle is " + std::to_string(options.feature_angle) +
                                  "; use degrees above 0 and below 180");
    }
    if (!options.face_labels.empty() && options.face_labels.size() != num_faces) {
        throw agvd::InvalidOption("face_labels has " + std::to_string(options.face_labels.size()) +
                                  " labels, but the mesh " + std::to_string(num_faces) +
                                  " faces; give one for each, or none");
    }
    if (options.num_threads < 0) {
        throw agvd::InvalidOption("num_threads is " + std::to_string(options.num_threads) +
                                  "; use 0 (all cores) or more");
    }
}

// The text for a run that has too few samples: with a number that was tried.
template <typename Mesh>
std::string describe_too_few(Mesh& mesh, const RemeshOptions& options, Index reached) {
    constexpr int max_tries = 6;
    RemeshOptions more = options;
    more.sites.reset();
    more.features = Features::Off;
    more.feature_edges.clear();
    more.face_labels.clear();
    for (int tries = 0; tries < max_tries; ++tries) {
        more.num_samples = reached;
        try {
            (void)run_pipeline(mesh, more, 0, {.has_junctions = false});
            return std::to_string(reached) + " work";
        } catch (const TooFewSamples& failure) {
            reached = std::max(failure.reached, reached + reached / 4 + 1);
        }
    }
    return "more than " + std::to_string(more.num_samples) + " are needed";
}

// Intersecting pairs of faces, less those that the input has.
Index num_new_crossings(const RemeshResult& result) {
    const Index pairs = result.self_intersections.value_or(0);
    return pairs - std::min(pairs, result.input_self_intersections);
}

const agvd::MeshView& view_of(const agvd::MeshView& mesh) { return mesh; }
agvd::MeshView view_of(const agvd::TriangleMesh& mesh) { return mesh.view(); }

// Lengths of what was made from a mesh times 2^-exponent.
void scale_back(RemeshResult& result, int exponent) {
    result.mesh = agvd::scaled(result.mesh.view(), exponent);
    for (double* length : {&result.features.length, &result.features.dropped_length}) {
        *length = std::ldexp(*length, exponent);
    }
    for (RelaxLevel& level : result.relaxation) {
        for (double& energy : level.energy) energy = std::ldexp(energy, 4 * exponent);
    }
}

// With fewer creases where no mesh with all of them was found, or only one that
// self-intersects; without any at last. Only where there is none either is it tried without
// junctions.
template <typename Mesh>
RemeshResult run_with_features(Mesh& mesh, const RemeshOptions& options) {
    const bool has_creases = options.features != Features::Off || !options.feature_edges.empty() ||
                             !options.face_labels.empty();
    const std::vector<double> drop_shares =
        has_creases ? std::vector{0.0, 0.3, 0.6, 1.0} : std::vector{0.0};
    std::optional<RemeshResult> best;
    for (const bool has_junctions : {true, false}) {
        for (const double drop_share : drop_shares) {
            try {
                RemeshResult result =
                    run_pipeline(mesh, options, max_mends, {has_junctions, drop_share});
                result.features.gave_up = drop_share > 0;
                if (!best || num_new_crossings(result) < num_new_crossings(*best)) {
                    best = std::move(result);
                }
                if (num_new_crossings(*best) == 0 || best->features.curves == 0) break;
            } catch (const detail::NetworkFailed&) {
                continue;
            }
        }
        if (best) break;
    }
    return std::move(*best);
}

// \param mesh  const agvd::MeshView, or agvd::TriangleMesh to be given away.
template <typename Mesh>
RemeshResult run(Mesh& mesh, const RemeshOptions& options) {
    check_options(options, mesh.triangles.size());
    if (const double size = agvd::extent(view_of(mesh)); !agvd::is_in_scale(size)) {
        const int exponent = std::ilogb(size);
        agvd::TriangleMesh normal = agvd::scaled(view_of(mesh), -exponent);
        RemeshResult result = run(normal, options);
        scale_back(result, exponent);
        return result;
    }
    try {
        return run_with_features(mesh, options);
    } catch (const TooFewSamples& failure) {
        const std::string asked = std::to_string(failure.asked);
        const std::string who =
            options.sites ? "the given sites, of which " + asked + " own a part of the surface,"
                          : asked + " samples";
        throw agvd::ConstraintUnmet(who + " are too few for the topology of the mesh; " +
                                    describe_too_few(mesh, options, failure.reached));
    }
}

}  // namespace

RemeshResult remesh(const agvd::MeshView& mesh, const RemeshOptions& options) {
    return run(mesh, options);
}

RemeshResult remesh_moved(agvd::TriangleMesh mesh, const RemeshOptions& options) {
    return run(mesh, options);
}

}  // namespace remesh
