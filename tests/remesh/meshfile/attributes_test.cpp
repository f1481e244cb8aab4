// What files carry besides coordinates and corners: read, written, and read again.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "remesh/meshfile/mesh_file.h"
#include "remesh/transfer/transfer.h"
#include "support/read_text.h"
#include "support/shapes.h"

using agvd::FaceId;
using agvd::Index;
using remesh::Attribute;
using remesh::find_attribute;
using remesh::MeshAttributes;
using remesh::MeshFile;
using remesh::NumberType;
using Values = std::vector<double>;

namespace {

MeshFile read_all(const std::string& name, const std::string& bytes) {
    return remesh::require_format({name}).read(
        {.path = name, .bytes = bytes, .with_attributes = true});
}

std::vector<std::string> names_in(const std::vector<Attribute>& attributes) {
    std::vector<std::string> names;
    for (const Attribute& attribute : attributes) names.push_back(attribute.name);
    return names;
}

Values values_of(const std::vector<Attribute>& attributes, const std::string& name) {
    const Attribute* const found = find_attribute(attributes, name);
    return found == nullptr ? Values{} : found->values;
}

std::string declined_in(const MeshAttributes& attributes) {
    std::string text;
    for (const auto& [name, reason] : attributes.declined) text += name + ": " + reason + "\n";
    return text;
}

void expect_same(const std::vector<Attribute>& a, const std::vector<Attribute>& b) {
    ASSERT_EQ(names_in(a), names_in(b));
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].type, b[i].type) << a[i].name;
        EXPECT_EQ(a[i].values, b[i].values) << a[i].name;
    }
}

// A header of a triangle and a quad with other properties of vertices and faces.
std::string ply(const std::string& format, const std::string& of_vertices,
                const std::string& of_faces, const std::string& body) {
    return "ply\nformat " + format +
           " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
           of_vertices + "element face 2\n" + of_faces +
           "property list uchar int vertex_indices\nend_header\n" + body;
}

std::string ascii(const std::string& of_vertices, const std::array<std::string, 4>& vertices,
                  const std::string& of_faces = "",
                  const std::array<std::string, 2>& faces = {"", ""}) {
    return ply("ascii", of_vertices, of_faces,
               "0 0 0 " + vertices[0] + "\n1 0 0 " + vertices[1] + "\n1 1 0 " + vertices[2] +
                   "\n0 1 0 " + vertices[3] + "\n" + faces[0] + " 4 0 1 2 3\n" + faces[1] +
                   " 3 0 1 2\n");
}

template <typename T>
std::string stored(T value, bool is_big) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (is_big) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

// One value of each type, the same in each element.
std::string one_of_each(bool is_big) {
    return stored(std::int8_t{-5}, is_big) + stored(std::uint8_t{200}, is_big) +
           stored(std::int16_t{-300}, is_big) + stored(std::uint16_t{60000}, is_big) +
           stored(std::int32_t{-70000}, is_big) + stored(std::uint32_t{4000000000U}, is_big) +
           stored(1.5F, is_big) + stored(-0.1, is_big);
}

}  // namespace

