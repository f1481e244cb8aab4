// Builds JSON objects from results, with functions for their parts. Keys stay in the order in which
// they are set. Every key with a unit names it (mesh_units, percent, deg, s); what was not measured
// is null.
#include <algorithm>
#include <array>
#include <limits>

#include "remesh/pipeline/stage_context.h"
#include "report/ordered_json.h"
#include "report/report.h"
#include "report/report_common.h"

namespace remesh {
namespace {

using Json = OrderedJson;

using detail::degrees;

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

std::string dump(const Json& object) { return object.text() + '\n'; }

Json to_json(const CleanCounts& counts) {
    Json object;
    for (const detail::RepairRow& row : detail::repair_rows) object[row.key] = counts.*row.count;
    return object;
}

void add_topology(Json& object, const Topology& topology) {
    object["manifold"] = topology.is_manifold;
    object["oriented"] = topology.is_oriented;
    object["euler_characteristic"] =
        std::accumulate(topology.components.begin(), topology.components.end(), 0,
                        [](int sum, const ComponentTopology& c) { return sum + c.euler; });
    object["genus"] = topology.genus();
    object["boundary_loops"] = topology.boundary_loops();
    object["component_count"] = topology.components.size();
    Json& components = object["components"] = Json::array();
    for (const ComponentTopology& c : topology.components) {
        components.push_back({{"faces", c.faces},
                              {"euler_characteristic", c.euler},
                              {"genus", c.genus},
                              {"boundary_loops", c.boundary_loops},
                              {"area_square_mesh_units", c.area}});
    }
}

// Without self-intersections.
Json figures_of(const MeshFigures& mesh) {
    const TriangleQuality& quality = mesh.triangles;
    Json object;
    object["vertices"] = mesh.vertices;
    object["edges"] = quality.edges;
    object["faces"] = mesh.faces;
    add_topology(object, mesh.topology);
    object["mean_quality"] = quality.mean_quality;
    object["min_quality"] = quality.min_quality;
    object["mean_min_angle_deg"] = quality.mean_min_angle * degrees;
    object["min_angle_deg"] = quality.min_angle * degrees;
    object["max_angle_deg"] = quality.max_angle * degrees;
    object["faces_below_30_deg_percent"] = 100 * quality.small_angle_share;
    object["valence_6_percent"] = 100 * quality.regular_share;
    object["edge_length_variation"] = quality.edge_length_variation;
    object["non_delaunay_edges"] = quality.non_delaunay_edges;
    object["faces_without_area"] = quality.faces_without_area;
    return object;
}

Json to_json(const MeshFigures& mesh) {
    Json object = figures_of(mesh);
    object["self_intersecting_pairs"] = Json();
    object["self_intersecting_faces"] = Json();
    if (mesh.self_intersections) {
        object["self_intersecting_pairs"] = mesh.self_intersections->size();
        object["self_intersecting_faces"] = *mesh.self_intersections;
    }
    return object;
}

Json to_json(const OneSidedDistance& percent) {
    return {{"mean_percent_of_diagonal", percent.mean},
            {"rms_percent_of_diagonal", percent.rms},
            {"max_percent_of_diagonal", percent.max}};
}

// A distance that was not measured is NaN, which JSON shows as null.
Json to_json(const std::optional<SurfaceDistance>& measured) {
    SurfaceDistance distance = measured.value_or(SurfaceDistance{});
    if (!measured) distance.diagonal = std::numeric_limits<double>::quiet_NaN();
    const auto percent = [&](const OneSidedDistance& d) {
        return to_json(distance.percent_of_diagonal(d));
    };
    Json object;
    object["samples_per_surface"] = measured ? Json(distance.samples) : Json();
    object["original_diagonal_mesh_units"] = distance.diagonal;
    object["original_to_result"] = percent(distance.from_original);
    object["result_to_original"] = percent(distance.from_result);
    object["two_sided"] = percent(distance.two_sided());
    return object;
}

// Features that the original does not have are null.
Json to_json(const std::optional<FeatureCoverage>& measured) {
    const FeatureCoverage features = measured.value_or(FeatureCoverage{});
    const auto percent = [&](double share, bool is_there) {
        return is_there ? Json(100 * share) : Json();
    };
    const bool has_edges = features.length > 0, has_corners = features.corners > 0;
    Json object;
    object["original_length_mesh_units"] = measured ? Json(features.length) : Json();
    object["covered_percent"] = percent(features.covered, has_edges);
    object["covered_closely_percent"] = percent(features.covered_closely, has_edges);
    object["result_length_mesh_units"] = measured ? Json(features.result_length) : Json();
    object["false_percent"] = percent(features.false_share, measured.has_value());
    object["corners"] = measured ? Json(features.corners) : Json();
    object["corners_kept"] = has_corners ? Json(features.corners_kept) : Json();
    object["acute_corners"] = measured ? Json(features.acute_corners) : Json();
    object["min_angle_off_acute_corners_deg"] =
        measured ? Json(features.min_angle_elsewhere * degrees) : Json();
    return object;
}

Json to_json(const DelaunayCounts& counts, Delaunay delaunay) {
    if (delaunay == Delaunay::Off) return {};
    const double inner_edges = std::max<Index>(counts.inner_edges, 1);
    return {{"inner_edges", counts.inner_edges},
            {"failing_edges_before", counts.failing_before},
            {"failing_before_percent", 100 * counts.failing_before / inner_edges},
            {"failing_edges_after", counts.failing_after},
            {"failing_after_percent", 100 * counts.failing_after / inner_edges},
            {"flips", counts.flips},
            {"measured_edges", counts.measured_edges},
            {"edges_not_locally_shortest", counts.not_locally_shortest},
            {"broken_triangles", counts.broken_triangles},
            {"finished", counts.is_finished}};
}

Json to_json(const FeatureCounts& counts) {
    return {{"curves", counts.curves},
            {"nodes", counts.nodes},
            {"vertices", counts.vertices},
            {"crease_length_mesh_units", counts.length},
            {"close_crease_length_mesh_units", counts.close_length},
            {"dropped_crease_length_mesh_units", counts.dropped_length},
            {"given_up_crease_length_mesh_units", counts.freed_length},
            {"given_up_crease_near",
             std::array{counts.freed_near.x(), counts.freed_near.y(), counts.freed_near.z()}},
            {"curves_off_given_sites", counts.uncarried_curves},
            {"samples_for_all", counts.samples_for_all},
            {"gave_up", counts.gave_up},
            {"texture_seam_length_mesh_units", counts.seam_length},
            {"dropped_texture_seam_length_mesh_units", counts.dropped_seam_length}};
}

Json to_json(const DualCounts& counts) {
    return {{"sites", counts.sites},
            {"sites_of_cells", counts.sites_of_cells},
            {"narrow_sites", counts.narrow_sites},
            {"simplified_parts", counts.simplified_parts},
            {"simplified_patches", counts.simplified_patches}};
}

Json to_json(const JunctionCounts& counts) {
    return {{"input_edges", counts.edges},
            {"curves", counts.curves},
            {"vertices", counts.vertices},
            {"edges_without_common_points", counts.apart_edges},
            {"samples_for_all", counts.samples_for_all},
            {"welded_edges", counts.welded_edges}};
}

// Null: the whole mesh was remeshed.
Json to_json(const KeptPart& kept) {
    if (kept.faces.empty()) return {};
    return {{"kept_vertices", kept.vertices.size()},
            {"kept_faces", kept.faces.size()},
            {"rim_edges", kept.rim_edges}};
}

Json to_json(const Sizing& sizing) {
    Json object;
    const auto* lengths = std::get_if<VertexLengths>(&sizing.edges);
    const auto* of_faces = std::get_if<FaceLengths>(&sizing.edges);
    const auto* densities = std::get_if<VertexDensities>(&sizing.edges);
    object["adaptive"] = sizing.is_adaptive();
    object["given_target_lengths"] = lengths != nullptr ? lengths->values.size() : 0;
    object["given_face_lengths"] = of_faces != nullptr ? of_faces->values.size() : 0;
    object["given_densities"] = densities != nullptr ? densities->values.size() : 0;
    object["given_places"] = sizing.places.size();
    object["min_edge_mesh_units"] = sizing.min_edge;
    object["max_edge_mesh_units"] = sizing.max_edge;
    object["gradation"] = sizing.gradation;
    const auto* mean = std::get_if<MeanEdge>(&sizing.count);
    const auto* faces = std::get_if<NumFaces>(&sizing.count);
    const auto* distance = std::get_if<MaxDistance>(&sizing.count);
    const auto* error = std::get_if<MaxError>(&sizing.count);
    object["edge_length_mesh_units"] = mean != nullptr ? Json(mean->length) : Json();
    object["faces"] = faces != nullptr ? Json(faces->number) : Json();
    object["max_distance_mesh_units"] = distance != nullptr ? Json(distance->distance) : Json();
    object["max_error_mesh_units"] = error != nullptr ? Json(error->error) : Json();
    return object;
}

Json to_json(const SizingResult& sizing) {
    const bool has_targets = sizing.largest_target > 0;
    const auto measured = [&](double value) { return has_targets ? Json(value) : Json(); };
    return {{"samples", sizing.num_samples},
            {"mean_edge_mesh_units", sizing.mean_edge},
            {"least_target_mesh_units", measured(sizing.least_target)},
            {"largest_target_mesh_units", measured(sizing.largest_target)},
            {"edge_over_target_5th_percentile", measured(sizing.low_ratio)},
            {"edge_over_target_95th_percentile", measured(sizing.high_ratio)},
            {"largest_distance_mesh_units",
             sizing.largest_distance > 0 ? Json(sizing.largest_distance) : Json()}};
}

Json to_json(const Verdict& verdict) {
    return {
        {"closed_components", verdict.bodies.closed},
        {"holes", verdict.bodies.holes},
        {"hole_edges", verdict.bodies.hole_edges},
        {"inside_out_bodies", verdict.bodies.inside_out},
        {"cavities", verdict.bodies.cavities},
        {"inner_bodies", verdict.bodies.inner_bodies},
        {"spacing_mesh_units", verdict.spacing},
        {"small_components", verdict.small_components},
        {"samples_for_components", verdict.samples_for_components},
        {"thin_walls", verdict.thin_walls},
        {"thinnest_wall_mesh_units", verdict.thinnest_wall},
        {"samples_for_walls", verdict.samples_for_walls},
        {"largest_distance_mesh_units", verdict.largest_distance},
        {"largest_distance_percent_of_diagonal", 100 * verdict.largest_distance / verdict.diagonal},
        {"farthest_point",
         std::array{verdict.farthest.x(), verdict.farthest.y(), verdict.farthest.z()}},
        {"min_angle_deg", verdict.min_angle * degrees},
        {"small_angle_percent", 100 * verdict.small_angle_share},
        {"narrow_faces", verdict.narrow.count},
        {"narrow_faces_at_acute_corners", verdict.narrow.at_acute_corners},
        {"narrow_faces_at_thin_walls", verdict.narrow.at_thin_walls},
        {"narrow_faces_between_creases", verdict.narrow.between_creases}};
}

Json to_json(const AttributeReport& attributes) {
    Json declined = Json::array();
    for (const DeclinedAttribute& one : attributes.declined) {
        declined.push_back({{"name", one.name}, {"reason", one.reason}});
    }
    return {{"carried", attributes.carried},
            {"declined", declined},
            {"map_path", text_or_null(attributes.map_path)}};
}

// The bounds, and the faces that the input forces beyond them.
Json to_json(const ShapeBounds& bounds) {
    return {{"min_angle_deg", bounds.min_angle},
            {"max_angle_deg", bounds.max_angle},
            {"longest_edge_mesh_units", bounds.longest_edge}};
}

Json to_json(const std::vector<ForcedFace>& forced, const TriangleMesh& mesh) {
    Json faces = Json::array();
    for (const auto& [face, least, most] : forced) {
        const auto [a, b, c] = corners_of(mesh.view(), face);
        const Vec3 at = (a + b + c) / 3;
        faces.push_back({{"face", face},
                         {"min_angle_deg", least},
                         {"max_angle_deg", most},
                         {"at", std::array{at.x(), at.y(), at.z()}}});
    }
    return faces;
}

// What the window engine takes if nothing is asked for; the others then have no bound.
std::optional<double> max_error_of(const EngineOptions& options) {
    if (options.max_error || options.engine != Engine::Window) return options.max_error;
    return default_max_error;
}

Json to_json(const WrapCounts& wrapped) {
    if (wrapped.faces == 0) return {};
    return {{"radius_mesh_units", wrapped.radius},
            {"faces", wrapped.faces},
            {"sheet_percent", 100 * wrapped.sheets}};
}

// With the defaults that were taken.
Json to_json(const RemeshOptions& options, Index num_samples) {
    const std::optional<double> max_error = max_error_of(options.propagation);
    Json object;
    object["samples"] = num_samples;
    object["sizing"] = to_json(options.sizing);
    object["bounds"] = to_json(options.bounds);
    object["topology"] = options.vertex_count == VertexCount::Add ? "add" : "exact";
    object["boundary"] = options.boundary == Boundary::Keep ? "keep" : "free";
    object["keep_slits"] = options.cleaning.keep_slits;
    object["drop_components"] = options.drop_components;
    object["weld"] = options.cleaning.weld;
    object["fill_holes"] = options.cleaning.fill_holes;
    object["wrap"] = options.wrap ? Json(*options.wrap) : Json();
    object["features"] = features_name(options.features);
    object["feature_angle_degrees"] = options.feature_angle;
    object["given_feature_edges"] = options.feature_edges.size();
    object["given_face_labels"] = options.face_labels.size();
    object["texture_seam_edges"] = options.texture_seams.size();
    object["junctions"] = junctions_name(options.junctions);
    object["init"] = init_name(options.init);
    object["seed"] = options.seed;
    object["region"] = !options.region.empty();
    object["locked_vertices"] = options.locked.size();
    object["locked_boundary"] = options.lock_boundary;
    object["given_sites"] = options.sites ? Json(options.sites->size()) : Json();
    object["relax_steps"] = options.relax_steps;
    object["keep_sites"] = options.keep_sites;
    object["samples_per_tile"] = options.samples_per_tile;
    object["fit"] = options.fit.value_or(detail::is_relaxed(options));
    object["engine"] = engine_name(options.propagation.engine);
    object["max_error"] = max_error ? Json(*max_error) : Json();
    object["steiner_points_per_edge"] = options.propagation.steiner_points;
    object["lambda"] = options.propagation.lambda;
    object["delaunay"] = delaunay_name(options.delaunay);
    object["threads"] = options.num_threads;
    return object;
}

// What the report of every run begins with.
Json begin_report(const char* status, const RunFailure& failure, const RunInfo& info) {
    Json object;
    object["program"] = "remesh";
    object["version"] = text_or_null(info.version);
    object["status"] = status;
    object["exit_code"] = failure.exit_code;
    object["error"] = text_or_null(failure.error);
    object["stage"] = text_or_null(failure.stage);
    object["input_path"] = text_or_null(info.input_path);
    object["output_path"] = text_or_null(info.output_path);
    object["warnings"] = info.warnings;
    return object;
}

}  // namespace

std::string to_json(const RunFailure& failure, const RunInfo& info) {
    return dump(begin_report(failure.exit_code == 0 ? "skipped" : "failed", failure, info));
}

std::string to_json(const RemeshResult& result, const RunInfo& info) {
    Json object = begin_report("done", {}, info);
    object["options"] = to_json(info.options, result.sizing.num_samples);
    object["attributes"] = to_json(info.attributes);
    object["wrapped"] = to_json(result.wrapped);
    object["input_repair"] = to_json(result.cleaned);
    object["welded_slit_length_mesh_units"] = result.welded_slit_length;
    object["input_faces"] = result.input_topology.face_component.size();
    add_topology(object["input_topology"], result.input_topology);
    object["output_vertices"] = result.mesh.positions.size();
    object["output_faces"] = result.mesh.triangles.size();
    object["output"] = info.output ? figures_of(*info.output) : Json();
    object["kept"] = to_json(result.kept);
    object["refined_faces"] = result.refined_faces;
    object["components_dropped"] = result.components_dropped;
    object["sites_dropped"] = result.sites_dropped;
    object["features"] = to_json(result.features);
    object["junctions"] = to_json(result.junctions);
    object["sizing"] = to_json(result.sizing);
    object["forced_faces"] = to_json(result.forced, result.mesh);
    object["dual"] = to_json(result.dual);
    object["delaunay"] = to_json(result.delaunay, info.options.delaunay);
    object["unfitted_vertices"] = result.unfitted_vertices;
    Json& levels = object["relaxation"] = Json::array();
    for (const RelaxLevel& level : result.relaxation) {
        levels.push_back({{"sites", level.num_sites},
                          {"steps", level.energy.size() - 1},
                          {"energy_mesh_units_4", level.energy}});
    }
    object["verdict"] = to_json(result.verdict);
    object["self_intersecting_pairs"] =
        result.self_intersections ? Json(*result.self_intersections) : Json();
    object["input_self_intersecting_pairs"] =
        result.self_intersections.value_or(0) > 0 ? Json(result.input_self_intersections) : Json();
    object["new_self_intersecting_pairs"] =
        result.self_intersections ? Json(result.new_self_intersections) : Json();
    const Vec3& near = result.crossing_near;
    object["new_self_intersecting_near"] =
        result.new_self_intersections > 0 ? Json(std::array{near.x(), near.y(), near.z()}) : Json();
    object["certified_error"] = result.certified_error;
    object["coarse_faces"] = result.coarse_faces;
    object["tiles"] = result.tiles;
    object["propagation_bytes"] = result.propagation_bytes;
    Json& stages = object["stage_seconds"] = Json::object();
    for (const auto& [stage, seconds] : result.seconds) {
        stages[std::string(stage_name(stage)) + "_s"] = seconds;
    }
    object["total_s"] = detail::total_seconds(result);
    return dump(object);
}

std::string to_json(const Evaluation& evaluation, const EvaluationInfo& info) {
    const std::optional<SurfaceDistance>& distance = evaluation.distance;
    Json object;
    object["program"] = "remesh-eval";
    object["version"] = text_or_null(info.version);
    object["original_path"] = text_or_null(info.original_path);
    object["result_path"] = text_or_null(info.result_path);
    object["original_repair"] = to_json(evaluation.cleaned);
    object["original"] = to_json(evaluation.original);
    object["result"] = to_json(evaluation.result);
    object["topology_kept"] = evaluation.topology_kept;
    object["distance"] = to_json(distance);
    object["flipped_normals"] = distance ? Json(distance->flipped_faces) : Json();
    object["flipped_normals_percent"] =
        distance ? Json(100.0 * distance->flipped_faces / evaluation.result.faces) : Json();
    object["features"] = to_json(evaluation.features);
    return dump(object);
}

std::string to_json(const Comparison& comparison, const ComparisonInfo& info) {
    const DiagramDifference& difference = comparison.difference;
    const FrechetError& frechet = difference.frechet;
    const auto bisectors = [](const std::optional<BisectorError>& error) {
        if (!error) return Json();
        return Json{{"mean", error->mean},
                    {"p95", error->p95},
                    {"max", error->max},
                    {"points", error->num_points}};
    };
    Json object;
    object["program"] = "agvd compare";
    object["version"] = text_or_null(info.version);
    object["a"] = text_or_null(info.a);
    object["b"] = text_or_null(info.b);
    object["sites"] = comparison.sites;
    object["mean_cell_radius_mesh_units"] = difference.cell_radius;
    object["frechet"] = {{"sum_mesh_units", frechet.sum},
                         {"largest_mesh_units", frechet.largest},
                         {"delta", frechet.delta},
                         {"delta_unit_mesh_units", frechet.unit},
                         {"spacing_mesh_units", frechet.spacing},
                         {"matched_loops", frechet.matched_loops},
                         {"unmatched_loops", frechet.unmatched_loops}};
    object["wrong_label_percent"] = 100 * difference.wrong_label_area;
    object["hausdorff_mesh_units"] = difference.hausdorff;
    object["bisector_error_a"] = bisectors(comparison.bisectors_a);
    object["bisector_error_b"] = bisectors(comparison.bisectors_b);
    return dump(object);
}

}  // namespace remesh
