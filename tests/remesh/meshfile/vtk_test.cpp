#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "agvd/mesh/topology.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/read_text.h"
#include "support/shapes.h"

using agvd::InvalidInput;
using agvd::IoError;
using agvd::Triangle;
using agvd::Vec3;
using texts::expect_error;
using texts::read_bytes;

namespace {

std::string vtk_head(const std::string& rest, const std::string& version = "3.0") {
    return "# vtk DataFile Version " + version + "\nby hand\n" + rest;
}

const std::string five_points = "POINTS 5 float\n0 0 0 1 0 0\n0 1 0 1 1 0 0 2 0\n";
const std::string poly = vtk_head("ASCII\nDATASET POLYDATA\n" + five_points);
const std::string unstructured = vtk_head("ASCII\nDATASET UNSTRUCTURED_GRID\n" + five_points);

std::vector<Triangle> triangles_of(const std::string& bytes) {
    return read_bytes("a.vtk", bytes).mesh.triangles;
}

remesh::MeshFile with_arrays(const std::string& bytes) {
    return remesh::read_vtk({.path = "a.vtk", .bytes = bytes, .with_attributes = true});
}

double volume_of(const agvd::TriangleMesh& mesh) {
    double volume = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        volume += mesh.positions[a].cross(mesh.positions[b]).dot(mesh.positions[c]) / 6;
    }
    return volume;
}

template <typename T>
std::string big_endian(std::initializer_list<T> values) {
    std::string bytes;
    for (const T value : values) {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        std::reverse(raw, raw + sizeof(T));
        bytes.append(raw, sizeof(T));
    }
    return bytes;
}

}  // namespace

TEST(Vtk, PolygonsAndStripsAreRead) {
    const auto file = read_bytes(
        "a.vtk", poly +
                     "VERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\nPOLYGONS 2 9\n3 0 1 2\n4 0 1\n3 2\n"
                     "TRIANGLE_STRIPS 1 6\n5 0 1 2 3 4\n");
    EXPECT_EQ(file.mesh.positions[4], Vec3(0, 2, 0));
    ASSERT_EQ(file.mesh.triangles.size(), 6u);
    EXPECT_EQ(file.mesh.triangles[0], (Triangle{0, 1, 2}));
    EXPECT_EQ(file.mesh.triangles[4], (Triangle{2, 1, 3}));
    EXPECT_EQ(file.polygons, 1u);
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("2 cells that are neither faces"), std::string::npos);
}

TEST(Vtk, FacesOfAGridAreReadAndOtherCellsPassedOver) {
    const auto file =
        read_bytes("a.vtk", unstructured +
                                "CELLS 5 22\n3 0 1 2\n4 0 1 2 3\n4 0 1 3 2\n3 1 3 2\n3 0 1 2\n"
                                "CELL_TYPES 5\n5 8 9 6 22\n");
    EXPECT_EQ(file.mesh.triangles.size(), 6u);
    EXPECT_EQ(file.mesh.triangles[1], file.mesh.triangles[3]);  // Pixel and quad.
    EXPECT_EQ(file.mesh.triangles[5], (Triangle{1, 3, 2}));
    EXPECT_EQ(file.warnings.size(), 1u);
    EXPECT_EQ(triangles_of(vtk_head("ASCII\nDATASET UNSTRUCTURED_GRID\n" + five_points +
                                    "CELL_TYPES 1\n5\nCELLS 1 4\n3 0 1 2\n")),
              (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(Vtk, CellsOfVersion5AreRead) {
    const std::string text =
        "ASCII\nDATASET POLYDATA\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\nMETADATA\nINFORMATION 0\n\n"
        "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2\n";
    EXPECT_EQ(triangles_of(vtk_head(text, "5.1")), (std::vector<Triangle>{{0, 1, 2}}));
    const std::string bytes = "BINARY\nDATASET POLYDATA\nPOINTS 3 double\n" +
                              big_endian<double>({0, 0, 0, 1, 0, 0, 0, 1, 0.1}) +
                              "\nPOLYGONS 2 3\nOFFSETS vtktypeint64\n" +
                              big_endian<std::int64_t>({0, 3}) + "\nCONNECTIVITY vtktypeint64\n" +
                              big_endian<std::int64_t>({2, 1, 0}) + "\n";
    const auto file = read_bytes("a.vtk", vtk_head(bytes, "5.1"));
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{2, 1, 0}}));
    EXPECT_EQ(file.mesh.positions[2], Vec3(0, 1, 0.1));
}

