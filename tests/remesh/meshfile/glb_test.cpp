#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "remesh/meshfile/mesh_file.h"
#include "support/read_text.h"
#include "support/scratch.h"
#include "support/shapes.h"

using agvd::InvalidInput;
using agvd::IoError;
using agvd::Triangle;
using agvd::Vec3;
using nlohmann::json;
using texts::expect_error;
using texts::read_bytes;

namespace {

template <typename T>
std::string raw(std::initializer_list<T> values) {
    std::string bytes;
    for (const T value : values) {
        char parts[sizeof(T)];
        std::memcpy(parts, &value, sizeof(T));
        bytes.append(parts, sizeof(T));
    }
    return bytes;
}

std::string chunk(const char* type, std::string content) {
    content.resize((content.size() + 3) / 4 * 4, ' ');
    return raw<std::uint32_t>({static_cast<std::uint32_t>(content.size())}) + std::string(type, 4) +
           content;
}

std::string glb(const std::string& text, const std::string& data) {
    const std::string chunks = chunk("JSON", text) + chunk("BIN\0", data);
    return "glTF" + raw<std::uint32_t>({2, static_cast<std::uint32_t>(12 + chunks.size())}) +
           chunks;
}

// Four points, then six corners of 16 bits, then four colours of 4 bytes.
const std::string square_data =
    raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) + raw<std::uint16_t>({0, 1, 2, 2, 1, 3}) +
    raw<std::uint8_t>({255, 0, 0, 9, 0, 51, 0, 9, 0, 0, 255, 9, 1, 2, 3, 9});

json square() {
    return json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": 76}],
        "bufferViews": [{"buffer": 0, "byteLength": 48},
                        {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                        {"buffer": 0, "byteOffset": 60, "byteLength": 16, "byteStride": 4}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                      {"bufferView": 2, "componentType": 5121, "count": 4, "type": "VEC3",
                       "normalized": true}]})");
}

remesh::MeshFile read_square(const json& root) {
    return read_bytes("a.glb", glb(root.dump(), square_data));
}

remesh::MeshFile with_colors(const json& root) {
    return remesh::read_gltf(
        {.path = "a.glb", .bytes = glb(root.dump(), square_data), .with_attributes = true});
}

void expect_refused(const json& root, const std::vector<std::string>& words) {
    expect_error<IoError>("a.glb", glb(root.dump(), square_data), words);
}

json& primitive_of(json& root) { return root["meshes"][0]["primitives"][0]; }

}  // namespace

