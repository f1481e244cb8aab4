// `remesh --levels` as a process: several results of one input.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/remesh_program.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/shapes.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

class RemeshLevels : public Remesh {
protected:
    [[nodiscard]] json report_at(const std::string& name) const { return json::parse(bytes(name)); }

    // The options in the reports of two levels.
    [[nodiscard]] std::pair<json, json> options_of_two(std::vector<std::string> arguments) const {
        for (const std::string& more : {at("o.ply"), std::string("--levels"), std::string("2"),
                                        std::string("--report"), at("r.json")}) {
            arguments.push_back(more);
        }
        const auto outcome = remesh(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const json reports = report_at("r.json");
        EXPECT_EQ(reports.size(), 2u);
        return {reports[0]["options"], reports[1]["options"]};
    }
};

TEST_F(RemeshLevels, EachIsTheResultOfARunAloneWithAQuarterOfTheVertices) {
    const std::string in = put("in.off", shapes::torus(30, 15));
    const auto outcome = remesh({in, at("o.v1.obj"), "-n", "402", "--levels", "3"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(num_files(), 4u);
    const char* const counts[] = {"402", "101", "25"};
    for (const int level : {0, 1, 2}) {
        EXPECT_EQ(remesh({in, at("alone.obj"), "-n", counts[level]}).exit_code, 0);
        EXPECT_TRUE(bytes("o.v1-" + std::to_string(level) + ".obj") == bytes("alone.obj")) << level;
    }
}

TEST_F(RemeshLevels, NumbersAndPercentagesCanBeGivenForEach) {
    const std::string in = put("in.off", shapes::sphere(3));  // 642 vertices.
    EXPECT_EQ(remesh({in, at("o"), "--to", "off", "--levels", "60,1e2,50%"}).exit_code, 0);
    std::vector<std::size_t> counts;
    for (const char* name : {"o-0", "o-1", "o-2"}) {
        counts.push_back(remesh::read_mesh(at(name), remesh::ReadOptions{.format = "off"})
                             .mesh.positions.size());
    }
    EXPECT_EQ(counts, (std::vector<std::size_t>{60, 100, 321}));
}

TEST_F(RemeshLevels, LengthsDoubleAndDistancesGrowFourfold) {
    const std::string in = put("in.off", shapes::sphere(3));
    const auto [edge, twice_edge] =
        options_of_two({in, "--edge-length", "0.3", "--adaptive", "--min-edge", "0.1"});
    EXPECT_EQ(edge["sizing"]["edge_length_mesh_units"], 0.3);
    EXPECT_EQ(twice_edge["sizing"]["edge_length_mesh_units"], 0.6);
    EXPECT_EQ(twice_edge["sizing"]["min_edge_mesh_units"], 0.2);
    const auto [near, far] = options_of_two({in, "--max-distance", "0.02"});
    EXPECT_EQ(far["sizing"]["max_distance_mesh_units"],
              4 * near["sizing"]["max_distance_mesh_units"].get<double>());
    const auto [many, few] = options_of_two({in, "--faces", "402"});
    EXPECT_EQ(many["sizing"]["faces"], 402);
    EXPECT_EQ(few["sizing"]["faces"], 101);
}

TEST_F(RemeshLevels, LengthsOfAPropertyDouble) {
    std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float "
        "y\nproperty float z\nproperty float h\nelement face 2\nproperty list uchar "
        "int vertex_indices\nend_header\n";
    for (const char* point : {"0 0 0", "1 0 0", "1 1 0", "0 1 0"}) {
        ply += point + std::string(" .05\n");
    }
    const std::string in = put("in.ply", ply + "3 0 1 2\n3 0 2 3\n");
    const auto [fine, coarse] = options_of_two({in, "--sizing", "h"});
    EXPECT_NEAR(fine["samples"].get<double>() / coarse["samples"].get<double>(), 4, 0.8);
}

TEST_F(RemeshLevels, MaterialsAndTextureCoordinatesAreInEach) {
    std::string obj;
    for (int y = 0; y <= 4; ++y) {
        for (int x = 0; x <= 4; ++x) {
            const std::string p = std::to_string(x) + ' ' + std::to_string(y);
            obj += "v " + p + " 0\nvt " + p + '\n';
        }
    }
    for (const int half : {0, 1}) {
        obj += half == 0 ? "usemtl steel\n" : "usemtl copper\n";
        for (int y = 0; y < 4; ++y) {
            for (int x = 2 * half; x < 2 * half + 2; ++x) {
                const int a = 5 * y + x + 1;
                obj += 'f';
                for (const int v : {a, a + 1, a + 6, a + 5}) {
                    obj += ' ' + std::to_string(v) + '/' + std::to_string(v);
                }
                obj += '\n';
            }
        }
    }
    EXPECT_EQ(remesh({put("in.obj", obj), at("o.obj"), "--levels", "200,50", "--keep-labels",
                      "--map", at("map.txt")})
                  .exit_code,
              0);
    for (const std::string level : {"0", "1"}) {
        const std::string text = bytes("o-" + level + ".obj");
        EXPECT_NE(text.find("usemtl steel"), std::string::npos);
        EXPECT_NE(text.find("usemtl copper"), std::string::npos);
        const remesh::MeshFile file = remesh::read_mesh(
            at("o-" + level + ".obj"), remesh::ReadOptions{.with_attributes = true});
        const std::string map = bytes("map-" + level + ".txt");
        EXPECT_EQ(static_cast<std::size_t>(std::count(map.begin(), map.end(), '\n')),
                  file.mesh.positions.size());
        const remesh::TextureCoordinates& texture = file.attributes.texture;
        ASSERT_EQ(texture.corners.size(), file.mesh.triangles.size());
        for (std::size_t face = 0; face < texture.corners.size(); ++face) {
            for (std::size_t k = 0; k < 3; ++k) {
                const agvd::Vec3& p = file.mesh.positions[file.mesh.triangles[face][k]];
                EXPECT_NEAR(texture.corners[face][k][0], p.x(), 1e-4);
                EXPECT_NEAR(texture.corners[face][k][1], p.y(), 1e-4);
            }
        }
    }
}

TEST_F(RemeshLevels, NothingIsWrittenWhereOneFailsAndItIsNamed) {
    const std::string in = put("in.off", shapes::torus(20, 10));
    put("o-0.off", "old");
    const auto outcome = remesh({in, at("o.off"), "--levels", "90,3", "--report", at("r.json")});
    EXPECT_EQ(outcome.exit_code, 5);
    const std::string told = in + ", for " + at("o-1.off") + ": 3 samples are too few";
    EXPECT_NE(outcome.err.find("error: " + told), std::string::npos) << outcome.err;
    EXPECT_EQ(bytes("o-0.off"), "old");
    EXPECT_EQ(num_files(), 3u);
    const json reports = report_at("r.json");
    ASSERT_EQ(reports.size(), 1u);
    EXPECT_EQ(reports[0]["exit_code"], 5);
}

TEST_F(RemeshLevels, ReportsHaveTheWarningsOfTheInputAndOfTheirLevel) {
    const std::string in =
        put("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 nan\nf 1/1 2/2 3/3\n");
    EXPECT_EQ(remesh({in, at("o.off"), "--levels", "9,6", "--report", at("r.json")}).exit_code, 0);
    for (const json& report : report_at("r.json")) EXPECT_EQ(report["warnings"].size(), 1u);
}

TEST_F(RemeshLevels, WrongUsageIsFoundBeforeAnyWork) {
    const std::string in = put("in.off", shapes::sphere(2)), out = at("o.off");
    put("o-1.off", "old");
    for (const std::vector<std::string>& wrong :
         std::vector<std::vector<std::string>>{{out, "--levels", "1"},
                                               {out, "--levels", "17"},
                                               {out, "--levels", "many"},
                                               {out, "--levels", "80,"},
                                               {out, "--levels", "80,0"},
                                               {out, "--levels", "80,20", "-n", "80"},
                                               {out, "--levels", "80,20", "--edge-length", "1%"},
                                               {out, "--levels", "80,20", "--faces", "80"},
                                               {out, "--levels", "80,20", "--max-distance", "1%"},
                                               {out, "--levels", "2", "--sites", in},
                                               {"-", "--to", "off", "--levels", "2"},
                                               {out, "--levels", "2", "--report", at("o-1.off")}}) {
        std::vector<std::string> arguments = wrong;
        arguments.insert(arguments.begin(), in);
        const auto outcome = remesh(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(wrong) << outcome.err;
    }
    EXPECT_EQ(remesh({in, out, "--levels", "2", "--no-clobber"}).exit_code, 3);
    EXPECT_EQ(num_files(), 2u);
    EXPECT_EQ(bytes("o-1.off"), "old");
}

TEST_F(RemeshLevels, OfManyMeshesGoToTheFolder) {
    const std::string a = put("a.off", shapes::sphere(2)), b = put("a-0.off", shapes::sphere(3));
    const auto refused = remesh({a, b, "--levels", "2", "--out-dir", at("")});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find(b + " would be overwritten"), std::string::npos) << refused.err;
    const auto outcome = remesh({a, at("none.off"), b, "--levels", "40,20", "--out-dir", at("out"),
                                 "--report", at("r.json")});
    EXPECT_EQ(outcome.exit_code, 6) << outcome.err;
    EXPECT_NE(outcome.err.find("2 done, 1 failed"), std::string::npos) << outcome.err;
    std::vector<std::string> outputs;
    for (const json& report : report_at("r.json")) outputs.push_back(report["output_path"]);
    EXPECT_EQ(outputs,
              (std::vector<std::string>{at("out/a-0.off"), at("out/a-1.off"), at("out/none-0.off"),
                                        at("out/a-0-0.off"), at("out/a-0-1.off")}));
    EXPECT_EQ(remesh::read_mesh(at("out/a-0-1.off")).mesh.positions.size(), 20u);
}

}  // namespace
