#include "remesh/pipeline/cleaned_input.h"

#include <utility>

#include "remesh/clean/soup.h"
#include "remesh/pipeline/locked.h"

namespace remesh::detail {
namespace {

// Sites, edges and labels refer to the caller's mesh; later stages carry them to the cleaned one.
bool refers_to_input(const RemeshOptions& options) {
    return options.sites || !options.feature_edges.empty() || !options.texture_seams.empty() ||
           !options.face_labels.empty() ||
           !(options.sizing.is_even() || options.sizing.is_adaptive()) || !options.locked.empty() ||
           !options.locked_edges.empty();
}

Topology topology_of(const CleanResult& clean, const Progress& progress) {
    return clean.connectivity.twin.empty()
               ? analyze_topology(clean.mesh.view(), progress)
               : analyze_topology(clean.mesh.view(), clean.connectivity, progress);
}

}  // namespace

CleanedInput clean_stage(const InputMesh& input, const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Clean, result);
    const Progress progress = progress_of(Stage::Clean, options);
    poll(progress, 0);
    CleanOptions cleaning = options.cleaning;
    cleaning.num_threads = options.num_threads;
    cleaning.progress = within(progress, 0, 0);
    CleanResult clean = clean_input(input.view, cleaning);
    result.cleaned = clean.counts;
    result.welded_slit_length = clean.slit_length;
    const Progress half = within(progress, cleaned_fraction / 2, cleaned_fraction / 2);
    CleanedInput cleaned;
    cleaned.given = input.view;
    if (!clean.welded_positions.empty()) {
        cleaned.welded_positions = std::move(clean.welded_positions);
        cleaned.given.positions = cleaned.welded_positions;
    }
    cleaned.topology = topology_of(clean, half);
    if (options.drop_components > 0) {
        result.components_dropped =
            drop_components(clean, cleaned.topology, options.drop_components);
        if (result.components_dropped > 0) cleaned.topology = topology_of(clean, half);
    }
    const bool is_unchanged = !clean.connectivity.twin.empty();
    if (!is_unchanged || refers_to_input(options)) {
        cleaned.vertex_origin = std::move(clean.vertex_origin);
        cleaned.face_origin = std::move(clean.face_origin);
    } else {
        clean.vertex_origin = std::vector<Index>();
        clean.face_origin = std::vector<Index>();
        if (input.owned != nullptr) {
            *input.owned = {};
            cleaned.given = {};
        }
    }
    poll(progress, cleaned_fraction);
    const Progress done = within(progress, cleaned_fraction, cleaned_fraction);
    cleaned.surface = is_unchanged
                          ? build_surface(std::move(clean.mesh), std::move(clean.connectivity),
                                          options.num_threads, done)
                          : build_surface(clean.mesh.view(), options.num_threads, done);
    cleaned.locked = find_locked(cleaned.given, options, cleaned.surface);
    return cleaned;
}

}  // namespace remesh::detail
