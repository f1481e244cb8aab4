// The options of `remesh` for colours, labels and other properties.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/xml_reader.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace fs = std::filesystem;
using agvd::Index;
using remesh::Attribute;
using remesh::NumberType;

namespace {

class RemeshAttributes : public Scratch {
protected:
    // A sphere with a colour and a height at vertices, and labels of four quarters.
    RemeshAttributes() {
        const agvd::TriangleMesh& mesh = sphere_;
        remesh::MeshAttributes attributes{.normals = NumberType::Float32};
        Attribute red{"red", NumberType::UInt8}, height{"height", NumberType::Float64};
        for (const agvd::Vec3& p : mesh.positions) {
            red.values.push_back(std::round(127.5 * (p.x() + 1)));
            height.values.push_back(p.z());
        }
        Attribute quarter{"quarter", NumberType::Int16};
        for (const auto& [a, b, c] : mesh.triangles) {
            const agvd::Vec3 p = mesh.positions[a] + mesh.positions[b] + mesh.positions[c];
            quarter.values.push_back(100 * (p.x() > 0 ? 1 : 0) + (p.y() > 0 ? 1 : 0));
        }
        attributes.of_vertices = {red, height};
        attributes.of_faces = {quarter};
        input_ = put("in.ply", remesh::format_mesh("in.ply", mesh.view(), attributes));
    }

    [[nodiscard]] process::Outcome remesh(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {input_, "-n", "500"});
        return run(REMESH_PROGRAM, std::move(arguments));
    }
    [[nodiscard]] remesh::MeshFile result(const std::vector<std::string>& arguments) const {
        const auto outcome = remesh(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return remesh::read_mesh(at("out.ply"), remesh::ReadOptions{.with_attributes = true});
    }

    agvd::TriangleMesh sphere_ = shapes::sphere(4);
    std::string input_;
};

}  // namespace

TEST_F(RemeshAttributes, AllAreCarriedOverByDefault) {
    const remesh::MeshFile file = result({at("out.ply")});
    const auto& vertices = file.attributes.of_vertices;
    ASSERT_EQ(vertices.size(), 2u);
    EXPECT_TRUE(file.attributes.normals.has_value());
    EXPECT_EQ(vertices[0].type, NumberType::UInt8);
    for (Index v = 0; v < 500; ++v) {
        const agvd::Vec3& p = file.mesh.positions[v];
        EXPECT_NEAR(vertices[0].values[v], 127.5 * (p.x() + 1), 3);
        EXPECT_NEAR(vertices[1].values[v], p.z(), 0.02);
    }
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].type, NumberType::Int16);
    int num_clear = 0;
    for (Index f = 0; f < file.mesh.triangles.size(); ++f) {
        const auto& [a, b, c] = file.mesh.triangles[f];
        const agvd::Vec3 p =
            (file.mesh.positions[a] + file.mesh.positions[b] + file.mesh.positions[c]) / 3;
        if (std::min(std::abs(p.x()), std::abs(p.y())) < 0.1) continue;
        ++num_clear;
        EXPECT_EQ(file.attributes.of_faces[0].values[f],
                  100 * (p.x() > 0 ? 1 : 0) + (p.y() > 0 ? 1 : 0));
    }
    EXPECT_GT(num_clear, 500);
}