TEST(Attributes, PlyOfAllTypesAndByteOrdersIsReadAndWritten) {
    const std::string types =
        "property char a\nproperty uint8 b\nproperty short c\nproperty ushort d\nproperty int32 "
        "e\nproperty uint f\nproperty float32 g\nproperty double h\n";
    const Values wanted{-5, 200, -300, 60000, -70000, 4e9, 1.5, -0.1};
    int num_read = 0;
    for (const bool is_big : {false, true}) {
        std::string body;
        for (int v = 0; v < 4; ++v) {
            for (const int x : {v % 2, v / 2, 0}) body += stored(static_cast<float>(x), is_big);
            body += one_of_each(is_big);
        }
        for (const int last : {2, 3}) {
            body += one_of_each(is_big) + stored(std::uint8_t{3}, is_big);
            for (const int v : {0, 1, last}) body += stored(std::int32_t{v}, is_big);
        }
        const MeshFile file = read_all(
            "a.ply",
            ply(is_big ? "binary_big_endian" : "binary_little_endian", types, types, body));
        const MeshFile again =
            read_all("a.ply", remesh::format_mesh("a.ply", file.mesh.view(), file.attributes));
        for (const auto& [attributes, count] :
             {std::pair(&file.attributes.of_vertices, 4), {&file.attributes.of_faces, 2}}) {
            ASSERT_EQ(attributes->size(), 8u);
            for (std::size_t i = 0; i < 8; ++i) {
                EXPECT_EQ((*attributes)[i].values,
                          Values(static_cast<std::size_t>(count), wanted[i]));
                EXPECT_EQ((*attributes)[i].type, static_cast<NumberType>(i));
                ++num_read;
            }
        }
        expect_same(again.attributes.of_vertices, file.attributes.of_vertices);
        expect_same(again.attributes.of_faces, file.attributes.of_faces);
    }
    EXPECT_EQ(num_read, 32);
}

TEST(Attributes, AreReadOnlyWhereTheyAreWanted) {
    const std::string bytes = ascii("property float q\n", {"1", "2", "3", "4"});
    EXPECT_TRUE(texts::read_bytes("a.ply", bytes).attributes.empty());
    EXPECT_EQ(values_of(read_all("a.ply", bytes).attributes.of_vertices, "q"),
              (Values{1, 2, 3, 4}));
}

TEST(Attributes, OfPolygonsGoToTheirTriangles) {
    const MeshFile file =
        read_all("a.ply", ascii("", {"", "", "", ""}, "property int label\n", {"7", "9"}));
    EXPECT_EQ(file.mesh.triangles.size(), 3u);
    EXPECT_EQ(values_of(file.attributes.of_faces, "label"), (Values{7, 7, 9}));
}

TEST(Attributes, WhatPlyCannotCarryIsDeclinedWithTheReason) {
    const MeshFile file = read_all(
        "a.ply",
        ascii("property float nx\nproperty float ny\nproperty double nz\nproperty float s\n"
              "property float t\nproperty float u\nproperty list uchar int near\nproperty int x\n",
              {"0 0 1 .1 .2 .3 2 1 2 5", "0 0 1 .1 .2 .4 0 5", "0 0 1 .1 .2 .5 0 5",
               "0 0 1 .1 .2 .6 1 3 5"},
              "property list uchar float texcoord\nproperty float nx\n", {"2 .5 .5 1", "0 1"}));
    EXPECT_EQ(names_in(file.attributes.of_vertices), std::vector<std::string>{"u"});
    EXPECT_TRUE(file.attributes.texture.empty());
    EXPECT_TRUE(file.attributes.of_faces.empty());
    EXPECT_TRUE(file.attributes.normals.has_value());
    EXPECT_EQ(declined_in(file.attributes),
              "face texcoord: some texture coordinates are missing, or no finite numbers\n"
              "vertex s: the faces have texture coordinates of their own\n"
              "vertex t: the faces have texture coordinates of their own\n"
              "vertex near: lists are not carried over\n"
              "vertex x: another property has the same name\n"
              "face nx: normals of faces are not carried over\n");
}

TEST(Attributes, WordsThatAreNoValuesOfTheTypeAreDeclinedAndTheMeshIsRead) {
    int num_declined = 0;
    for (const auto& [type, word] : {std::pair("uchar", "256"),
                                     {"uchar", "-1"},
                                     {"int", "1.5"},
                                     {"short", "40000"},
                                     {"float", "red"},
                                     {"int", "nan"}}) {
        const std::string property = std::string("property ") + type + " q\nproperty int r\n";
        const MeshFile file =
            read_all("a.ply", ascii(property, {"1 1", std::string(word) + " 2", "2 3", "3 4"}));
        EXPECT_EQ(file.mesh.positions.size(), 4u);
        EXPECT_EQ(values_of(file.attributes.of_vertices, "r"), (Values{1, 2, 3, 4}));
        EXPECT_EQ(declined_in(file.attributes),
                  "vertex q: some of its values are not of its type\n")
            << type << ' ' << word;
        ++num_declined;
    }
    EXPECT_EQ(num_declined, 6);
    const MeshFile file =
        read_all("a.ply", ascii("property float q\n", {"nan", "-inf", "1e-3", "+2"}));
    const Values values = values_of(file.attributes.of_vertices, "q");
    ASSERT_EQ(values.size(), 4u);
    EXPECT_TRUE(std::isnan(values[0]) && std::isinf(values[1]));
    EXPECT_EQ(values[3], 2);
}