TEST(Vtk, BinaryIsRead) {
    const std::string bytes =
        vtk_head("BINARY\nDATASET POLYDATA\nPOINTS 3 float\n" +
                 big_endian<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + "\nPOLYGONS 1 4\n" +
                 big_endian<std::int32_t>({3, 0, 1, 2}) + "\nCELL_DATA 1\nSCALARS id short 1\n" +
                 "LOOKUP_TABLE default\n" + big_endian<std::int16_t>({-5}) +
                 "\nPOINT_DATA 3\nCOLOR_SCALARS c 3\n" + std::string("abcdefghi") + "\n");
    const auto file = with_arrays(bytes);
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].values, std::vector<double>{-5});
    ASSERT_EQ(file.attributes.of_vertices.size(), 3u);
    EXPECT_EQ(file.attributes.of_vertices[1].name, "green");
    EXPECT_EQ(file.attributes.of_vertices[1].values, (std::vector<double>{'b', 'e', 'h'}));
    for (std::size_t size = bytes.find("POINTS"); size < bytes.find("\nCELL_DATA"); ++size) {
        EXPECT_THROW(static_cast<void>(with_arrays(bytes.substr(0, size))), agvd::Error) << size;
    }
}

TEST(Vtk, FieldsOfTheWholeFileArePassedOver) {
    const auto file = with_arrays(poly +
                                  "FIELD FieldData 2\nTIME 1 1 double\n.5\ncycle 1 1 int\n7\n"
                                  "POLYGONS 1 4\n3 0 1 3\nCELL_DATA 1\nSCALARS a int\n"
                                  "LOOKUP_TABLE default\n9\n");
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].values, (std::vector<double>{9}));
    EXPECT_TRUE(file.attributes.of_vertices.empty());
    EXPECT_TRUE(file.attributes.declined.empty());
}

