#include <utility>

#include <algorithm>
#include "agvd/mesh/surface_points.h"
#include "remesh/clean/carry.h"
#include "remesh/pipeline/build_mesh.h"
#include "remesh/pipeline/coarse_input.h"
#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/curves.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/locked.h"
#include "remesh/pipeline/mesh_with_curves.h"
#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/sizes.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/pipeline/tile_meshes.h"
#include "remesh/placement/placement.h"

namespace remesh::detail {
namespace {

// Welds the sheets.
// \return whether as many edges have more than two faces as the chain has along junctions.
bool weld_junctions(const CurveNetwork& network, std::span<const ChainEdge> chain,
                    PlacedMesh& placed, TriangleMesh& mesh, RemeshResult& result) {
    if (!placed.place.empty()) {
        GluedMesh welded = glue(mesh.triangles, placed.place);
        mesh = {take(mesh.positions, welded.first), std::move(welded.triangles)};
        placed.points = take(placed.points, welded.first);
    }
    result.junctions.welded_edges = num_branched_edges(mesh.triangles);
    Index num_wanted = 0;
    for (const ChainEdge& edge : chain) {
        const bool is_branched = network.curves[edge.curve].sides.size() > 2;
        if (is_branched && edge.side == 0) ++num_wanted;
    }
    return result.junctions.welded_edges == num_wanted;
}

// Turns bodies over that few vertices have turned inside out: their volumes keep the sign of the
// input's.
// \param topology  of the mesh.
void keep_inside(const CleanedInput& cleaned, std::span<const SurfacePoint> points,
                 const Topology& topology, TriangleMesh& mesh) {
    const std::vector<double> volumes = body_volumes(mesh.view(), topology);
    if (std::ranges::all_of(volumes, [](double volume) { return volume == 0; })) return;
    const std::vector<double> wanted = body_volumes(cleaned.surface.mesh.view(), cleaned.topology);
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        Triangle& t = mesh.triangles[f];
        const Index part = cleaned.topology.face_component[points[t[0]].face.value()];
        const bool is_turned = volumes[topology.face_component[f]] * wanted[part] < 0;
        if (is_turned) std::swap(t[1], t[2]);
    }
}

// Sets the mesh of the result, and judges it. In between, Junctions::Keep welds the sheets.
// \return whether it has the topology of the input, all that is locked, and its junctions.
bool check_mesh(const CleanedInput& cleaned, const CurvedSurface& curved,
                std::span<const ChainEdge> chain, BuiltMesh& built, const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Check, result);
    const Progress progress = progress_at(Stage::Check, options, 1);
    poll(progress, 1);
    TriangleMesh& mesh = result.mesh = whole_mesh(cleaned.surface, built.mesh);
    const Topology topology = analyze_topology(mesh.view(), progress);
    if (!topology.is_manifold || !topology.is_oriented ||
        !same_topology(topology, cleaned.topology) ||
        !has_locked(cleaned.surface, cleaned.locked, mesh)) {
        return false;
    }
    keep_inside(cleaned, built.mesh.points, topology, mesh);
    if (curved.has_junctions() && options.junctions == Junctions::Keep &&
        !weld_junctions(curved.plan->network.network, chain, built.mesh, mesh, result)) {
        return false;
    }
    if (options.vertex_count == VertexCount::Exact && mesh.positions.size() != built.num_wanted) {
        return false;
    }
    result.verdict = judge_result(curved.cleaned->mesh.view(), mesh.view(), topology,
                                  options.num_threads, progress);
    BodyCounts& bodies = result.verdict.bodies;
    if (bodies.inside_out > 0) {
        // Coarse shells may stick out of one another, where a cavity looks like a body.
        Poller poller(progress);
        const BodyCounts of_input =
            count_bodies(curved.cleaned->mesh.view(), cleaned.finest().topology, Ticker(poller));
        bodies.inside_out = of_input.inside_out;
        bodies.cavities = of_input.cavities;
        bodies.inner_bodies = of_input.inner_bodies;
    }
    return true;
}

}  // namespace