TEST(Attributes, MissingValuesAreErrorsAsBefore) {
    using agvd::IoError;
    const auto complaint_of = [](const std::string& bytes) -> std::string {
        try {
            static_cast<void>(read_all("a.ply", bytes));
        } catch (const IoError& error) {
            return error.what();
        }
        return "";
    };
    const std::string property = "property float q\n";
    EXPECT_NE(complaint_of(ascii(property, {"1", "", "2", "3"})).find("line 12"),
              std::string::npos);
    EXPECT_NE(complaint_of(ascii(property, {"1", "1 1", "2", "3"})).find("more values"),
              std::string::npos);
    std::string binary = ply("binary_little_endian", property, "", std::string(40, '\0'));
    EXPECT_NE(complaint_of(binary).find("ends within vertex 2 of 4"), std::string::npos);
    // A huge count and many properties take no more memory than the bytes that are there.
    std::string huge = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n";
    for (int i = 0; i < 3000; ++i) huge += "property double q" + std::to_string(i) + "\n";
    huge +=
        "property float x\nproperty float y\nproperty float z\nelement face 1\nproperty list "
        "uchar int vertex_indices\nend_header\n";
    EXPECT_NE(complaint_of(huge + std::string(30000, 'x')).find("ends within vertex 1"),
              std::string::npos);
}

TEST(Attributes, NormalsAreThoseOfTheMesh) {
    MeshAttributes attributes{.normals = NumberType::Float64};
    const agvd::TriangleMesh sphere = shapes::sphere(3);
    for (const char* name : {"a.ply", "a.obj", "a.off"}) {
        const std::string bytes = remesh::format_mesh(name, sphere.view(), attributes);
        const MeshFile file = read_all(name, bytes);
        EXPECT_TRUE(file.attributes.normals.has_value()) << name;
        EXPECT_EQ(file.mesh.positions, sphere.positions) << name;
        EXPECT_EQ(file.mesh.triangles, sphere.triangles) << name;
    }
    const std::string text = remesh::format_mesh("a.obj", shapes::grid(1).view(), attributes);
    EXPECT_NE(text.find("vn 0 0 1\n"), std::string::npos) << text;
    EXPECT_NE(text.find("f 1//1 "), std::string::npos) << text;
}