TEST(Glb, TrianglesAreRead) {
    const auto file = read_square(square());
    EXPECT_EQ(file.mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
}

TEST(Glb, StripsFansAndMeshesWithoutIndicesAreRead) {
    json root = square();
    primitive_of(root).erase("indices");
    primitive_of(root)["mode"] = 5;
    EXPECT_EQ(read_square(root).mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
    primitive_of(root)["mode"] = 6;
    EXPECT_EQ(read_square(root).mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    root["nodes"][0]["scale"] = {1, -1, 1};
    EXPECT_EQ(read_square(root).mesh.triangles, (std::vector<Triangle>{{0, 2, 1}, {0, 3, 2}}));
    primitive_of(root)["mode"] = 5;
    const std::vector<Triangle> turned = read_square(root).mesh.triangles;
    ASSERT_EQ(turned.size(), 2u);
    EXPECT_EQ(turned[0], (Triangle{1, 0, 2}));
    EXPECT_EQ(turned[1], (Triangle{1, 2, 3}));
    root["accessors"][0]["count"] = 3;
    primitive_of(root)["mode"] = 4;
    EXPECT_EQ(read_square(root).mesh.triangles.size(), 1u);
}

TEST(Glb, TransformsOfNodesAreApplied) {
    json root = square();
    root["scenes"][0]["nodes"] = {1};
    root["nodes"] = json::parse(R"([
        {"mesh": 0, "translation": [1, 2, 3], "scale": [2, 2, 2],
         "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]},
        {"children": [0, 2], "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 10,0,0,1]},
        {"mesh": 0, "scale": [-1, 1, 1]}])");
    const auto file = read_square(root);
    ASSERT_EQ(file.mesh.positions.size(), 8u);
    EXPECT_LT((file.mesh.positions[1] - Vec3(11, 4, 3)).norm(), 1e-12);
    EXPECT_LT((file.mesh.positions[2] - Vec3(9, 2, 3)).norm(), 1e-12);
    EXPECT_EQ(file.mesh.positions[5], Vec3(9, 0, 0));
    ASSERT_EQ(file.mesh.triangles.size(), 4u);
    EXPECT_EQ(file.mesh.triangles[2], (Triangle{4, 6, 5}));  // Mirrored, and turned back.
}

TEST(Glb, WithoutAScenesEachMeshIsReadOnce) {
    json root = square();
    root.erase("scene");
    root.erase("scenes");
    root["nodes"][0]["translation"] = {5, 5, 5};
    EXPECT_EQ(read_square(root).mesh.positions[0], Vec3(0, 0, 0));
}

TEST(Glb, PrimitivesShareVerticesAndMaterialsAreLabels) {
    json root = square();
    root["materials"] = json::parse(R"([{"name": "red\npaint"}, {}])");
    root["meshes"][0]["primitives"] = json::parse(R"([
        {"attributes": {"POSITION": 0, "NORMAL": 0, "TEXCOORD_0": 0}, "indices": 1, "material": 0},
        {"attributes": {"POSITION": 0}, "indices": 1, "mode": 1},
        {"attributes": {"POSITION": 0}, "indices": 1, "material": 1},
        {"attributes": {"POSITION": 0}, "indices": 1}])");
    const auto file = with_colors(root);
    EXPECT_EQ(file.mesh.positions.size(), 4u);
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].values, (std::vector<double>{0, 0, 1, 1, 2, 2}));
    EXPECT_EQ(file.attributes.of_faces[0].names,
              (std::vector<std::string>{"redpaint", "material_1", ""}));
    EXPECT_TRUE(file.attributes.normals.has_value());
    ASSERT_EQ(file.attributes.declined.size(), 1u);
    EXPECT_EQ(file.attributes.declined[0].name, "TEXCOORD_0");
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("1 primitives of points or lines"), std::string::npos);
}

TEST(Glb, ColoursOfVerticesAreRead) {
    json root = square();
    primitive_of(root)["attributes"]["COLOR_0"] = 2;
    const auto file = with_colors(root);
    ASSERT_EQ(file.attributes.of_vertices.size(), 3u);
    EXPECT_EQ(file.attributes.of_vertices[0].values, (std::vector<double>{1, 0, 0, 1 / 255.}));
    EXPECT_EQ(file.attributes.of_vertices[1].values, (std::vector<double>{0, 0.2, 0, 2 / 255.}));
    root["accessors"][2]["count"] = 3;
    EXPECT_THROW(static_cast<void>(with_colors(root)), IoError);
}

TEST(Glb, WhatWasWrittenComesBackInFloat) {
    const agvd::TriangleMesh mesh = shapes::jitter(shapes::icosahedron(), 0.01, 3);
    remesh::MeshAttributes attributes{.normals = remesh::NumberType::Float32};
    std::vector<double> values(12);
    for (std::size_t i = 0; i < 12; ++i) values[i] = static_cast<double>(20 * i);
    for (const char* name : {"red", "green", "blue", "heat"}) {
        attributes.of_vertices.push_back(
            {.name = name, .type = remesh::NumberType::UInt8, .values = values});
    }
    EXPECT_EQ(remesh::remove_unwritable("a.glb", attributes),
              std::vector<std::string>{"vertex heat"});
    const std::string bytes = remesh::format_mesh("a.glb", mesh.view(), attributes);
    EXPECT_EQ(bytes.size() % 4, 0u);
    const auto file = remesh::read_gltf({.path = "a.glb", .bytes = bytes, .with_attributes = true});
    EXPECT_EQ(file.mesh.triangles, mesh.triangles);
    ASSERT_EQ(file.mesh.positions.size(), mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(file.mesh.positions[v][k], static_cast<float>(mesh.positions[v][k]));
        }
    }
    EXPECT_TRUE(file.attributes.normals.has_value());
    ASSERT_EQ(file.attributes.of_vertices.size(), 3u);
    for (std::size_t i = 0; i < 12; ++i) {
        EXPECT_DOUBLE_EQ(255 * file.attributes.of_vertices[2].values[i], values[i]);
    }
}

