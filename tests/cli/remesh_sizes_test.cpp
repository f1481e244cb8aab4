// The program `remesh`: numbers of vertices, lengths and distances.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "cli/remesh_program.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/shapes.h"

namespace {

TEST_F(Remesh, TheNumberOfVerticesIsGivenInManyWays) {
    const std::string in = put("in.off", shapes::sphere(4));  // 2562 vertices.
    const auto report_with = [&](std::vector<std::string> extra) {
        extra.insert(extra.begin(), {in, at("out.off"), "-q", "--relax", "10", "--report", "-"});
        const auto outcome = remesh(extra);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out);
    };
    EXPECT_EQ(report_with({"-n", "2e2"})["output_vertices"], 200);
    EXPECT_EQ(report_with({"-n", "10%"})["output_vertices"], 256);
    EXPECT_EQ(report_with({"--faces", "400"})["output_faces"], 400);
    for (const char* option : {"--edge-length", "--hsiz"}) {
        const auto report = report_with({option, "5%"});
        const double length = 0.05 * 2 * std::sqrt(3.);  // The box of the sphere is a cube.
        EXPECT_NEAR(report["options"]["sizing"]["edge_length_mesh_units"], length, 1e-3);
        EXPECT_NEAR(report["sizing"]["mean_edge_mesh_units"].get<double>() / length, 1, 0.02);
        EXPECT_EQ(report["sizing"]["samples"], report["output_vertices"]);
        EXPECT_TRUE(report["sizing"]["least_target_mesh_units"].is_null());
    }
    EXPECT_NEAR(report_with({"--edge-length", ".2"})["sizing"]["mean_edge_mesh_units"], 0.2, 0.004);
}