TEST(Attributes, ObjKeepsColoursMaterialsGroupsAndObjects) {
    const std::string bytes =
        "mtllib paints.mtl\no box\nv 0 0 0 1 0 0.5\nv 1 0 0 0 1 0.5\nv 1 1 0 0 0 1\nv 0 1 0 0.25 "
        "0 0\nvt 0 0\nf 1/1 2/1 3/1\nusemtl  old \t brass\ng left\nf 1 3 4 2\nusemtl steel\nf 2 3 "
        "4\nusemtl old brass\nf 4 3 1\n";
    const MeshFile file = read_all("a.obj", bytes);
    const MeshAttributes& found = file.attributes;
    EXPECT_EQ(values_of(found.of_vertices, "red"), (Values{1, 0, 0, 0.25}));
    EXPECT_EQ(values_of(found.of_vertices, "blue"), (Values{0.5, 0.5, 1, 0}));
    EXPECT_EQ(values_of(found.of_faces, "material"), (Values{0, 1, 1, 2, 1}));
    EXPECT_EQ(find_attribute(found.of_faces, "material")->names,
              (std::vector<std::string>{"", "old brass", "steel"}));
    EXPECT_EQ(values_of(found.of_faces, "object"), (Values{0, 0, 0, 0, 0}));
    EXPECT_EQ(declined_in(found), "");

    const std::string text = remesh::format_mesh("b.obj", file.mesh.view(), found);
    const MeshFile again = read_all("b.obj", text);
    std::vector<agvd::Triangle> grouped = file.mesh.triangles;
    std::swap(grouped[3], grouped[4]);  // Faces of one material follow each other.
    EXPECT_EQ(again.mesh.triangles, grouped);
    EXPECT_EQ(again.attributes.material_files, std::vector<std::string>{"paints.mtl"});
    expect_same(again.attributes.of_vertices, found.of_vertices);
    EXPECT_EQ(values_of(again.attributes.of_faces, "material"), (Values{0, 1, 1, 1, 2}));
    EXPECT_EQ(values_of(again.attributes.of_faces, "group"), (Values{0, 1, 1, 1, 1}));

    // A backslash at the end of a name would join lines.
    const std::string joined = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\\ b\\\\";
    const MeshFile slashed = read_all("a.obj", joined + " \\\n\nf 1 2 3\n");
    EXPECT_EQ(find_attribute(slashed.attributes.of_faces, "material")->names,
              std::vector<std::string>{"a\\ b"});

    // Reading names does not change which lines are read.
    const std::string bare = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl a \\\nf 3 2 1\n";
    EXPECT_EQ(texts::read_bytes("a.obj", bare).mesh.triangles.size(), 2u);
    EXPECT_EQ(read_all("a.obj", bare).mesh.triangles.size(), 2u);

    // PLY has colours in 255 steps, and the names in comments.
    const std::string in_ply = remesh::format_mesh("b.ply", file.mesh.view(), found);
    EXPECT_NE(in_ply.find("comment material 1 old brass\n"), std::string::npos);
    EXPECT_EQ(values_of(read_all("b.ply", in_ply).attributes.of_vertices, "blue"),
              (Values{128, 128, 255, 0}));
}

TEST(Attributes, ObjColoursOfSomeVerticesAreDeclined) {
    const std::string tail = "v 0 1 0\nf 1 2 3\n";
    int num_tried = 0;
    for (const char* head : {"v 0 0 0 1 1 1\nv 1 0 0 1 1 1\n", "v 0 0 0\nv 1 0 0 1 1 1\n",
                             "v 0 0 0 1 1 1\nv 1 0 0 1 1 x\n"}) {
        const MeshFile file = read_all("a.obj", head + tail);
        EXPECT_TRUE(file.attributes.empty());
        EXPECT_EQ(file.attributes.declined.size(), 1u);
        EXPECT_EQ(file.mesh.positions.size(), 3u);
        ++num_tried;
    }
    EXPECT_EQ(num_tried, 3);
    EXPECT_TRUE(read_all("a.obj", "v 0 0 0 1\nv 1 0 0 1\n" + tail).attributes.declined.empty());
}

