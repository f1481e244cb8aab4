// Texture coordinates through the program.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "remesh/meshfile/mesh_file.h"
#include "support/scratch.h"
#include "support/shapes.h"

using agvd::Index;

namespace {

class RemeshTexture : public Scratch {
protected:
    static constexpr const char* ring = AGVD_DATA_DIR "/ring.obj";

    [[nodiscard]] remesh::MeshFile result(const std::string& name,
                                          std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {ring, at(name), "-n", "600"});
        const auto outcome = run(REMESH_PROGRAM, arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return remesh::read_mesh(at(name), remesh::ReadOptions{.with_attributes = true});
    }

    [[nodiscard]] std::string warnings_of(const std::string& name) const {
        return run(REMESH_PROGRAM, {ring, at(name), "-n", "100"}).err;
    }
};

}  // namespace

TEST_F(RemeshTexture, IsCarriedOverAndNoFaceSpansASeam) {
    for (const char* name : {"out.obj", "out.ply", "out.glb"}) {
        const remesh::MeshFile file = result(name, {});
        const remesh::TextureCoordinates& texture = file.attributes.texture;
        ASSERT_EQ(texture.corners.size(), file.mesh.triangles.size()) << name;
        for (const remesh::CornerCoordinates& corners : texture.corners) {
            for (int axis = 0; axis < 2; ++axis) {
                const auto [low, high] =
                    std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
                EXPECT_LT(high - low, 0.3);
                EXPECT_GE(low, -1e-6);
                EXPECT_LE(high, 1 + 1e-6);
            }
        }
        EXPECT_GT(texture.seams.size(), 30u) << name;
    }
}

TEST_F(RemeshTexture, TheReportTellsOfSeams) {
    static_cast<void>(result("out.ply", {"--report", at("r.json")}));
    const auto report = nlohmann::json::parse(bytes("r.json"));
    EXPECT_EQ(report["attributes"]["carried"], nlohmann::json({"corner texcoord"}));
    EXPECT_EQ(report["options"]["texture_seam_edges"], 96);
    EXPECT_NEAR(report["features"]["texture_seam_length_mesh_units"], 11.3, 0.1);
    EXPECT_EQ(report["features"]["dropped_texture_seam_length_mesh_units"], 0);
    EXPECT_TRUE(report["warnings"].empty());
}

TEST_F(RemeshTexture, WithoutItThereAreNoSeams) {
    const remesh::MeshFile all = result("all.ply", {});
    const remesh::MeshFile named = result("named.ply", {"--transfer", "texcoord"});
    EXPECT_EQ(named.mesh.positions, all.mesh.positions);
    const remesh::MeshFile none = result("none.ply", {"--transfer", "none"});
    EXPECT_TRUE(none.attributes.texture.empty());
    EXPECT_NE(none.mesh.positions, all.mesh.positions);
    std::string bare;  // The same mesh without a texture.
    std::ifstream lines(ring);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("vt")) continue;
        for (std::size_t i = line.find('/'); i != std::string::npos; i = line.find('/')) {
            line.erase(i, line.find(' ', i) - i);
        }
        bare += line + '\n';
    }
    const auto outcome = run(REMESH_PROGRAM, {put("bare.obj", bare), at("bare.ply"), "-n", "600"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(bytes("bare.ply"), bytes("none.ply"));
}

TEST_F(RemeshTexture, FormatsThatCannotHoldItWarn) {
    EXPECT_NE(warnings_of("out.stl").find("warning: corner texcoord: .stl files have no place for "
                                          "texture coordinates with seams; write .ply"),
              std::string::npos);
    EXPECT_NE(warnings_of("out.vtk").find("corner texcoord: .vtk files have no place for texture"),
              std::string::npos);
    // What is not written makes no seams.
    const auto outcome =
        run(REMESH_PROGRAM, {ring, at("b.stl"), "-n", "100", "--transfer", "none"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(bytes("b.stl"), bytes("out.stl"));
}

TEST_F(RemeshTexture, SeamsThatAreTooCloseGiveAWarning) {
    const std::string err = warnings_of("out.ply");
    EXPECT_EQ(err.find("warning"), std::string::npos) << err;
    std::string charts;
    const agvd::TriangleMesh grid = shapes::grid(8);  // A chart for each triangle.
    for (const agvd::Vec3& p : grid.positions) {
        charts += "v " + std::to_string(p.x()) + ' ' + std::to_string(p.y()) + " 0\n";
    }
    for (agvd::Index f = 0; f < grid.triangles.size(); ++f) {
        const std::string chart = std::to_string(f);
        charts += "vt " + chart + " 0\nvt " + chart + ".5 0\nvt " + chart + " .5\nf";
        for (agvd::Index k = 0; k < 3; ++k) {
            charts += ' ' + std::to_string(grid.triangles[f][k] + 1) + '/' +
                      std::to_string(3 * f + k + 1);
        }
        charts += '\n';
    }
    const std::string input = put("charts.obj", charts);
    const auto outcome = run(REMESH_PROGRAM, {input, at("charts.ply"), "-n", "60"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("warning: 100 % of the seams of texture coordinates"),
              std::string::npos)
        << outcome.err;
    const remesh::MeshFile file =
        remesh::read_mesh(at("charts.ply"), remesh::ReadOptions{.with_attributes = true});
    for (const remesh::CornerCoordinates& corners : file.attributes.texture.corners) {
        EXPECT_EQ(std::floor(corners[0].x()), std::floor(corners[1].x()));
        EXPECT_EQ(std::floor(corners[0].x()), std::floor(corners[2].x()));
    }
}

TEST_F(RemeshTexture, FacesOutsideARegionKeepTheirBits) {
    remesh::MeshFile given = remesh::read_mesh(ring, remesh::ReadOptions{.with_attributes = true});
    given.attributes.texture.type = remesh::NumberType::Float64;
    for (remesh::CornerCoordinates& corners : given.attributes.texture.corners) {
        for (agvd::Vec2& corner : corners) corner /= 3;  // No float.
    }
    remesh::Attribute mark{"mark", remesh::NumberType::UInt8};
    for (const agvd::Triangle& t : given.mesh.triangles) {
        mark.values.push_back(given.mesh.positions[t[0]].x() > 0 ? 1 : 0);
    }
    given.attributes.of_faces = {mark};
    const std::string input =
        put("in.ply", remesh::format_mesh("in.ply", given.mesh.view(), given.attributes));
    const auto outcome =
        run(REMESH_PROGRAM, {input, at("out.ply"), "-n", "500", "--region", "mark"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const remesh::MeshFile file =
        remesh::read_mesh(at("out.ply"), remesh::ReadOptions{.with_attributes = true});
    const auto& made = file.attributes.texture.corners;
    std::size_t kept = 0;
    for (std::size_t f = 0; f < mark.values.size(); ++f) {
        if (mark.values[f] != 0) continue;
        ASSERT_EQ(made[kept], given.attributes.texture.corners[f]) << f;
        ++kept;
    }
    ASSERT_GT(kept, 1000u);
    ASSERT_GT(made.size(), kept + 500);
    for (std::size_t f = kept; f < made.size(); ++f) {
        for (int axis = 0; axis < 2; ++axis) {
            const auto [low, high] =
                std::minmax({made[f][0][axis], made[f][1][axis], made[f][2][axis]});
            EXPECT_LT(high - low, 0.1);
        }
    }
}