TEST(Vtk, ArraysBecomeAttributes) {
    const auto file =
        with_arrays(poly +
                    "LINES 1 3\n2 0 1\nPOLYGONS 2 9\n4 0 1 3 2\n3 2 3 4\nCELL_DATA 3\n"
                    "SCALARS part%20id int\nLOOKUP_TABLE default\n9 7 8\n"
                    "FIELD FieldData 2\nheat 1 3 double\n.5 1.5 2.5\nbig 1 3 vtktypeint64\n"
                    "1 99999999999 3\nNORMALS n float\n0 0 1 0 0 1 0 0 1\n"
                    "POINT_DATA 5\nNORMALS normals double\n0 0 1 0 0 1 0 0 1 0 0 1 0 0 1\n"
                    "TEXTURE_COORDINATES uv 2 float\n0 0 0 0 0 0 0 0 0 0\n"
                    "VECTORS wind float\n0 0 1 0 0 2 0 0 3 0 0 4 0 0 5\n"
                    "COLOR_SCALARS paint 4\n1 0 0 1 0 1 0 1 0 0 1 1 1 1 1 1 .2 0 0 1\n"
                    "SCALARS x float\nLOOKUP_TABLE own\n1 2 3 4 5\nLOOKUP_TABLE own 1\n0 0 0 1\n");
    const auto& faces = file.attributes.of_faces;
    ASSERT_EQ(faces.size(), 3u);
    EXPECT_EQ(faces[0].name, "part_id");
    EXPECT_EQ(faces[0].values, (std::vector<double>{7, 7, 8}));
    EXPECT_EQ(faces[1].values, (std::vector<double>{1.5, 1.5, 2.5}));
    EXPECT_EQ(faces[2].type, remesh::NumberType::Float64);
    const auto& vertices = file.attributes.of_vertices;
    ASSERT_EQ(vertices.size(), 7u);
    EXPECT_EQ(vertices[0].name, "wind_0");
    EXPECT_EQ(vertices[2].name, "wind_2");
    EXPECT_EQ(vertices[2].type, remesh::NumberType::Float32);
    EXPECT_EQ(vertices[2].values, (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_EQ(vertices[3].name, "red");
    EXPECT_EQ(vertices[3].values, (std::vector<double>{255, 0, 0, 255, 51}));
    EXPECT_EQ(vertices[6].name, "alpha");
    EXPECT_EQ(file.attributes.normals, remesh::NumberType::Float64);
    std::vector<std::string> declined;
    for (const auto& one : file.attributes.declined) declined.push_back(one.name);
    EXPECT_EQ(declined, (std::vector<std::string>{"face n", "vertex x"}));
    EXPECT_EQ(file.attributes.texture.corners.size(), 3u);
}

TEST(Vtk, WhatWasWrittenComesBack) {
    const agvd::TriangleMesh mesh = shapes::jitter(shapes::icosahedron(), 0.01, 3);
    remesh::MeshAttributes attributes{.normals = remesh::NumberType::Float32};
    const auto values = [](std::size_t count, double step) {
        std::vector<double> result(count);
        for (std::size_t i = 0; i < count; ++i) result[i] = static_cast<double>(i) * step;
        return result;
    };
    for (const char* name : {"red", "green", "blue"}) {
        attributes.of_vertices.push_back(
            {.name = name, .type = remesh::NumberType::UInt8, .values = values(12, 3)});
    }
    attributes.of_vertices.push_back({.name = "heat", .values = values(12, 0.1)});
    attributes.of_faces.push_back(
        {.name = "label", .type = remesh::NumberType::Int16, .values = values(20, -1)});
    const auto file = with_arrays(remesh::format_mesh("a.vtk", mesh.view(), attributes));
    EXPECT_EQ(file.mesh.positions, mesh.positions);
    EXPECT_EQ(file.mesh.triangles, mesh.triangles);
    EXPECT_EQ(file.attributes.normals, remesh::NumberType::Float32);
    ASSERT_EQ(file.attributes.of_vertices.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(file.attributes.of_vertices[i].name, attributes.of_vertices[i].name);
        EXPECT_EQ(file.attributes.of_vertices[i].type, attributes.of_vertices[i].type);
        EXPECT_EQ(file.attributes.of_vertices[i].values, attributes.of_vertices[i].values);
    }
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].type, remesh::NumberType::Int16);
    EXPECT_EQ(file.attributes.of_faces[0].values, attributes.of_faces[0].values);
}

TEST(Vtk, ArraysOfSeveralNumbersAreWrittenAsOneArray) {
    const agvd::TriangleMesh mesh = shapes::tetrahedron();
    remesh::MeshAttributes attributes;
    for (const char* name : {"wind_0", "wind_1", "wind_2", "lone_0", "gap_0", "gap_2"}) {
        attributes.of_vertices.push_back(
            {.name = name, .values = {1, 2, 3, static_cast<double>(name[5])}});
    }
    const std::string bytes = remesh::format_mesh("a.vtk", mesh.view(), attributes);
    for (const char* head : {"wind 3 4 double", "lone_0 1 4", "gap_0 1 4", "gap_2 1 4"})
        EXPECT_NE(bytes.find(head), std::string::npos) << head;
    const auto file = with_arrays(bytes);
    ASSERT_EQ(file.attributes.of_vertices.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(file.attributes.of_vertices[i].name, attributes.of_vertices[i].name);
        EXPECT_EQ(file.attributes.of_vertices[i].values, attributes.of_vertices[i].values);
    }
}

TEST(Vtk, ArraysOfMoreThan64NumbersAreDeclined) {
    std::string bytes = poly + "POLYGONS 1 4\n3 0 1 2\nCELL_DATA 1\nFIELD f 1\nmany 65 1 int\n";
    for (int i = 0; i < 65; ++i) bytes += "1 ";
    const auto file = with_arrays(bytes);
    EXPECT_TRUE(file.attributes.of_faces.empty());
    ASSERT_EQ(file.attributes.declined.size(), 1u);
    EXPECT_EQ(file.attributes.declined[0].name, "face many");
}