TEST_F(Remesh, AdaptiveEdgesKeepTheirBounds) {
    const std::string in = put("in.off", shapes::torus(80, 40));
    const auto outcome = remesh({in, at("out.off"), "-n", "500", "--adaptive", "--hmin", ".1",
                                 "--hmax", "6%", "--hgrad", "1.2", "--report", "-"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["output_vertices"], 500);
    EXPECT_EQ(report["options"]["sizing"]["adaptive"], true);
    EXPECT_EQ(report["options"]["sizing"]["gradation"], 1.2);
    EXPECT_EQ(report["options"]["sizing"]["min_edge_mesh_units"], 0.1);
    EXPECT_GE(report["sizing"]["least_target_mesh_units"], 0.099);
    EXPECT_LE(report["sizing"]["largest_target_mesh_units"],
              1.01 * report["options"]["sizing"]["max_edge_mesh_units"].get<double>());
    EXPECT_NE(outcome.err.find("targets from "), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
    const auto narrow = remesh({in, at("out.off"), "-n", "500", "--adaptive", "--hmax", ".05"});
    EXPECT_EQ(narrow.exit_code, 0) << narrow.err;
    EXPECT_NE(narrow.err.find("too few for --max-edge"), std::string::npos) << narrow.err;
    const auto wide = remesh({in, at("out.off"), "-n", "500", "--adaptive", "--hmin", ".5"});
    EXPECT_EQ(wide.exit_code, 0) << wide.err;
    EXPECT_NE(wide.err.find("too many for --min-edge"), std::string::npos) << wide.err;
}

TEST_F(Remesh, ADistanceIsKeptOrTheReasonTold) {
    const std::string in = put("in.off", shapes::sphere(4));
    const auto outcome = remesh({in, at("out.off"), "--max-distance", ".5%", "--report", "-"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(outcome.out);
    const double limit = report["options"]["sizing"]["max_distance_mesh_units"];
    EXPECT_NEAR(limit, 0.005 * 2 * std::sqrt(3.), 1e-4);
    EXPECT_LE(report["sizing"]["largest_distance_mesh_units"], limit);
    EXPECT_GT(report["sizing"]["largest_distance_mesh_units"], limit / 4);
    EXPECT_LE(report["verdict"]["largest_distance_mesh_units"], limit);
    put("old.off", "old");
    const auto refused = remesh({in, at("old.off"), "--hausd", "1e-13"});
    EXPECT_EQ(refused.exit_code, 2) << refused.err;
    EXPECT_NE(refused.err.find("use longer ones"), std::string::npos) << refused.err;
    EXPECT_EQ(bytes("old.off"), "old");
}

TEST_F(Remesh, BoundsAreKeptOrTheWorstTriangleIsNamed) {
    const std::string in = put("in.off", shapes::sphere(4));
    const auto outcome = remesh({in, at("out.off"), "-n", "200", "--longest-edge", "5%",
                                 "--min-angle", "30", "--max-angle", "95", "--report", "-"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(outcome.out);
    const auto& bounds = report["options"]["bounds"];
    const double length = bounds["longest_edge_mesh_units"];
    EXPECT_NEAR(length, 0.05 * 2 * std::sqrt(3.), 1e-3);
    EXPECT_EQ(bounds["min_angle_deg"], 30);
    EXPECT_EQ(bounds["max_angle_deg"], 95);
    EXPECT_TRUE(report["forced_faces"].empty());
    EXPECT_GE(report["verdict"]["min_angle_deg"], 30);
    EXPECT_GT(report["output_vertices"], 700);
    EXPECT_LT(report["output_vertices"], 1000);
    const remesh::MeshFile out = remesh::read_mesh(at("out.off"));
    double longest = 0;
    for (const agvd::Triangle& t : out.mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            longest = std::max(
                longest, (out.mesh.positions[t[k]] - out.mesh.positions[t[(k + 1) % 3]]).norm());
        }
    }
    EXPECT_LE(longest, length);
    EXPECT_GT(longest, 0.9 * length);
    put("old.off", "old");
    const auto refused =
        remesh({in, at("old.off"), "-n", "200", "--relax", "0", "--min-angle", "30"});
    EXPECT_EQ(refused.exit_code, 5) << refused.err;
    EXPECT_NE(refused.err.find("the smallest angle asked for is 30, and "), std::string::npos);
    EXPECT_EQ(bytes("old.off"), "old");
    EXPECT_EQ(remesh({in, at("old.off"), "--min-angle", "31"}).exit_code, 2);
    EXPECT_EQ(remesh({in, at("old.off"), "--max-angle", "80"}).exit_code, 2);
}

// Edges of .2 on one half of a plate, of .05 on the other.
TEST_F(Remesh, PropertiesOfVerticesGiveLengthsAndDensities) {
    const agvd::TriangleMesh plate = shapes::grid(20);
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << plate.positions.size()
         << "\nproperty double x\nproperty double y\nproperty double z\nproperty float size\n"
         << "property float weight\nelement face " << plate.triangles.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const agvd::Vec3& p : plate.positions) {
        const bool is_fine = p.x() > 0.5;
        text << p.x() << ' ' << p.y() << ' ' << p.z() << (is_fine ? " .05 16\n" : " .2 1\n");
    }
    for (const auto& [a, b, c] : plate.triangles) text << "3 " << a << ' ' << b << ' ' << c << '\n';
    const std::string in = put("in.ply", text.str());
    const auto share_of_fine = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{in, at("out.off")};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto outcome = remesh(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const auto result = remesh::read_mesh(at("out.off")).mesh;
        const auto fine = std::count_if(result.positions.begin(), result.positions.end(),
                                        [](const agvd::Vec3& p) { return p.x() > 0.5; });
        return std::pair(static_cast<double>(fine) / static_cast<double>(result.positions.size()),
                         result.positions.size());
    };
    // Half the area holds 230 vertices and, but for the transition, the other 15.
    const auto [share, count] = share_of_fine({"--sizing", "size"});
    EXPECT_GT(share, 0.7);
    EXPECT_GT(count, 200u);
    EXPECT_LT(count, 450u);
    const auto [scaled_share, scaled_count] = share_of_fine({"--sizing", "size", "-n", "100"});
    EXPECT_GT(scaled_share, 0.6);
    EXPECT_EQ(scaled_count, 100u);
    EXPECT_GT(share_of_fine({"--density", "weight", "-n", "300"}).first, 0.7);
    EXPECT_NEAR(share_of_fine({"-n", "300"}).first, 0.5, 0.05);
    const auto unknown = remesh({in, at("out.off"), "--sizing", "nothing"});
    EXPECT_EQ(unknown.exit_code, 2) << unknown.err;
    EXPECT_NE(unknown.err.find("size"), std::string::npos) << unknown.err;
    EXPECT_NE(unknown.err.find("in.ply has no vertex property"), std::string::npos) << unknown.err;
}

// A cube of two triangles a side: top and bottom of steel, the rest of wood.
TEST_F(Remesh, LabelsGiveLengthsOfEdges) {
    const agvd::TriangleMesh cube = shapes::cube();
    std::ostringstream text;
    for (const agvd::Vec3& p : cube.positions)
        text << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    for (const auto& [a, b, c] : cube.triangles) {
        const double z = cube.positions[a].z();
        const bool is_flat = cube.positions[b].z() == z && cube.positions[c].z() == z;
        text << (is_flat ? "usemtl steel\n" : "usemtl wood\n");
        text << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
    }
    const std::string in = put("in.obj", text.str());
    struct MeanEdge {
        double flat = 0, middle = 0;  // On top; on the sides, half way up.
        std::size_t num_vertices = 0;
    };
    const auto mean_edge = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {in, at("out.off")});
        const auto outcome = remesh(options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const agvd::TriangleMesh result = remesh::read_mesh(at("out.off")).mesh;
        std::vector<double> flat, middle;
        for (const agvd::Triangle& t : result.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const agvd::Vec3 &a = result.positions[t[k]], &b = result.positions[t[(k + 1) % 3]];
                const double level = (a.z() + b.z()) / 2;
                if (std::abs(level - 1) < 1e-9) flat.push_back((a - b).norm());
                if (std::abs(level - 0.5) < 0.15) middle.push_back((a - b).norm());
            }
        }
        const auto mean = [](const std::vector<double>& lengths) {
            return std::accumulate(lengths.begin(), lengths.end(), 0.) /
                   static_cast<double>(lengths.size());
        };
        return MeanEdge{mean(flat), mean(middle), result.positions.size()};
    };
    const MeanEdge two = mean_edge({"--edge-length-of", "material=steel:.05", "--edge-length-of",
                                    "material=wood:.2", "--gradation", "2"});
    EXPECT_NEAR(two.flat, 0.05, 0.01);
    EXPECT_GT(two.middle, 0.12);
    const MeanEdge rest = mean_edge(
        {"--edge-length-of", "material=steel:.05", "--edge-length", ".2", "--gradation", "2"});
    EXPECT_EQ(rest.num_vertices, two.num_vertices);
    // Only relative to each other: with percentages as well.
    const MeanEdge few = mean_edge({"-n", "400", "--edge-length-of", "material=*:4%",
                                    "--edge-length-of", "material=steel:1%", "--gradation", "2"});
    EXPECT_EQ(few.num_vertices, 400u);
    EXPECT_GT(few.middle, 2 * few.flat);
    const auto refused = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {in, at("never.off")});
        const auto outcome = remesh(options);
        EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
        return outcome.err;
    };
    EXPECT_NE(refused({"--edge-length-of", "material=tin:.1"}).find("has material 'tin'; use "),
              std::string::npos);
    EXPECT_NE(
        refused({"--edge-length-of", "kind=tin:.1"}).find("no face property 'kind'; use material"),
        std::string::npos);
    EXPECT_NE(refused({"--edge-length-of", "material=steel:.1"})
                  .find("by --edge-length, or by the value *"),
              std::string::npos);
    for (const char* wrong :
         {"steel:.1", "material=steel", "material=:1", "=steel:1", "material=steel:0"}) {
        EXPECT_NE(refused({"--edge-length-of", wrong}).find("use NAME=VALUE:LENGTH"),
                  std::string::npos)
            << wrong;
    }
}

