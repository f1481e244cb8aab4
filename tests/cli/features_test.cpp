// The options of `remesh` for features, and what it reports of them.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "remesh/meshfile/mesh_file.h"
#include "support/crease_checks.h"
#include "support/junction_shapes.h"
#include "support/parts.h"
#include "support/scratch.h"

namespace {

class RemeshFeatures : public Scratch {
protected:
    // The report of a run, with 300 samples unless told, and the mesh in out.ply. A prism's walls
    // meet at 60 and 90 degrees.
    [[nodiscard]] nlohmann::json report(const std::vector<std::string>& options) {
        const std::string in = put("in.ply", parts::hexagonal_prism(4));
        std::vector<std::string> arguments{in, at("out.ply"), "--report", "-"};
        const auto has = [&](const char* option) {
            return std::find(options.begin(), options.end(), option) != options.end();
        };
        if (!has("-n") && !has("--sites")) {
            arguments.insert(arguments.end(), {"-n", "300"});
        }
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto outcome = run(REMESH_PROGRAM, arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out);
    }
};

TEST_F(RemeshFeatures, CreasesAreKeptUnlessTheyAreNotWanted) {
    const nlohmann::json by_default = report({});
    const std::string mesh = bytes("out.ply");
    EXPECT_EQ(by_default["features"]["curves"], 18);
    EXPECT_EQ(crease_checks::coverage(parts::hexagonal_prism(4),
                                      remesh::read_mesh(at("out.ply")).mesh, 1e-6),
              1);
    EXPECT_EQ(report({"--features", "auto"})["features"], by_default["features"]);
    EXPECT_EQ(bytes("out.ply"), mesh);
    EXPECT_EQ(report({"--features", "off"})["features"]["curves"], 0);
    const std::string without = bytes("out.ply");
    EXPECT_NE(without, mesh);
    EXPECT_EQ(report({"--no-features"})["options"]["features"], "off");
    EXPECT_EQ(bytes("out.ply"), without);
}

TEST_F(RemeshFeatures, AnAngleTellsWhatACreaseIs) {
    for (const char* option : {"--features", "--crease"}) {
        EXPECT_EQ(report({option, "40"})["features"]["curves"], 18);
        const nlohmann::json steep = report({option, "72.5"});
        EXPECT_EQ(steep["features"]["curves"], 12);
        EXPECT_EQ(steep["options"]["features"], "angle");
        EXPECT_EQ(steep["options"]["feature_angle_degrees"], 72.5);
        EXPECT_EQ(report({option, "100"})["features"]["curves"], 0);
    }
}

TEST_F(RemeshFeatures, TheReportTellsTheNetwork) {
    const nlohmann::json features = report({})["features"];
    EXPECT_EQ(features["nodes"], 12);
    EXPECT_EQ(features["samples_for_all"], 12);
    EXPECT_NEAR(features["crease_length_mesh_units"], 18, 1e-5);
    EXPECT_NEAR(features["dropped_crease_length_mesh_units"], 0, 1e-12);
    EXPECT_EQ(features["gave_up"], false);
    EXPECT_GT(features["vertices"], 60);
    EXPECT_LT(features["vertices"], 200);
    const nlohmann::json few = report({"--features", "40", "-n", "11"})["features"];
    EXPECT_GT(few["dropped_crease_length_mesh_units"], 0.9);
    EXPECT_EQ(few["samples_for_all"], 12);
}

TEST_F(RemeshFeatures, CreasesThatGivenSitesDoNotCarryAreTold) {
    std::string corners, others;
    const agvd::TriangleMesh prism = parts::hexagonal_prism(4);
    for (std::size_t v = 0; v < prism.positions.size(); ++v) {
        corners += "v " + std::to_string(v) + '\n';
    }
    for (std::size_t f = 0; f < prism.triangles.size(); ++f) {
        others += "f " + std::to_string(f) + " .5 .25 .25\n";
    }
    put("vertices.txt", corners);
    put("inside.txt", others);
    const nlohmann::json on = report({"--sites", at("vertices.txt"), "--keep-sites"});
    EXPECT_EQ(on["output_vertices"], prism.positions.size());
    EXPECT_EQ(on["features"]["curves"], 18);
    EXPECT_EQ(on["features"]["curves_off_given_sites"], 0);
    const nlohmann::json off = report({"--sites", at("inside.txt"), "--keep-sites"});
    EXPECT_EQ(off["features"]["curves"], 0);
    EXPECT_EQ(off["features"]["curves_off_given_sites"], 18);
    EXPECT_NEAR(off["features"]["dropped_crease_length_mesh_units"], 18, 1e-5);
    const auto outcome = run(
        REMESH_PROGRAM, {at("in.ply"), at("out.ply"), "--sites", at("inside.txt"), "--keep-sites"});
    EXPECT_NE(outcome.err.find("too few of the given sites lie on 18 creases"), std::string::npos)
        << outcome.err;
}

TEST_F(RemeshFeatures, JunctionsAreApartUnlessTheyAreToBeKept) {
    const auto report_of_tee = [&](const std::vector<std::string>& options) {
        const std::string in = put("tee.ply", shapes::tee().mesh);
        std::vector<std::string> arguments{in, at("out.ply"), "--report", "-", "-n", "200"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto outcome = run(REMESH_PROGRAM, arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return std::pair(nlohmann::json::parse(outcome.out), outcome.err);
    };
    const auto [by_default, text] = report_of_tee({});
    const std::string apart = bytes("out.ply");
    EXPECT_EQ(by_default["options"]["junctions"], "apart");
    EXPECT_EQ(by_default["output_vertices"], 200);
    EXPECT_EQ(by_default["junctions"]["input_edges"], 8);
    EXPECT_EQ(by_default["junctions"]["curves"], 1);
    EXPECT_EQ(by_default["junctions"]["edges_without_common_points"], 0);
    EXPECT_EQ(by_default["junctions"]["welded_edges"], 0);
    EXPECT_NE(text.find("8 edges where sheets meet; the sheets have the same points"),
              std::string::npos);
    EXPECT_EQ(report_of_tee({"--junctions", "apart"}).first["junctions"], by_default["junctions"]);
    EXPECT_EQ(bytes("out.ply"), apart);
    const nlohmann::json kept = report_of_tee({"--junctions", "keep"}).first;
    EXPECT_NE(bytes("out.ply"), apart);
    EXPECT_EQ(kept["options"]["junctions"], "keep");
    EXPECT_EQ(kept["output_vertices"], 200);
    EXPECT_EQ(kept["junctions"]["welded_edges"], kept["junctions"]["vertices"].get<int>() - 1);
    const auto [free, warned] = report_of_tee({"--junctions", "keep", "--boundary", "free"});
    EXPECT_EQ(free["junctions"]["edges_without_common_points"], 8);
    EXPECT_NE(warned.find("warning: the sheets at 8 non-manifold edges"), std::string::npos)
        << warned;
}

TEST_F(RemeshFeatures, WrongValuesAreTwo) {
    const std::string in = put("in.ply", parts::hexagonal_prism(4));
    for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
             {"--features", "maybe"},
             {"--features", ""},
             {"--features", "0"},
             {"--features", "180"},
             {"--features", "-40"},
             {"--features", "nan"},
             {"--features", "40deg"},
             {"--crease", "on"},
             {"--junctions", "weld"},
             {"--junctions"},
             {"--features"},
             {"--no-features", "--features", "auto"},
             {"--no-features", "--crease", "40"},
         }) {
        std::vector<std::string> arguments{in, at("out.ply"), "-n", "50"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto outcome = run(REMESH_PROGRAM, arguments);
        EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(options) << outcome.err;
        EXPECT_NE(outcome.err, "");
        EXPECT_EQ(outcome.out, "");
    }
    EXPECT_EQ(num_files(), 1u);
}

TEST_F(RemeshFeatures, EdgesComeFromAFile) {
    put("edges.txt", "# both ends\n0 1  # an edge\n\n");
    const auto given = report({"--features", "off", "--feature-edges", at("edges.txt")});
    EXPECT_EQ(given["options"]["given_feature_edges"], 1);
    EXPECT_GT(given["features"]["crease_length_mesh_units"], 0);

    const std::string in = put("in.ply", parts::hexagonal_prism(4));
    for (const auto& [text, code, complaint] : {std::tuple("0 1 2\n", 3, "edges.txt: line 1"),
                                                {"0\n", 3, "edges.txt: line 1"},
                                                {"0 -1\n", 3, "edges.txt: line 1"},
                                                {"", 3, "is empty"},
                                                {"# none\n", 3, "holds no edge"},
                                                {"a b\n", 3, "edges.txt: line 1"},
                                                {"0 0\n", 4, "vertices 0 and 0"},
                                                {"0 99999999999999999999\n", 4, "too large"},
                                                {"0 4000000\n", 4, "vertices 0 and 4000000"}}) {
        put("edges.txt", text);
        const auto outcome = run(
            REMESH_PROGRAM, {in, at("bad.ply"), "-n", "300", "--feature-edges", at("edges.txt")});
        EXPECT_EQ(outcome.exit_code, code) << text << outcome.err;
        EXPECT_NE(outcome.err.find(complaint), std::string::npos) << text << outcome.err;
    }
}

}  // namespace