// Two cubes side by side along x, the second one cut into a wedge and what is left of it.
TEST(Vtk, TheSurfaceOfVolumesIsReadWithItsValues) {
    std::string points = "POINTS 12 float\n";
    for (const char* z : {"0", "1"}) {
        for (const char* y : {"0", "1"}) {
            for (const char* x : {"0", "1", "2"}) {
                points += std::string(x) + ' ' + y + ' ' + z + '\n';
            }
        }
    }
    const auto surface = [&](const std::string& cells, const std::string& types) {
        const auto file = with_arrays(vtk_head("ASCII\nDATASET UNSTRUCTURED_GRID\n" + points +
                                               cells + types + "CELL_DATA 3\nSCALARS part int\n" +
                                               "LOOKUP_TABLE default\n7 8 9\n"));
        const remesh::Topology topology = remesh::analyze_topology(file.mesh.view());
        EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
        EXPECT_EQ(topology.boundary_loops(), 0);
        EXPECT_NEAR(volume_of(file.mesh), 2, 1e-14);
        EXPECT_EQ(file.mesh.triangles.size(), 20u);
        EXPECT_EQ(file.warnings.size(), 1u);
        std::vector<double> parts = file.attributes.of_faces.at(0).values;
        // 5 quads of the cube; of each wedge a triangle at both ends and two quads.
        EXPECT_EQ(std::ranges::count(parts, 7), 10);
        EXPECT_EQ(std::ranges::count(parts, 8), 4);
        EXPECT_EQ(std::ranges::count(parts, 9), 6);
        return file.warnings.at(0);
    };
    const std::string warning =
        surface("CELLS 3 23\n8 0 1 4 3 6 7 10 9\n6 1 4 5 7 10 11\n6 1 2 5 7 8 11\n",
                "CELL_TYPES 3\n12 13 13\n");
    EXPECT_NE(warning.find("3 volume cells"), std::string::npos) << warning;
    // The same as a voxel, and cells numbered the other way round.
    surface("CELLS 3 23\n8 0 1 3 4 6 7 9 10\n6 7 10 11 1 4 5\n6 7 8 11 1 2 5\n",
            "CELL_TYPES 3\n11 13 13\n");
}

TEST(Vtk, TheSurfaceOfAPyramidOnATetrahedronIsRead) {
    const auto file = read_bytes(
        "a.vtk",
        vtk_head("ASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 float\n0 0 0 1 0 0 1 1 0 0 1 0 0 0 1\n"
                 "3 0 1\nCELLS 2 11\n5 0 1 2 3 4\n4 1 2 4 5\nCELL_TYPES 2\n14 10\n"));
    EXPECT_EQ(file.mesh.triangles.size(), 8u);
    EXPECT_NEAR(volume_of(file.mesh), 1. / 3 + 1. / 2, 1e-15);
    EXPECT_NE(file.warnings.at(0).find("the 7 faces"), std::string::npos) << file.warnings[0];
}

TEST(Vtk, VolumesBesideFacesArePassedOver) {
    const auto file =
        read_bytes("a.vtk", unstructured + "CELLS 2 9\n4 0 1 2 3\n3 0 1 2\nCELL_TYPES 2\n10 5\n");
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("1 volume cell: skipped"), std::string::npos);
}

TEST(Vtk, WrongVolumesAreRefused) {
    const auto cells = [](const std::string& numbers) {
        return unstructured + "CELLS 1 5\n" + numbers + "\nCELL_TYPES 1\n10\n";
    };
    expect_error<InvalidInput>("a.vtk", cells("4 0 1 2 5"), {"line 9", "last of the 5"});
    expect_error<InvalidInput>("a.vtk", cells("4 0 1 2 -1"), {"cell 0", "negative"});
    expect_error<IoError>("a.vtk", unstructured + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n10\n",
                          {"3 corners instead of 4"});
}

TEST(Vtk, WrongHeadsAreRefused) {
    expect_error<IoError>("a.vtk", "<VTKFile>", {"line 1", "# vtk DataFile"});
    expect_error<IoError>("a.vtk", vtk_head("TEXT\n"), {"line 3", "'text'"});
    expect_error<IoError>("a.vtk", vtk_head("ASCII\nDATASET STRUCTURED_GRID\n"),
                          {"'STRUCTURED_GRID'", "surface"});
    expect_error<IoError>("a.vtk", poly + "SURFACE 3\n", {"'surface'"});
    expect_error<IoError>("a.vtk", vtk_head("ASCII\nDATASET POLYDATA\nPOINTS 1 bit\n0\n"),
                          {"line 5", "'bit'"});
}