TEST(Glb, MeshesWithoutFacesAreNotWritten) {
    const agvd::TriangleMesh points{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
    EXPECT_THROW((void)remesh::format_mesh("a.glb", points.view()), agvd::InvalidInput);
}

TEST(Glb, TruncatedFilesAreRefused) {
    const std::string bytes = glb(square().dump(), square_data);
    for (std::size_t size = 1; size < bytes.size(); ++size) {
        expect_error<IoError>("a.glb", bytes.substr(0, size), {"byte"});
    }
}

TEST(Glb, WrongContainersAreRefused) {
    expect_error<IoError>("a.glb", "solid a", {"byte 0", "'glTF'"});
    expect_error<IoError>("a.gltf", R"({"asset": {"version": "1.0"}})", {"version 2.0"});
    std::string bytes = glb(square().dump(), square_data);
    bytes[4] = 1;
    expect_error<IoError>("a.glb", bytes, {"byte 4", "version 1"});
    expect_error<IoError>("a.glb", glb("{\"asset\": ", square_data), {"JSON"});
    expect_error<IoError>("a.glb", glb("[1]", square_data), {"JSON object"});
    json root = square();
    root["extensionsRequired"] = {"KHR_texture_transform", "KHR_draco_mesh_compression"};
    expect_refused(root, {"'KHR_draco_mesh_compression'", "without"});
}

TEST(Glb, WrongAccessorsAreRefused) {
    const auto changed = [](const char* list, std::size_t index, const char* key,
                            const json& value) {
        json root = square();
        root[list][index][key] = value;
        return root;
    };
    for (const json& root :
         {changed("accessors", 0, "count", 5),
          changed("accessors", 0, "count", 18446744073709551615u),
          changed("accessors", 0, "byteOffset", 1),
          changed("accessors", 0, "byteOffset", 18446744073709551615u),
          changed("bufferViews", 0, "byteLength", 47), changed("bufferViews", 0, "byteOffset", 77),
          changed("bufferViews", 0, "byteLength", 77), changed("bufferViews", 0, "byteStride", 4),
          changed("bufferViews", 0, "byteStride", 13)}) {
        expect_refused(root, {"accessor 0", "within the data"});
    }
    expect_refused(changed("accessors", 0, "count", -1), {"count", "whole number"});
    expect_refused(changed("accessors", 0, "componentType", 5124), {"unknown type"});
    expect_refused(changed("accessors", 0, "type", "MAT4"), {"unknown type"});
    expect_refused(changed("accessors", 0, "type", 3), {"unknown type"});
    expect_refused(changed("accessors", 0, "type", "VEC2"), {"three coordinates"});
    json columns = changed("accessors", 1, "type", "VEC2");
    columns["accessors"][1]["count"] = 3;
    expect_refused(columns, {"several columns"});
    expect_refused(changed("accessors", 1, "count", 5), {"multiple of three"});
    expect_refused(changed("accessors", 0, "sparse", json::object()), {"sparse"});
    expect_refused(changed("accessors", 0, "bufferView", 9), {"bufferViews has no element 9"});
    expect_refused(changed("bufferViews", 0, "buffer", 1), {"within the data"});
    expect_refused(changed("buffers", 0, "uri", "/dev/zero"), {"'/dev/zero'", "beside"});
    expect_refused(changed("buffers", 0, "uri", "https://a/b"), {"beside"});
    expect_refused(changed("buffers", 0, "uri", "data:;base64,A*=="), {"not base64"});
}

TEST(Glb, WrongNodesAndPrimitivesAreRefused) {
    const auto with = [](const char* key, const char* value) {
        json root = square();
        root[key] = json::parse(value);
        return root;
    };
    expect_refused(with("scene", "1"), {"scenes has no element 1"});
    expect_refused(with("scenes", "{}"), {"scenes is not a list"});
    expect_refused(with("nodes", "[{\"mesh\": 1}]"), {"meshes has no element 1"});
    expect_refused(with("nodes", "[7]"), {"nodes has no element 0"});
    expect_refused(with("nodes", "[{\"children\": [0]}]"), {"node 0 has several parents"});
    expect_refused(with("nodes", "[{\"children\": [\"a\"]}]"), {"a node is not a whole number"});
    expect_refused(with("nodes", "[{\"translation\": [1, 2]}]"), {"3 numbers"});
    expect_refused(with("nodes", "[{\"scale\": [1, 2, null]}]"), {"not a number"});
    expect_refused(with("meshes", "[{\"primitives\": [{}]}]"), {"no attributes"});
    expect_refused(with("meshes", "[{\"primitives\": [{\"attributes\": {}}]}]"), {"no positions"});
    expect_error<InvalidInput>("a.glb", glb(with("meshes", "[{}]").dump(), square_data),
                               {"neither a vertex nor a face"});
}

TEST(Glb, WrongValuesAreRefused) {
    std::string data = square_data;
    data[48] = 4;
    expect_error<InvalidInput>("a.glb", glb(square().dump(), data),
                               {"byte", "vertex 4", "4 vertices"});
    data = square_data;
    const float nan = std::nanf("");
    std::memcpy(&data[12], &nan, 4);
    expect_error<InvalidInput>("a.glb", glb(square().dump(), data), {"vertex 1", "not finite"});
}

namespace {

// Three materials, of which two have one name; the first has an image in the buffer.
json painted_square() {
    json root = square();
    root["extensionsUsed"] = {"KHR_materials_unlit"};
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 60}, {"byteLength", 7}});
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 32}});
    root["accessors"].push_back(
        {{"bufferView", 4}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
    root["images"] = json::parse(R"([{"bufferView": 3, "mimeType": "image/png"}])");
    root["samplers"] = json::parse(R"([{"wrapS": 33071}])");
    root["textures"] = json::parse(R"([{"source": 0, "sampler": 0}])");
    root["materials"] = json::parse(R"([
        {"name": "paint", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
         "emissiveTexture": {"index": 0, "texCoord": 1}, "extensions": {"KHR_materials_unlit": {}}},
        {"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}},
        {"name": "unused"}])");
    root["meshes"][0]["primitives"] = json::parse(R"([
        {"attributes": {"POSITION": 0, "TEXCOORD_0": 3}, "indices": 1, "material": 0},
        {"attributes": {"POSITION": 0, "TEXCOORD_0": 3}, "indices": 1, "material": 1}])");
    return root;
}

