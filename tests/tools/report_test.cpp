#include "report/report.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "support/report_keys.h"

using nlohmann::json;

namespace {

remesh::Evaluation example_evaluation() {
    remesh::Evaluation e;
    e.original.vertices = 10;
    e.original.topology.components = {{.faces = 16, .euler = 2, .area = 2.5}};
    e.original.self_intersections = {{3, 7}};
    e.cleaned.welded_vertices = 1;
    e.cleaned.flipped_faces = 2;
    e.result.faces = 8;
    e.result.triangles.min_angle = std::numbers::pi / 6;
    e.result.triangles.regular_share = 0.75;
    e.topology_kept = true;
    e.distance = {.from_original = {.mean = 1, .rms = 2, .max = 3},
                  .from_result = {.mean = 0, .rms = 1, .max = 4},
                  .diagonal = 50,
                  .samples = 1000,
                  .flipped_faces = 2};
    e.features = {.length = 20,
                  .covered = 0.75,
                  .covered_closely = 0.5,
                  .result_length = 10,
                  .false_share = 0.25,
                  .corners = 8,
                  .corners_kept = 7,
                  .acute_corners = 3,
                  .min_angle_elsewhere = std::numbers::pi / 9,
                  .diagonal = 5};
    e.has_creases = true;
    return e;
}

// The keys of an object and of those inside it, as paths.
void add_keys(const json& object, const std::string& path, std::vector<std::string>& keys) {
    for (const auto& [key, value] : object.items()) {
        keys.push_back(path + key);
        if (value.is_object()) add_keys(value, path + key + '/', keys);
    }
}

std::vector<std::string> keys_of(const std::string& text) {
    std::vector<std::string> keys;
    add_keys(json::parse(text), "", keys);
    return keys;
}

}  // namespace

TEST(EvaluationReport, GivesEveryFigureInTheUnitOfItsKey) {
    const json report = json::parse(
        remesh::to_json(example_evaluation(),
                        {.version = "1.2", .original_path = "a.ply", .result_path = "b.ply"}));
    EXPECT_EQ(report["program"], "remesh-eval");
    EXPECT_EQ(report["version"], "1.2");
    EXPECT_EQ(report["original_path"], "a.ply");
    EXPECT_EQ(report["result_path"], "b.ply");
    EXPECT_EQ(report["original_repair"]["welded_vertices"], 1);
    EXPECT_EQ(report["original"]["vertices"], 10);
    EXPECT_EQ(report["original"]["components"][0]["area_square_mesh_units"], 2.5);
    EXPECT_EQ(report["original"]["self_intersecting_pairs"], 1);
    EXPECT_EQ(report["original"]["self_intersecting_faces"][0], (json{3, 7}));
    EXPECT_NEAR(report["result"]["min_angle_deg"], 30, 1e-12);
    EXPECT_EQ(report["result"]["valence_6_percent"], 75);
    EXPECT_EQ(report["result"]["self_intersecting_pairs"], nullptr) << "not measured";
    EXPECT_EQ(report["topology_kept"], true);
    EXPECT_EQ(report["distance"]["original_to_result"]["max_percent_of_diagonal"], 6);
    EXPECT_EQ(report["distance"]["result_to_original"]["rms_percent_of_diagonal"], 2);
    EXPECT_EQ(report["distance"]["two_sided"]["mean_percent_of_diagonal"], 2);
    EXPECT_EQ(report["distance"]["two_sided"]["max_percent_of_diagonal"], 8);
    EXPECT_EQ(report["distance"]["original_diagonal_mesh_units"], 50);
    EXPECT_EQ(report["flipped_normals"], 2);
    EXPECT_EQ(report["flipped_normals_percent"], 25);
    EXPECT_EQ(report["features"]["original_length_mesh_units"], 20);
    EXPECT_EQ(report["features"]["covered_percent"], 75);
    EXPECT_EQ(report["features"]["covered_closely_percent"], 50);
    EXPECT_EQ(report["features"]["result_length_mesh_units"], 10);
    EXPECT_EQ(report["features"]["false_percent"], 25);
    EXPECT_EQ(report["features"]["corners"], 8);
    EXPECT_EQ(report["features"]["corners_kept"], 7);
    EXPECT_EQ(report["features"]["acute_corners"], 3);
    EXPECT_NEAR(report["features"]["min_angle_off_acute_corners_deg"], 20, 1e-12);
}

TEST(EvaluationReport, FeaturesAreThereWhereTheOriginalHasAny) {
    EXPECT_NE(
        remesh::to_text(example_evaluation()).find("covered within .1 % (%)              75.00"),
        std::string::npos)
        << remesh::to_text(example_evaluation());
    remesh::Evaluation e = example_evaluation();
    e.features->length = 0;
    json report = json::parse(remesh::to_json(e));
    EXPECT_EQ(report["features"]["covered_percent"], nullptr);
    EXPECT_EQ(report["features"]["corners"], 8);
    EXPECT_EQ(remesh::to_text(e).find("covered"), std::string::npos);
    e.has_creases = false;
    for (const char* word : {"sharp", "corners", "smallest angle elsewhere"}) {
        EXPECT_EQ(remesh::to_text(e).find(word), std::string::npos) << "sharp edges are noise";
    }
    e.original.topology.components[0].boundary_loops = 1;
    EXPECT_NE(remesh::to_text(e).find("corners, corners kept"), std::string::npos);
    e.features.reset();
    report = json::parse(remesh::to_json(e));
    EXPECT_EQ(report["features"]["corners"], nullptr);
    EXPECT_EQ(keys_of(remesh::to_json(e)), keys_of(remesh::to_json(example_evaluation())));
    EXPECT_EQ(remesh::to_text(e).find("sharp"), std::string::npos);
}