TEST(Vtk, WrongCellsAreRefused) {
    expect_error<InvalidInput>("a.vtk", poly + "POLYGONS 1 4\n3 0 1 5\n", {"vertex 5"});
    expect_error<InvalidInput>("a.vtk", poly + "POLYGONS 1 4\n3 0 1 -1\n", {"negative"});
    expect_error<IoError>("a.vtk", poly + "POLYGONS 1 4\n3 0 1 .5\n", {"whole number"});
    expect_error<IoError>("a.vtk", poly + "POLYGONS 1 4\n4 0 1 2\n", {"does not fit"});
    expect_error<IoError>("a.vtk", poly + "POLYGONS 2 4\n3 0 1 2\n", {"cell 1 of 2"});
    expect_error<IoError>("a.vtk", poly + "POLYGONS 1 5\n3 0 1 2 0\n", {"fewer numbers"});
    expect_error<IoError>("a.vtk", poly + "POLYGONS 1 4\n3 0 1", {"truncated"});
    expect_error<IoError>("a.vtk", poly + "POLYGONS -1 4\n3 0 1 2", {"negative"});
    expect_error<IoError>("a.vtk", poly + "POLYGONS 1 4\n3 0 1 2\nPOLYGONS 1 4\n3 0 1 2\n",
                          {"twice"});
    expect_error<IoError>("a.vtk", unstructured + "CELLS 1 4\n3 0 1 2\n", {"CELL_TYPES"});
    expect_error<IoError>("a.vtk", unstructured + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 2\n5 5\n",
                          {"2 types for 1"});
    expect_error<IoError>("a.vtk", unstructured + "CELLS 1 3\n2 0 1\nCELL_TYPES 1\n5\n",
                          {"2 corners instead of 3"});
    expect_error<InvalidInput>("a.vtk", unstructured + "CELLS 1 3\n2 0 1\nCELL_TYPES 1\n21\n",
                               {"no face"});
    expect_error<InvalidInput>(
        "a.vtk", vtk_head("ASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 nan 0\n"), {"not finite"});
    const auto offsets = [](const std::string& text) {
        return vtk_head("ASCII\nDATASET POLYDATA\n" + five_points + "POLYGONS 3 6\nOFFSETS int\n" +
                            text + "\nCONNECTIVITY int\n0 1 2 2 1 3\n",
                        "5.1");
    };
    EXPECT_EQ(triangles_of(offsets("0 3 6")).size(), 2u);
    for (const char* text : {"0 4 3", "1 3 6", "0 3 7", "0 .5 6"}) {
        expect_error<IoError>("a.vtk", offsets(text), {"in order"});
    }
    expect_error<IoError>("a.vtk", offsets("0 3 5"), {"last offset"});
}

TEST(Vtk, CountsAreNotBelieved) {
    const std::string huge = "4611686018427387904";
    for (const char* encoding : {"ASCII", "BINARY"}) {
        const std::string begin = vtk_head(std::string(encoding) + "\nDATASET POLYDATA\nPOINTS ");
        expect_error<IoError>("a.vtk", begin + huge + " double\n0 0 0\n", {"truncated"});
        expect_error<IoError>("a.vtk", begin + "0 double\nPOLYGONS 1 " + huge + "\n3 0 1 2\n",
                              {"truncated"});
        expect_error<IoError>("a.vtk",
                              begin + "0 double\nPOINT_DATA " + huge + "\nSCALARS a int " + huge +
                                  "\nLOOKUP_TABLE b\n1 2 3\n",
                              {"truncated"});
    }
}

TEST(Vtk, ArraysOfAnotherLengthAreRefused) {
    const std::string mesh = poly + "POLYGONS 1 4\n3 0 1 2\n";
    for (const char* arrays :
         {"POINT_DATA 4\nSCALARS a int\nLOOKUP_TABLE b\n1 2 3 4\n",
          "POINT_DATA 5\nFIELD f 1\na 1 4 int\n1 2 3 4\n", "SCALARS a int\nLOOKUP_TABLE b\n"}) {
        EXPECT_THROW(static_cast<void>(with_arrays(mesh + arrays)), IoError) << arrays;
    }
}
