#include "remesh/pipeline/cleaned_input.h"

#include <string>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/clean/carry.h"
#include "remesh/clean/soup.h"
#include "remesh/clean/space_order.h"
#include "remesh/pipeline/locked.h"

namespace remesh::detail {
namespace {

// Fewer sites may repeat as they like: relaxation parts them.
constexpr std::size_t least_checked = 1000;

Topology topology_of(const CleanResult& clean, const Progress& progress) {
    return clean.connectivity.twin.empty()
               ? analyze_topology(clean.mesh.view(), progress)
               : analyze_topology(clean.mesh.view(), clean.connectivity, progress);
}

}  // namespace

// Later stages carry them to the cleaned mesh.
bool refers_to_input(const RemeshOptions& options) {
    return options.sites || !options.feature_edges.empty() || !options.texture_seams.empty() ||
           !options.face_labels.empty() || !options.sizing.places.empty() ||
           !(options.sizing.is_even() || options.sizing.is_adaptive()) || !options.locked.empty() ||
           !options.locked_edges.empty();
}

CleanedInput clean_stage(const InputMesh& input, const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Clean, result);
    poll(progress_of(Stage::Clean, options), 0);
    CleanResult clean = clean_input(input.view, cleaning_of(options));
    result.cleaned = clean.counts;
    result.welded_slit_length = clean.slit_length;
    result.loose_vertices = clean.loose_vertices;
    const Progress half = progress_at(Stage::Clean, options, cleaned_fraction / 2);
    Poller poller(half);
    const bool is_reordered = order_in_space(clean, Ticker(poller));
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
        if (is_reordered) cleaned.face_origin = std::move(clean.face_origin);
        clean.face_origin = std::vector<Index>();
        if (input.owned != nullptr) {
            *input.owned = {};
            cleaned.given = {};
        }
    }
    const Progress done = cleaned_progress(options);
    poll(done, 1);
    cleaned.surface = is_unchanged
                          ? build_surface(std::move(clean.mesh), std::move(clean.connectivity),
                                          options.num_threads, done)
                          : build_surface(clean.mesh.view(), options.num_threads, done);
    cleaned.locked = find_locked(cleaned.given, options, cleaned.surface);
    return cleaned;
}

std::vector<SurfacePoint> given_sites(const CleanedInput& cleaned, const Surface& surface,
                                      const std::vector<SurfacePoint>& sites) {
    std::vector<SurfacePoint> carried =
        to_cleaned(sites, cleaned.given, {surface.mesh.view(), cleaned.face_origin});
    if (carried.size() < least_checked) return carried;
    const std::size_t distinct = distinct_points(surface, carried).size();
    if (distinct * 2 >= carried.size()) return carried;
    throw InvalidSites(std::to_string(carried.size()) + " sites were given, but only at " +
                       std::to_string(distinct) + " different points; give each point once");
}

}  // namespace remesh::detail