TEST_F(Remesh, EdgesAreShortAtPlacesOfAFile) {
    const agvd::TriangleMesh ball = shapes::sphere(4);
    const std::string in = put("in.off", ball);
    const auto& [a, b, c] = ball.triangles[100];
    const std::string line = "l " + std::to_string(a) + " " + std::to_string(b);
    const std::string places = put("a:b.txt", "p 0 0 1\nr 3 4  # a region\n" + line + "\n");
    const auto counts = [&](const std::string& value) {
        const auto outcome =
            remesh({in, at("out.off"), "-n", "1500", "--size-at", value, "--report", "-"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
        const auto report = nlohmann::json::parse(outcome.out);
        EXPECT_EQ(report["options"]["sizing"]["given_places"], 1);
        EXPECT_EQ(report["output_vertices"], 1500);
        EXPECT_NEAR(report["sizing"]["least_target_mesh_units"], 0.04, 0.002);
        const auto near_pole = [](const agvd::Vec3& p) { return p.z() > std::cos(0.3); };
        return std::ranges::count_if(remesh::read_mesh(at("out.off")).mesh.positions, near_pole);
    };
    const auto at_point = counts(places + ":0.04"), around = counts(places + ":0.04:0.3");
    EXPECT_GT(at_point, 20);
    EXPECT_GT(around, 3 * at_point / 2);
    const auto few = remesh({in, at("out.off"), "-n", "100", "--size-at", places + ":0.01"});
    EXPECT_NE(few.err.find("100 vertices are too few for --size-at"), std::string::npos) << few.err;
    for (const char* wrong :
         {"places.txt", ":1", "places.txt:", "places.txt:0", "places.txt:1:0"}) {
        const auto outcome = remesh({in, at("never.off"), "--size-at", wrong});
        EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
        EXPECT_NE(outcome.err.find("use FILE:LENGTH"), std::string::npos) << wrong << outcome.err;
    }
    EXPECT_EQ(remesh({in, at("never.off"), "--size-at", "nowhere.txt:1"}).exit_code, 3);
}

TEST_F(Remesh, WrongNumbersAndLengthsAreRefused) {
    const std::string in = put("in.off", shapes::sphere(2));
    const std::vector<std::string> wrong[] = {{"-n", "0"},
                                              {"-n", "1.5"},
                                              {"-n", "5e9"},
                                              {"-n", "-3"},
                                              {"-n", "ten"},
                                              {"-n", "0%"},
                                              {"--faces", "0"},
                                              {"--faces", "10%"},
                                              {"--edge-length", "0"},
                                              {"--edge-length", "nan"},
                                              {"--edge-length", "1mm"},
                                              {"--hmin", ".1"},
                                              {"--hgrad", "2"},
                                              {"--max-distance", "0"},
                                              {"-n", "100", "--max-distance", "1%"},
                                              {"--adaptive", "--sizing", "size"},
                                              {"--adaptive", "--hgrad", ".9"},
                                              {"-n", "100", "--faces", "100"},
                                              {"-n", "100", "--edge-length", ".1"},
                                              {"--faces", "100", "--edge-length", ".1"},
                                              {"--adaptive", "--hmin", "2", "--hmax", "1"}};
    for (std::vector<std::string> arguments : wrong) {
        const std::string first = arguments[0] + ' ' + arguments[1];
        arguments.insert(arguments.begin(), {in, at("never.off")});
        const auto outcome = remesh(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << first << outcome.err;
        EXPECT_NE(outcome.err, "");
    }
}

}  // namespace