TEST(EvaluationReport, AllKeysAreDocumentedAndNoOthers) {
    remesh::Evaluation e = example_evaluation();
    e.result = e.original;
    report_keys::expect_documented(remesh::to_json(e), {"remesh-eval", "What reports share"});
}

TEST(EvaluationReport, HasTheSameKeysWhateverWasMeasured) {
    const std::string all = remesh::to_json(example_evaluation());
    remesh::Evaluation bare = example_evaluation();
    bare.distance.reset();
    bare.original.self_intersections.reset();
    const std::string some = remesh::to_json(bare);
    EXPECT_EQ(keys_of(all), keys_of(some));
    const json report = json::parse(some);
    EXPECT_EQ(report["distance"]["two_sided"]["max_percent_of_diagonal"], nullptr);
    EXPECT_EQ(report["flipped_normals"], nullptr);
    EXPECT_EQ(report["original_path"], nullptr);
}

TEST(EvaluationReport, NumbersThatAreNotFiniteAreNull) {
    remesh::Evaluation e = example_evaluation();
    e.result.triangles.mean_quality = std::numeric_limits<double>::infinity();
    e.distance->from_result.max = std::nan("");
    const json report = json::parse(remesh::to_json(e));
    EXPECT_EQ(report["result"]["mean_quality"], nullptr);
    EXPECT_EQ(report["distance"]["result_to_original"]["max_percent_of_diagonal"], nullptr);
}

TEST(EvaluationReport, PathsNeedNotBeUtf8) {
    const std::string text =
        remesh::to_json(example_evaluation(), {.original_path = "caf\xe9.ply"});
    EXPECT_EQ(json::parse(text)["original_path"], "caf\xef\xbf\xbd.ply");
}

TEST(EvaluationReport, TextNamesWhatNeedsCgal) {
    const std::string all = remesh::to_text(example_evaluation());
    EXPECT_NE(all.find("repaired: 1 welded vertex, 2 flipped faces"), std::string::npos) << all;
    EXPECT_NE(all.find("topology kept" + std::string(40, ' ') + "yes"), std::string::npos) << all;
    EXPECT_NE(all.find("two-sided (the larger)             2.00000       4.00000       8.00000"),
              std::string::npos)
        << all;
    remesh::Evaluation bare = example_evaluation();
    bare.distance.reset();
    EXPECT_NE(remesh::to_text(bare).find("distance: not measured"), std::string::npos);
}

TEST(RepairText, SaysWhenThereWasNothingToDo) {
    EXPECT_EQ(remesh::to_text(remesh::CleanCounts{}), "repaired: nothing");
    EXPECT_EQ(remesh::to_text(remesh::CleanCounts{.duplicate_faces = 1, .split_vertices = 2}),
              "repaired: 1 duplicate face, 2 split vertices");
}

TEST(ComparisonReport, GivesEveryFigureAsJsonAndText) {
    remesh::Comparison c{.sites = 30};
    c.difference.cell_radius = 2;
    c.difference.frechet = {.sum = 4,
                            .largest = 1,
                            .delta = 0.0198,
                            .unit = 2,
                            .spacing = 0.02,
                            .matched_loops = 29,
                            .unmatched_loops = 1};
    c.difference.wrong_label_area = 0.125;
    c.difference.hausdorff = std::numeric_limits<double>::infinity();
    c.bisectors_a = agvd::BisectorError{.mean = 0.5, .p95 = 0.75, .max = 1.5, .num_points = 7};
    const json report = json::parse(remesh::to_json(c, {.a = "a.ply", .b = "exact"}));
    EXPECT_EQ(report["a"], "a.ply");
    EXPECT_EQ(report["sites"], 30);
    EXPECT_EQ(report["frechet"]["sum_mesh_units"], 4);
    EXPECT_EQ(report["frechet"]["unmatched_loops"], 1);
    EXPECT_EQ(report["wrong_label_percent"], 12.5);
    EXPECT_TRUE(report["hausdorff_mesh_units"].is_null());
    EXPECT_EQ(report["bisector_error_a"]["p95"], 0.75);
    EXPECT_EQ(report["bisector_error_a"]["points"], 7);
    EXPECT_TRUE(report["bisector_error_b"].is_null());
    const std::string text = to_text(c, {.a = "a.ply", .b = "exact"});
    for (const char* part :
         {"30 sites", "1.9800 %", "12.5000 %", "29 pairs", "1 loop unmatched", "not measured"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
    }
}

TEST(ComparisonReport, AllKeysAreDocumentedAndNoOthers) {
    remesh::Comparison c;
    c.bisectors_a = c.bisectors_b = agvd::BisectorError{};
    report_keys::expect_documented(remesh::to_json(c), {"agvd compare"});
}