TEST(Attributes, OffKeepsColoursOfVerticesAndFaces) {
    const std::string head = "OFF\n4 2 0\n";
    const MeshFile bytes =
        read_all("a.off", "STCN" + head +
                              "0 0 0 0 0 1 255 0 7 255 .5 .5\n1 0 0 0 0 1 0 0 7 0 .5 .5\n"
                              "1 1 0 0 0 1 1 0 7 255 .5 .5\n0 1 0 0 0 1 2 0 7 255 .5 .5\n"
                              "4 0 1 2 3 0 0.5 1\n3 0 1 2 1 0.5 0\n");
    EXPECT_EQ(values_of(bytes.attributes.of_vertices, "red"), (Values{255, 0, 1, 2}));
    EXPECT_EQ(values_of(bytes.attributes.of_vertices, "alpha"), (Values{255, 0, 255, 255}));
    EXPECT_EQ(values_of(bytes.attributes.of_faces, "red"), (Values{0, 0, 1}));
    EXPECT_TRUE(bytes.attributes.normals.has_value());
    EXPECT_EQ(declined_in(bytes.attributes), "");
    const MeshFile again =
        read_all("b.off", remesh::format_mesh("b.off", bytes.mesh.view(), bytes.attributes));
    expect_same(again.attributes.of_vertices, bytes.attributes.of_vertices);
    EXPECT_EQ(values_of(again.attributes.of_faces, "green"), (Values{0.5, 0.5, 0.5}));

    const MeshFile some =
        read_all("a.off", head + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 1 0 0\n3 0 2 3\n");
    EXPECT_TRUE(some.attributes.empty());
    EXPECT_EQ(some.attributes.declined.size(), 1u);
}

TEST(Attributes, WhatAFormatCannotHoldIsRemovedAndNamed) {
    const auto all = [] {
        MeshAttributes attributes{.normals = NumberType::Float32};
        for (const char* name : {"red", "green", "blue", "alpha", "quality"}) {
            attributes.of_vertices.push_back({.name = name, .values = Values(4, 0)});
        }
        attributes.of_faces.push_back({.name = "red", .values = Values(2, 0)});
        attributes.of_faces.push_back({.name = "material", .values = Values(2, 0), .names = {"a"}});
        return attributes;
    };
    using Names = std::vector<std::string>;
    const auto removed = [&](const char* path) {
        MeshAttributes attributes = all();
        return remesh::remove_unwritable(path, attributes);
    };
    EXPECT_EQ(removed("a.ply"), Names{});
    EXPECT_EQ(removed("a.obj"), (Names{"vertex alpha", "vertex quality", "face red"}));
    EXPECT_EQ(removed("a.off"), (Names{"vertex quality", "face red", "face material"}));
    EXPECT_EQ(removed("a.stl").size(), 7u);
    MeshAttributes wrong = all();
    EXPECT_THROW(static_cast<void>(remesh::format_mesh("a.ply", shapes::cube().view(), wrong)),
                 agvd::InvalidInput);
    const auto write = [](double label) {
        const Attribute material{.name = "material", .values = Values(12, label), .names = {"a"}};
        return remesh::format_mesh("a.obj", shapes::cube().view(), {.of_faces = {material}});
    };
    EXPECT_NE(write(0).find("f 1"), std::string::npos);
    EXPECT_THROW(static_cast<void>(write(1)), agvd::InvalidInput);
    EXPECT_THROW(static_cast<void>(write(std::nan(""))), agvd::InvalidInput);
}

TEST(Attributes, LabelsGetConsecutiveNumbers) {
    EXPECT_EQ(remesh::face_labels_of({.name = "label", .values = {9, -4, 9, 1000}}),
              (std::vector<Index>{1, 0, 1, 2}));
}

TEST(Attributes, MissingOnesAreNamedWithThoseThatExist) {
    const std::vector<Attribute> attributes{{.name = "red"}, {.name = "heat", .values = {3}}};
    EXPECT_EQ(remesh::require_attribute(attributes, "heat", "a.ply has no property").values,
              Values{3});
    try {
        static_cast<void>(remesh::require_attribute(attributes, "cold", "a.ply has no property"));
        ADD_FAILURE();
    } catch (const agvd::InvalidOption& error) {
        EXPECT_STREQ(error.what(), "a.ply has no property 'cold'; use red, heat");
    }
}

TEST(Attributes, TheMapNamesFacesOfTheFile) {
    const MeshFile file = read_all("a.ply", ascii("", {"", "", "", ""}));
    ASSERT_EQ(file.face_polygon, (std::vector<Index>{0, 0, 1}));
    const std::vector<agvd::SurfacePoint> places{{FaceId(2), {0.5, 0.25, 0.25}},
                                                 {FaceId(1), {0, 1, 0}}};
    const auto& [a, b, c] = file.mesh.triangles[1];
    EXPECT_EQ(remesh::format_map(file, places), "1 0.5 0.25 0.25\n0 0 1 0 " + std::to_string(a) +
                                                    ' ' + std::to_string(b) + ' ' +
                                                    std::to_string(c) + '\n');
}