MadeMesh mesh_with_curves(const CleanedInput& cleaned, const FoundCurves& found,
                          const KeptCurves& kept, const SizeField* sizes,
                          const DistanceBound* bound, InputCrossings& of_input,
                          const StageContext& context, Vertices vertices) {
    const auto& [options, result] = context;
    const double spacing = spacing_for(cleaned, options);
    std::unique_ptr<const CurvePlan> plan =
        plan_curves(cleaned, found, kept, spacing, sizes, context);
    // Of the vertices that seams take, creases come first.
    if (kept.has_seams && !options.sites && result.features.dropped_length > 0) {
        KeptCurves without = kept;
        without.has_seams = false;
        plan = plan_curves(cleaned, found, without, spacing, sizes, context);
    }
    if (plan->network.sites_for_boundary > 0) {
        return {.num_needed = plan->network.sites_for_boundary};
    }
    CurvedSurface curved{.plan = std::move(plan),
                         .whole = &cleaned.surface,
                         .cleaned = &cleaned.finest().surface,
                         .spacing = spacing,
                         .sizes = sizes,
                         .bound = bound};
    std::vector<SurfacePoint> narrow_points;
    BuiltMesh built;
    const auto is_right = [&](const CurvedSurface& surface, std::span<const ChainEdge> chain) {
        return check_mesh(cleaned, surface, chain, built, context);
    };
    bool has_mesh = false;
    if (vertices == Vertices::Surface) {
        built = mesh_by_collapses(curved, context);
        finish_mesh(curved, of_input, context, built);
        has_mesh = is_right(curved, {});
        if (!has_mesh) return {.num_needed = built.num_vertices};
    } else if (is_tiled(curved, options)) {
        const FeatureCounts planned = result.features;
        if (std::optional<TileMesh> tiled = mesh_in_tiles(curved, context)) {
            built.num_wanted = options.num_samples;
            built.num_vertices = static_cast<Index>(tiled->mesh.points.size());
            built.mesh = std::move(tiled->mesh);
            narrow_points = std::move(tiled->narrow_points);
            finish_mesh(curved, of_input, context, built);
            has_mesh = is_right(curved, {});
        }
        if (!has_mesh) {
            result.features = planned;
            result.tiles = 0;
        }
    }
    if (!has_mesh) {
        Domain domain = prepare_domain(cleaned, std::move(curved), context);
        PlacedSites sites = place_sites(domain, context);
        built = {};
        narrow_points = std::move(sites.narrow_points);
        if (!place_mesh(domain, sites, built, context)) return {.num_needed = built.num_vertices};
        finish_mesh(domain, of_input, context, built);
        if (!is_right(domain, sites.chain)) return {.num_needed = built.num_vertices};
    }
    const std::vector<SurfacePoint>& points = built.mesh.points;
    result.sizing = measure_edges(result.mesh.view(), points, options.num_samples, sizes);
    result.forced = std::move(built.forced);
    result.sizing.largest_distance = built.proved_distance.value_or(0);
    const CleanedInput& finest = cleaned.finest();
    result.sites = to_original(cleaned.finer != nullptr ? to_finer(cleaned, points) : points,
                               finest.given, {finest.surface.mesh.view(), finest.face_origin});
    if (const auto& crossings = built.self_intersections) {
        result.self_intersections = crossings->all;
        result.new_self_intersections = crossings->added;
        if (!built.crossing_corners.empty()) {
            result.crossing_near =
                position(cleaned.surface.mesh.view(), built.crossing_corners.front());
        }
    }
    return {.has_mesh = true,
            .narrow_points = std::move(narrow_points),
            .crossing_corners = std::move(built.crossing_corners)};
}

}  // namespace remesh::detail
