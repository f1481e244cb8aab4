#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "report/report.h"
#include "support/report_keys.h"
#include "support/shapes.h"

using nlohmann::json;

namespace {

remesh::RemeshResult example_result() {
    remesh::RemeshResult result;
    result.mesh.positions.resize(3);
    result.mesh.triangles.resize(1);
    result.cleaned.split_edges = 4;
    result.input_topology.components = {{.faces = 8, .euler = 0, .genus = 1, .area = 1.5}};
    result.input_topology.face_component.assign(8, 0);
    result.components_dropped = 10;
    result.sites_dropped = 6;
    result.unfitted_vertices = 15;
    result.self_intersections = 17;
    result.input_self_intersections = 16;
    result.new_self_intersections = 3;
    result.crossing_near = {4, 5, 6};
    result.forced = {{.face = 0, .min_angle = 7, .max_angle = 160}};
    result.features = {.curves = 21,
                       .nodes = 22,
                       .vertices = 23,
                       .length = 2.5,
                       .close_length = 2.625,
                       .dropped_length = 2.75,
                       .freed_length = 2.875,
                       .freed_near = {15, 16, 17},
                       .uncarried_curves = 24,
                       .samples_for_all = 25,
                       .gave_up = true,
                       .seam_length = 1.25,
                       .dropped_seam_length = 0.75};
    result.verdict = {.spacing = 0.5,
                      .small_components = 41,
                      .samples_for_components = 42,
                      .thin_walls = 43,
                      .thinnest_wall = 0.25,
                      .samples_for_walls = 44,
                      .largest_distance = 3,
                      .farthest = {5, 6, 7},
                      .diagonal = 8,
                      .min_angle = std::numbers::pi / 8,
                      .small_angle_share = 0.125,
                      .narrow = {51, 12, 13, 14},
                      .bodies = {8, 2, 17, 1, 5, 3}};
    result.junctions = {.edges = 31,
                        .curves = 32,
                        .vertices = 33,
                        .apart_edges = 34,
                        .samples_for_all = 35,
                        .welded_edges = 36};
    result.sizing = {.num_samples = 77, .mean_edge = 1};
    result.dual = {.sites = 61,
                   .sites_of_cells = 62,
                   .narrow_sites = 63,
                   .simplified_parts = 26,
                   .simplified_patches = 64};
    result.certified_error = 1.23e-4;
    result.coarse_faces = 64'000;
    result.tiles = 4;
    result.propagation_bytes = 12'300'000;
    result.refined_faces = 4321;
    result.delaunay = {.inner_edges = 200,
                       .failing_before = 9,
                       .failing_after = 3,
                       .flips = 7,
                       .measured_edges = 150,
                       .not_locally_shortest = 1,
                       .broken_triangles = 2,
                       .is_finished = false};
    result.relaxation = {{.num_sites = 50, .energy = {4, 3, 2}}};
    result.seconds = {{remesh::Stage::Clean, 0.25}, {remesh::Stage::Dual, 0.5}};
    return result;
}

}  // namespace