TEST_F(RemeshAttributes, OnlyThoseNamedOrNone) {
    const remesh::MeshFile named = result({at("out.ply"), "--transfer", "quarter,height"});
    ASSERT_EQ(named.attributes.of_vertices.size(), 1u);
    EXPECT_EQ(named.attributes.of_vertices[0].name, "height");
    EXPECT_EQ(named.attributes.of_faces.size(), 1u);
    EXPECT_FALSE(named.attributes.normals.has_value());
    const remesh::MeshFile none = result({at("out.ply"), "--transfer", "none"});
    EXPECT_TRUE(none.attributes.empty());
    EXPECT_EQ(none.mesh.positions, named.mesh.positions);
    const auto wrong = remesh({at("no.ply"), "--transfer", "height,width"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_NE(wrong.err.find("no property 'width'; use red, height, quarter, normals"),
              std::string::npos)
        << wrong.err;
    EXPECT_FALSE(fs::exists(at("no.ply")));
}

TEST_F(RemeshAttributes, TheMapHasALineForEachVertex) {
    const remesh::MeshFile file = result({at("out.ply"), "--map", at("map.txt")});
    std::istringstream map(bytes("map.txt"));
    Index face = 0, num_lines = 0;
    for (double b0 = 0, b1 = 0, b2 = 0; map >> face >> b0 >> b1 >> b2; ++num_lines) {
        const auto& [a, b, c] = sphere_.triangles.at(face);
        const agvd::Vec3 place =
            b0 * sphere_.positions[a] + b1 * sphere_.positions[b] + b2 * sphere_.positions[c];
        EXPECT_NEAR((place - file.mesh.positions[num_lines]).norm(), 0, 0.02);
        EXPECT_NEAR(b0 + b1 + b2, 1, 1e-15);
    }
    EXPECT_EQ(num_lines, 500u);
    const std::string with_labels = bytes("out.ply");
    const auto again = remesh({at("again.ply"), "--transfer", "none", "--map", at("b.txt")});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(bytes("b.txt"), bytes("map.txt"));
}

TEST_F(RemeshAttributes, BordersOfLabelsBecomeEdges) {
    // Corners of faces that lie beyond the border of their label by more than an edge of the input.
    const auto num_beyond = [&](const std::vector<std::string>& arguments) {
        const remesh::MeshFile file = result(arguments);
        const auto& labels = file.attributes.of_faces.at(0).values;
        int count = 0;
        for (Index f = 0; f < file.mesh.triangles.size(); ++f) {
            for (const Index v : file.mesh.triangles[f]) {
                const agvd::Vec3& p = file.mesh.positions[v];
                const double x = labels[f] >= 100 ? p.x() : -p.x();
                const double y = std::fmod(labels[f], 100) > 0 ? p.y() : -p.y();
                if (std::min(x, y) < -0.1) ++count;
            }
        }
        return count;
    };
    // A border of labels runs to and fro around faces of the input, and the result cuts corners.
    EXPECT_LE(num_beyond({"--keep-labels", at("out.ply")}), 1);
    EXPECT_LE(num_beyond({"--keep-labels=quarter", at("out.ply")}), 1);
    EXPECT_GT(num_beyond({at("out.ply")}), 5);
    const auto wrong = remesh({at("no.ply"), "--keep-labels=height"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_NE(wrong.err.find("'height'; use quarter"), std::string::npos) << wrong.err;
    const std::string plain = put("plain.off", shapes::sphere(2));
    const auto none = run(REMESH_PROGRAM, {plain, at("no.ply"), "-n", "80", "--keep-labels"});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_NE(none.err.find("has no labels of faces"), std::string::npos) << none.err;
}

TEST_F(RemeshAttributes, TheReportNamesWhatWasCarriedAndWhatWasNot) {
    const auto outcome = remesh({at("out.obj"), "--report", "-"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(outcome.out)["attributes"];
    EXPECT_EQ(report["carried"], nlohmann::json::array({"vertex normals"}));
    EXPECT_EQ(report["declined"].size(), 3u);
    EXPECT_EQ(report["declined"][0]["name"], "vertex red");
    EXPECT_NE(outcome.err.find("warning: vertex red, vertex height, face quarter: .obj files"),
              std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("attributes carried over: vertex normals"), std::string::npos);
    const auto stl = remesh({at("out.stl"), "-q"});
    EXPECT_NE(stl.err.find("warning: "), std::string::npos) << stl.err;
    EXPECT_EQ(remesh({at("out.stl"), "-q", "--transfer", "none"}).err, "");
}

TEST_F(RemeshAttributes, TheMapIsNeitherInputNorAnotherOutput) {
    int num_refused = 0;
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{at("out.ply"), "--map", at("out.ply")},
          {at("out.ply"), "--map", input_},
          {at("out.ply"), "--map", at("r"), "--report", at("r")}}) {
        const auto outcome = remesh(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
        ++num_refused;
    }
    EXPECT_EQ(num_refused, 3);
    EXPECT_EQ(remesh({at("out.ply"), "--map", at("no folder/map")}).exit_code, 3);
    EXPECT_EQ(num_files(), 1u);  // The input.
}

TEST_F(RemeshAttributes, WhatIsLostNamesTheFormatThatKeepsIt) {
    const agvd::TriangleMesh& mesh = sphere_;
    remesh::MeshAttributes attributes{.materials = {.json = R"({"materials": [{"name": "red"}]})"}};
    attributes.of_faces.push_back({.name = "material",
                                   .values = std::vector<double>(mesh.triangles.size(), 0),
                                   .names = {"red"}});
    const std::string in = put("in.glb", remesh::format_mesh("in.glb", mesh.view(), attributes));
    const auto stl = run(REMESH_PROGRAM, {in, at("out.stl"), "-n", "100", "-q"});
    EXPECT_EQ(stl.exit_code, 0) << stl.err;
    for (const char* words :
         {"face material: .stl files have no place for it; write .obj",
          "material colours and images: .stl files have no place for it; write .glb",
          "the unit of the input is the meter, .stl files count in millimeters: numbers stay"}) {
        EXPECT_NE(stl.err.find(words), std::string::npos) << words << '\n' << stl.err;
    }
    const auto glb = run(REMESH_PROGRAM, {in, at("out.glb"), "-n", "100", "-q"});
    EXPECT_EQ(glb.err, "");
    const auto file =
        remesh::read_mesh(at("out.glb"), remesh::ReadOptions{.with_attributes = true});
    EXPECT_NE(file.attributes.materials.json.find("red"), std::string::npos);
}

TEST_F(RemeshAttributes, TheUnitStaysWithoutTransferToo) {
    const std::string in =
        put("in.3mf", remesh::format_mesh("in.3mf", sphere_.view(), {.unit = "inch"}));
    if (!remesh::knows_xml() || !remesh::knows_gzip()) GTEST_SKIP() << "without zlib or expat";
    const auto kept =
        run(REMESH_PROGRAM, {in, at("out.3mf"), "-n", "100", "-q", "--transfer", "none"});
    EXPECT_EQ(kept.err, "");
    EXPECT_EQ(remesh::read_mesh(at("out.3mf")).attributes.unit, "inch");
    const auto lost = run(REMESH_PROGRAM, {in, at("out.ply"), "-n", "100", "-q"});
    EXPECT_EQ(lost.exit_code, 0) << lost.err;
    EXPECT_NE(lost.err.find("the unit of the input is the inch"), std::string::npos) << lost.err;
}

TEST_F(RemeshAttributes, EdgesAndRequiredVerticesOfMeditAreKept) {
    std::string text = remesh::format_mesh("in.mesh", sphere_.view());
    const auto& [a, b, c] = sphere_.triangles[0];
    std::ostringstream lists;
    lists << "Edges 2 " << a + 1 << ' ' << b + 1 << " 0 " << b + 1 << ' ' << c + 1
          << " 0 RequiredVertices 1 101\n";
    text.insert(text.find("End"), lists.str());
    const std::string in = put("in.mesh", text);
    const auto run_with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {in,         at("out.ply"), "-n",     "200",
                                              "--report", at("r.json"),  "--force"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const auto outcome = run(REMESH_PROGRAM, arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.err;
    };
    const auto num_feature_edges = [&] {
        return nlohmann::json::parse(bytes("r.json"))["options"]["given_feature_edges"];
    };
    const auto has = [&](Index v) {
        const auto& positions = remesh::read_mesh(at("out.ply")).mesh.positions;
        return std::find(positions.begin(), positions.end(), sphere_.positions[v]) !=
               positions.end();
    };
    const std::string err = run_with({});
    EXPECT_NE(err.find("2 edges of the file are feature edges"), std::string::npos) << err;
    EXPECT_NE(err.find("1 vertices and 0 edges of the file are locked"), std::string::npos) << err;
    EXPECT_EQ(num_feature_edges(), 2);
    EXPECT_TRUE(has(100));
    EXPECT_TRUE(has(a) && has(c));
    run_with({"--features", "off"});
    EXPECT_EQ(num_feature_edges(), 0);
    EXPECT_TRUE(has(100));
}

TEST_F(RemeshAttributes, ThreadsDoNotChangeThem) {
    EXPECT_EQ(remesh({at("a.ply"), "-t", "1"}).exit_code, 0);
    EXPECT_EQ(remesh({at("b.ply"), "-t", "8"}).exit_code, 0);
    EXPECT_EQ(bytes("a.ply"), bytes("b.ply"));
}

TEST_F(RemeshAttributes, MaterialsOfObjAreKeptAndFoundFromAnotherFolder) {
    std::string text = "mtllib paints.mtl\n";
    for (const agvd::Vec3& p : sphere_.positions) {
        std::ostringstream line;
        line << "v " << p.transpose() << '\n';
        text += line.str();
    }
    for (const bool is_upper : {false, true}) {
        text += is_upper ? "usemtl sky\n" : "usemtl sea\n";
        for (const auto& [a, b, c] : sphere_.triangles) {
            const double z =
                sphere_.positions[a].z() + sphere_.positions[b].z() + sphere_.positions[c].z();
            if ((z > 0) != is_upper) continue;
            text += "f " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + ' ' +
                    std::to_string(c + 1) + '\n';
        }
    }
    const std::string in = put("in.obj", text);
    put("paints.mtl", "newmtl sea\n");
    fs::create_directory(at("sub"));
    const auto outcome = run(REMESH_PROGRAM, {in, at("sub/out.obj"), "-n", "300", "--keep-labels"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const remesh::MeshFile file =
        remesh::read_mesh(at("sub/out.obj"), remesh::ReadOptions{.with_attributes = true});
    EXPECT_EQ(file.attributes.material_files, std::vector<std::string>{"../paints.mtl"});
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    const Attribute& material = file.attributes.of_faces[0];
    Index num_sky = 0;
    for (Index f = 0; f < file.mesh.triangles.size(); ++f) {
        const auto& [a, b, c] = file.mesh.triangles[f];
        const double z =
            file.mesh.positions[a].z() + file.mesh.positions[b].z() + file.mesh.positions[c].z();
        const bool is_sky = material.names[static_cast<std::size_t>(material.values[f])] == "sky";
        EXPECT_EQ(is_sky, z > 0);
        if (is_sky) ++num_sky;
    }
    EXPECT_GT(num_sky, 200u);
}