json json_of(const std::string& glb_bytes) {
    std::uint32_t size = 0;
    std::memcpy(&size, &glb_bytes[12], sizeof(size));
    return json::parse(glb_bytes.substr(20, size));
}

remesh::MeshFile from_disk(const std::filesystem::path& path) {
    return remesh::read_mesh(path, remesh::ReadOptions{.with_attributes = true});
}

class GltfFiles : public Scratch {};

}  // namespace

TEST(Glb, MaterialsAndImagesComeBack) {
    const auto file = with_colors(painted_square());
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].names, (std::vector<std::string>{"paint", "paint_2"}));
    ASSERT_EQ(file.attributes.materials.images.size(), 1u);
    EXPECT_EQ(file.attributes.materials.images[0], square_data.substr(60, 7));
    for (const char* name : {"a.glb", "a.gltf"}) {
        remesh::MeshAttributes attributes = file.attributes;
        EXPECT_TRUE(remesh::remove_unwritable(name, attributes).empty()) << name;
        const std::string bytes = remesh::format_mesh(name, file.mesh.view(), attributes);
        const auto again = read_bytes(name, bytes, true);
        EXPECT_EQ(again.mesh.triangles.size(), 4u);
        ASSERT_EQ(again.attributes.of_faces.size(), 1u);
        EXPECT_EQ(again.attributes.of_faces[0].names, file.attributes.of_faces[0].names);
        EXPECT_EQ(again.attributes.of_faces[0].values, (std::vector<double>{0, 0, 1, 1}));
        EXPECT_EQ(again.attributes.materials.images, file.attributes.materials.images);
        const json root = name == std::string("a.glb") ? json_of(bytes) : json::parse(bytes);
        const json& materials = root["materials"];
        ASSERT_EQ(materials.size(), 3u);
        EXPECT_EQ(materials[0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
        EXPECT_FALSE(materials[0].contains("emissiveTexture"));  // It has other coordinates.
        EXPECT_TRUE(materials[0]["extensions"].contains("KHR_materials_unlit"));
        EXPECT_EQ(materials[1]["pbrMetallicRoughness"]["baseColorFactor"], json({1, 0, 0, 1}));
        EXPECT_EQ(root["images"][0]["mimeType"], "image/png");
        EXPECT_EQ(root["samplers"][0]["wrapS"], 33071);
        EXPECT_EQ(root["extensionsUsed"], json({"KHR_materials_unlit"}));
        const json& primitives = root["meshes"][0]["primitives"];
        ASSERT_EQ(primitives.size(), 2u);
        EXPECT_EQ(primitives[1]["material"], 1);
        EXPECT_EQ(primitives[0]["attributes"], primitives[1]["attributes"]);
    }
}

TEST(Glb, TexturesWithoutCoordinatesAreLeftOut) {
    auto file = with_colors(painted_square());
    file.attributes.texture = {};
    const std::string bytes = remesh::format_mesh("a.glb", file.mesh.view(), file.attributes);
    EXPECT_EQ(json_of(bytes)["materials"][0]["pbrMetallicRoughness"], json::object());
}

TEST(Glb, MaterialsKnownByNameOnlyAndColorsOf3mfAreWritten) {
    auto file = read_square(square());
    file.attributes.of_faces.push_back(
        {.name = "material", .values = {1, 0}, .names = {"", "red"}});
    const json root = json_of(remesh::format_mesh("a.glb", file.mesh.view(), file.attributes));
    EXPECT_EQ(root["materials"], json::parse(R"([{"name": "red"}])"));
    EXPECT_FALSE(root["meshes"][0]["primitives"][0].contains("material"));
    EXPECT_EQ(root["meshes"][0]["primitives"][1]["material"], 0);
}

TEST(Glb, OtherFormatsSayThatColorsAndImagesAreLost) {
    remesh::MeshAttributes attributes = with_colors(painted_square()).attributes;
    EXPECT_EQ(remesh::remove_unwritable("a.3mf", attributes),
              (std::vector<std::string>{"corner texcoord", "material images"}));
    attributes = with_colors(painted_square()).attributes;
    EXPECT_EQ(remesh::remove_unwritable("a.obj", attributes),
              std::vector<std::string>{"material colours and images"});
}

TEST_F(GltfFiles, BuffersAndImagesBesideTheFileAreRead) {
    json root = painted_square();
    root["buffers"][0]["uri"] = "the%20data.bin";
    root["images"][0] = {{"uri", "paint.png"}};
    put("the data.bin", square_data);
    put("paint.png", "\x89PNG...");
    const auto file = from_disk(put("a.gltf", root.dump()));
    EXPECT_EQ(file.mesh.positions[3], Vec3(1, 1, 0));
    EXPECT_EQ(file.mesh.triangles.size(), 4u);
    EXPECT_EQ(file.attributes.unit, "meter");
    EXPECT_EQ(file.attributes.materials.images, std::vector<std::string>{"\x89PNG..."});
    std::filesystem::remove(at("paint.png"));
    const auto without = from_disk(at("a.gltf"));
    ASSERT_EQ(without.attributes.declined.size(), 1u);
    EXPECT_EQ(without.attributes.declined[0].name, "image 0");
    const json kept =
        json_of(remesh::format_mesh("b.glb", without.mesh.view(), without.attributes));
    EXPECT_EQ(kept["images"], json::parse(R"([{"uri": "paint.png"}])"));
    std::filesystem::remove(at("the data.bin"));
    EXPECT_THROW(from_disk(at("a.gltf")), IoError);
}