TEST(RemeshReport, GivesEveryFieldOfTheResult) {
    const json report = json::parse(remesh::to_json(
        example_result(),
        {.version = "1.2",
         .input_path = "in.ply",
         .output_path = "out.obj",
         .options = {.num_samples = 77,
                     .vertex_count = remesh::VertexCount::Add,
                     .boundary = remesh::Boundary::Free,
                     .drop_components = 0.125,
                     .init = remesh::Init::Random,
                     .features = remesh::Features::Angle,
                     .feature_angle = 35,
                     .feature_edges = {{0, 1}, {1, 2}},
                     .face_labels = {4, 5, 6},
                     .junctions = remesh::Junctions::Keep,
                     .lock_boundary = true,
                     .seed = 9,
                     .relax_steps = 12,
                     .keep_sites = true,
                     .fit = false,
                     .propagation = {.engine = agvd::Engine::Window, .max_error = 0.25}}}));
    EXPECT_EQ(report["program"], "remesh");
    EXPECT_EQ(report["version"], "1.2");
    EXPECT_EQ(report["input_path"], "in.ply");
    EXPECT_EQ(report["output_path"], "out.obj");
    EXPECT_EQ(report["options"]["samples"], 77);
    EXPECT_EQ(report["options"]["topology"], "add");
    EXPECT_EQ(report["options"]["boundary"], "free");
    EXPECT_EQ(report["options"]["drop_components"], 0.125);
    EXPECT_EQ(report["options"]["features"], "angle");
    EXPECT_EQ(report["options"]["feature_angle_degrees"], 35);
    EXPECT_EQ(report["options"]["given_feature_edges"], 2);
    EXPECT_EQ(report["options"]["locked_boundary"], true);
    EXPECT_EQ(report["options"]["given_face_labels"], 3);
    EXPECT_EQ(report["options"]["junctions"], "keep");
    EXPECT_EQ(report["options"]["fit"], false);
    EXPECT_EQ(report["options"]["init"], "random");
    EXPECT_EQ(report["options"]["seed"], 9);
    EXPECT_EQ(report["options"]["given_sites"], nullptr);
    EXPECT_EQ(report["options"]["relax_steps"], 12);
    EXPECT_EQ(report["options"]["keep_sites"], true);
    EXPECT_EQ(report["relaxation"][0]["sites"], 50);
    EXPECT_EQ(report["relaxation"][0]["steps"], 2);
    EXPECT_EQ(report["relaxation"][0]["energy_mesh_units_4"], json({4.0, 3.0, 2.0}));
    EXPECT_EQ(report["options"]["engine"], "window");
    EXPECT_EQ(report["options"]["max_error"], 0.25);
    EXPECT_EQ(report["options"]["steiner_points_per_edge"], 8);
    EXPECT_EQ(report["options"]["lambda"], 1);
    EXPECT_EQ(report["options"]["delaunay"], "intrinsic");
    EXPECT_EQ(report["options"]["threads"], 0);
    EXPECT_EQ(report["input_repair"]["split_edges"], 4);
    EXPECT_EQ(report["input_faces"], 8);
    EXPECT_EQ(report["input_topology"]["genus"], 1);
    EXPECT_EQ(report["input_topology"]["components"][0]["euler_characteristic"], 0);
    EXPECT_EQ(report["output_vertices"], 3);
    EXPECT_EQ(report["output_faces"], 1);
    EXPECT_EQ(report["components_dropped"], 10);
    EXPECT_EQ(report["unfitted_vertices"], 15);
    EXPECT_EQ(report["input_self_intersecting_pairs"], 16);
    EXPECT_EQ(report["self_intersecting_pairs"], 17);
    EXPECT_EQ(report["new_self_intersecting_pairs"], 3);
    EXPECT_EQ(report["new_self_intersecting_near"], json({4.0, 5.0, 6.0}));
    EXPECT_EQ(report["forced_faces"][0]["min_angle_deg"], 7);
    EXPECT_EQ(report["forced_faces"][0]["max_angle_deg"], 160);
    EXPECT_EQ(report["forced_faces"][0]["at"].size(), 3u);
    EXPECT_EQ(report["features"], json({{"curves", 21},
                                        {"nodes", 22},
                                        {"vertices", 23},
                                        {"crease_length_mesh_units", 2.5},
                                        {"close_crease_length_mesh_units", 2.625},
                                        {"dropped_crease_length_mesh_units", 2.75},
                                        {"given_up_crease_length_mesh_units", 2.875},
                                        {"given_up_crease_near", {15, 16, 17}},
                                        {"curves_off_given_sites", 24},
                                        {"samples_for_all", 25},
                                        {"gave_up", true},
                                        {"texture_seam_length_mesh_units", 1.25},
                                        {"dropped_texture_seam_length_mesh_units", 0.75}}));
    EXPECT_EQ(report["dual"], json({{"sites", 61},
                                    {"sites_of_cells", 62},
                                    {"narrow_sites", 63},
                                    {"simplified_parts", 26},
                                    {"simplified_patches", 64}}));
    EXPECT_EQ(report["verdict"], json({{"closed_components", 8},
                                       {"holes", 2},
                                       {"hole_edges", 17},
                                       {"inside_out_bodies", 1},
                                       {"cavities", 5},
                                       {"inner_bodies", 3},
                                       {"spacing_mesh_units", 0.5},
                                       {"small_components", 41},
                                       {"samples_for_components", 42},
                                       {"thin_walls", 43},
                                       {"thinnest_wall_mesh_units", 0.25},
                                       {"samples_for_walls", 44},
                                       {"largest_distance_mesh_units", 3.0},
                                       {"largest_distance_percent_of_diagonal", 37.5},
                                       {"farthest_point", {5.0, 6.0, 7.0}},
                                       {"min_angle_deg", 22.5},
                                       {"small_angle_percent", 12.5},
                                       {"narrow_faces", 51},
                                       {"narrow_faces_at_acute_corners", 12},
                                       {"narrow_faces_at_thin_walls", 13},
                                       {"narrow_faces_between_creases", 14}}));
    EXPECT_EQ(report["junctions"], json({{"input_edges", 31},
                                         {"curves", 32},
                                         {"vertices", 33},
                                         {"edges_without_common_points", 34},
                                         {"samples_for_all", 35},
                                         {"welded_edges", 36}}));
    EXPECT_EQ(report["sites_dropped"], 6);
    EXPECT_EQ(report["delaunay"]["inner_edges"], 200);
    EXPECT_EQ(report["delaunay"]["failing_edges_before"], 9);
    EXPECT_EQ(report["delaunay"]["failing_before_percent"], 4.5);
    EXPECT_EQ(report["delaunay"]["failing_edges_after"], 3);
    EXPECT_EQ(report["delaunay"]["failing_after_percent"], 1.5);
    EXPECT_EQ(report["delaunay"]["flips"], 7);
    EXPECT_EQ(report["delaunay"]["measured_edges"], 150);
    EXPECT_EQ(report["delaunay"]["edges_not_locally_shortest"], 1);
    EXPECT_EQ(report["delaunay"]["broken_triangles"], 2);
    EXPECT_EQ(report["delaunay"]["finished"], false);
    EXPECT_EQ(report["certified_error"], 1.23e-4);
    EXPECT_EQ(report["coarse_faces"], 64'000);
    EXPECT_EQ(report["tiles"], 4);
    EXPECT_EQ(report["propagation_bytes"], 12'300'000);
    EXPECT_EQ(report["refined_faces"], 4321);
    EXPECT_EQ(report["stage_seconds"]["clean_s"], 0.25);
    EXPECT_EQ(report["stage_seconds"]["dual_s"], 0.5);
    EXPECT_EQ(report["total_s"], 0.75);
}

TEST(RemeshReport, AnErrorNotAskedForOrNotCertifiedIsNull) {
    remesh::RemeshResult result = example_result();
    result.certified_error = std::numeric_limits<double>::infinity();
    const json report = json::parse(
        remesh::to_json(result, {.options = {.propagation = {.engine = agvd::Engine::Steiner}}}));
    EXPECT_EQ(report["options"]["engine"], "steiner");
    EXPECT_EQ(report["options"]["max_error"], nullptr);
    EXPECT_EQ(report["certified_error"], nullptr);
}

// No value is null that may be an object.
TEST(RemeshReport, AllKeysAreDocumentedAndNoOthers) {
    remesh::RemeshResult result = example_result();
    result.kept.faces = {0};
    result.wrapped.faces = 1;
    remesh::RunInfo info;
    info.attributes.declined = {{"vt", "no place"}};
    info.output = remesh::measure_figures(shapes::cube().view());
    report_keys::expect_documented(remesh::to_json(result, info), {"remesh", "What reports share"});
}

TEST(RemeshReport, TellsTopologyAndQualityOfTheOutput) {
    remesh::RunInfo info;
    EXPECT_EQ(json::parse(remesh::to_json(example_result(), info))["output"], nullptr);
    info.output = remesh::measure_figures(shapes::cube().view());
    const json output = json::parse(remesh::to_json(example_result(), info))["output"];
    EXPECT_EQ(output["vertices"], 8);
    EXPECT_EQ(output["edges"], 18);
    EXPECT_EQ(output["faces"], 12);
    EXPECT_EQ(output["euler_characteristic"], 2);
    EXPECT_EQ(output["genus"], 0);
    EXPECT_EQ(output["boundary_loops"], 0);
    EXPECT_EQ(output["component_count"], 1);
    EXPECT_NEAR(output["min_angle_deg"], 45, 1e-9);
    EXPECT_NEAR(output["max_angle_deg"], 90, 1e-9);
    EXPECT_FALSE(output.contains("self_intersecting_pairs"));
}

TEST(RemeshReport, OfARunWithoutResultHasTheFirstKeys) {
    remesh::RunInfo info{.version = "1.2", .input_path = "in.ply", .output_path = "out.obj"};
    info.warnings = {"one", "two"};
    const json failed =
        json::parse(remesh::to_json({.exit_code = 4, .error = "no face", .stage = "clean"}, info));
    EXPECT_EQ(failed, json({{"program", "remesh"},
                            {"version", "1.2"},
                            {"status", "failed"},
                            {"exit_code", 4},
                            {"error", "no face"},
                            {"stage", "clean"},
                            {"input_path", "in.ply"},
                            {"output_path", "out.obj"},
                            {"warnings", {"one", "two"}}}));
    EXPECT_EQ(json::parse(remesh::to_json(remesh::RunFailure{.error = "exists"}))["status"],
              "skipped");
    const json done = json::parse(remesh::to_json(example_result(), info));
    EXPECT_EQ(done["status"], "done");
    EXPECT_EQ(done["exit_code"], 0);
    EXPECT_EQ(done["error"], nullptr);
    EXPECT_EQ(done["warnings"], json({"one", "two"}));
    for (const auto& [key, value] : failed.items()) EXPECT_TRUE(done.contains(key)) << key;
}

TEST(RemeshReport, OptionsAreThoseThatWereTaken) {
    const auto options = [](const remesh::RemeshOptions& given) {
        return json::parse(remesh::to_json(example_result(), {.options = given}))["options"];
    };
    EXPECT_EQ(options({.num_samples = 5})["samples"], 77);
    EXPECT_EQ(options({})["max_error"], agvd::default_max_error);
    EXPECT_EQ(options({})["fit"], true);
    EXPECT_EQ(options({.relax_steps = 0})["fit"], false);
    EXPECT_EQ(options({.relax_steps = 0, .fit = true})["fit"], true);
}

TEST(RemeshReport, TextTellsTheEngineAndItsBound) {
    EXPECT_EQ(remesh::to_text(agvd::Engine::Window, 0), "distances: window engine, exact");
    EXPECT_EQ(remesh::to_text(agvd::Engine::Steiner, std::numeric_limits<double>::infinity()),
              "distances: steiner engine, error unknown");
    // A bound is rounded up.
    EXPECT_EQ(remesh::to_text(agvd::Engine::Steiner, 7.12301e-4),
              "distances: steiner engine, at most 0.0713 % above exact");
}

TEST(RemeshReport, WithoutDelaunayThereAreNoFiguresOfIt) {
    const remesh::RunInfo info{.options = {.delaunay = remesh::Delaunay::Off}};
    const json report = json::parse(remesh::to_json(example_result(), info));
    EXPECT_EQ(report["options"]["delaunay"], "off");
    EXPECT_EQ(report["delaunay"], nullptr);
    EXPECT_EQ(remesh::details_to_text(example_result(), info).find("Delaunay"), std::string::npos);
}

TEST(RemeshReport, TextIsForAnyUser) {
    remesh::RemeshResult result = example_result();
    result.junctions = {};
    EXPECT_EQ(
        remesh::to_text(result, {.input_path = "in.ply", .output_path = "out.ply"}),
        "input: in.ply\n"
        "repaired: 4 split edges\n"
        "result: 3 vertices, 1 face; same topology\n"
        "watertight: no, 2 holes of 17 edges; 8 closed shells; 1 closed shell inside out (normals "
        "point inward); 5 closed shells around cavities of others; 3 closed shells inside others, "
        "around no cavity (normals point outward; --wrap leaves them out)\n"
        "edges: mean length 1\n"
        "10 components dropped, because the area is too small\n"
        "6 sites dropped, because they have no cell\n"
        "triangles: 12.5 % narrow (an angle below 30 degrees), smallest angle 22.5 degrees "
        "(51 faces below 30: 12 at acute corners, 13 at walls thinner than the edges, 14 between "
        "close creases); "
        "17 pairs cross (16 in the input; --wrap makes one closed surface)\n"
        "distance: farthest at least 37.5 % of the size, from the input's vertex at 5 6 7\n"
        "too small for edges of 0.5: creases of length 2.75 (too few of the given sites lie "
        "on 24 creases or on the boundary; with creases no mesh was found), creases of "
        "length 2.625 (too close to stronger ones), creases of length 2.875 (given up near 15 16 "
        "17, where faces would intersect or be narrow), 43 walls (thinnest 0.25; about 44 samples "
        "would do), 41 "
        "components (fewer than 12 vertices; about 42 samples would do)\n"
        "written: out.ply");
}

TEST(RemeshReport, TextOfAGoodResultHasAVerdictOfThreeLines) {
    remesh::RemeshResult result;
    result.mesh = shapes::cube();
    result.self_intersections = 0;
    result.sizing.mean_edge = 0.25;
    result.verdict = {.spacing = 0.25,
                      .largest_distance = 0.5,
                      .farthest = {1, 2, 3},
                      .diagonal = 8,
                      .min_angle = std::numbers::pi / 4,
                      .bodies = {.closed = 1}};
    EXPECT_EQ(remesh::to_text(result),
              "repaired: nothing\n"
              "result: 8 vertices, 12 faces; same topology\n"
              "watertight: yes; 1 closed shell\n"
              "edges: mean length 0.25\n"
              "triangles: even, smallest angle 45.0 degrees; no crossing\n"
              "distance: farthest at least 6.25 % of the size, from the input's vertex at 1 2 3\n"
              "too small for edges of 0.25: nothing");
    result.self_intersections.reset();
    result.verdict.narrow = {.count = 7};
    result.verdict.min_angle = std::numbers::pi / 8;
    result.verdict.small_angle_share = 0.01;
    EXPECT_NE(
        remesh::to_text(result).find(
            "\ntriangles: few narrow (an angle below 30 degrees), smallest angle 22.5 degrees "
            "(7 faces below 30); crossings not counted\n"),
        std::string::npos);
}

TEST(RemeshReport, DetailsTellTopologyTimeAndMemory) {
    remesh::RemeshResult result = example_result();
    const std::string text = remesh::details_to_text(
        result, {.options = {.propagation = {.engine = agvd::Engine::Window}}});
    for (const char* part :
         {"1 component, genus 1, 0 boundary loops", "distances: window engine, at most 0.0123 %",
          "energy lowered by 50.0 %",
          "\n26 parts simplified to the sites, because cells are no discs there: 101.6 % of the "
          "sites have the triangles of their cells\n",
          "21 curves, 22 corners, 23 vertices; 2.5 long: creases kept; 2.625 long: creases left "
          "out "
          "as too close to stronger ones; 2.75 long: creases dropped; "
          "2.875 long: creases given up where faces would intersect or be narrow; "
          "1.25 long: texture seams kept; 0.75 long: texture seams left out",
          "4.50 % of the edges failed it before 7 flips, 1.50 % after", "reached their limit",
          "1 edge not proved locally shortest", "fails in 2 faces", "clean 0.25 s, dual 0.50 s",
          "total 0.75 s", "12.3 MB"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
    }
    result.propagation_bytes = 0;
    const std::string without = remesh::details_to_text(result);
    EXPECT_TRUE(without.ends_with("total 0.75 s")) << without;
    result.features = {.curves = 1, .nodes = 4, .vertices = 5};
    EXPECT_NE(remesh::details_to_text(result).find("1 curve, 4 corners, 5 vertices\n"),
              std::string::npos)
        << "nothing on creases of no length";
}
