#include <gtest/gtest.h>

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

const std::string medit_head = "MeshVersionFormatted 2\nDimension 3\n";
const std::string four_vertices = "Vertices\n4\n0 0 0 1\n1 0 0 2\n0 1 0 3\n1 1 .5 4\n";

remesh::MeshFile with_references(const std::string& bytes) {
    return remesh::read_medit({.path = "a.mesh", .bytes = bytes, .with_attributes = true});
}

}  // namespace

TEST(Medit, VerticesTrianglesAndQuadrilateralsAreRead) {
    const auto file = read_bytes(
        "a.mesh", medit_head + "# a comment\n" + four_vertices +
                      "Triangles 2\n1 2 3 7\n2 4 3 8\nQuadrilaterals\n1\n1 2 4 3 9\nEnd\n");
    EXPECT_EQ(file.mesh.positions,
              (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, .5}}));
    ASSERT_EQ(file.mesh.triangles.size(), 4u);
    EXPECT_EQ(file.mesh.triangles[1], (Triangle{1, 3, 2}));
    EXPECT_EQ(file.polygons, 1u);
    EXPECT_EQ(file.face_polygon, (std::vector<agvd::Index>{0, 1, 2, 2}));
}

TEST(Medit, TheLayoutIsFreeAndOtherListsArePassedOver) {
    const auto file = read_bytes(
        "a.mesh",
        "\nMeshVersionFormatted\n1\n\nDimension\n3\nEdges 1 1 2 0 Corners 2\n1\n2\nVertices 3 0 0 "
        "0 "
        "0 1 0\n0 0 0 1 0 0 RequiredVertices 1 2 Triangles 1 1 2 3 0 Tetrahedra\n1\n1 2 3 4 0\n"
        "Normals 1\n0 0 1\nNormalAtVertices\n1\n1 1\nEnd");
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(Medit, ReferencesAreLabelsUnlessAllAreZero) {
    const auto file = with_references(
        medit_head + four_vertices + "Quadrilaterals\n1\n1 2 4 3 -9\nTriangles\n1\n1 2 3 5\nEnd\n");
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].name, "ref");
    EXPECT_TRUE(remesh::is_label(file.attributes.of_faces[0]));
    EXPECT_EQ(file.attributes.of_faces[0].values, (std::vector<double>{-9, -9, 5}));
    ASSERT_EQ(file.attributes.of_vertices.size(), 1u);
    EXPECT_EQ(file.attributes.of_vertices[0].values, (std::vector<double>{1, 2, 3, 4}));
    EXPECT_TRUE(with_references(medit_head + four_vertices + "Triangles 1 1 2 3 0\nEnd")
                    .attributes.of_faces.empty());
}

TEST(Medit, WhatWasWrittenComesBack) {
    const agvd::TriangleMesh mesh = shapes::jitter(shapes::icosahedron(), 0.01, 3);
    remesh::MeshAttributes attributes;
    std::vector<double> labels(mesh.triangles.size(), 3);
    labels[4] = -7;
    attributes.of_faces.push_back({.name = "quality", .values = labels});
    attributes.of_faces.push_back(
        {.name = "label", .type = remesh::NumberType::Int16, .values = labels});
    attributes.of_faces.push_back(
        {.name = "other", .type = remesh::NumberType::Int16, .values = labels});
    const std::vector<std::string> removed = remesh::remove_unwritable("a.mesh", attributes);
    EXPECT_EQ(removed, (std::vector<std::string>{"face quality", "face other"}));
    const auto file = with_references(remesh::format_mesh("a.mesh", mesh.view(), attributes));
    EXPECT_EQ(file.mesh.positions, mesh.positions);
    EXPECT_EQ(file.mesh.triangles, mesh.triangles);
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].values, labels);
}

TEST(Medit, TruncatedFilesAreRefused) {
    const std::string text = medit_head + four_vertices + "Triangles\n2\n1 2 3 7\n2 4 3 8\nEnd";
    const std::size_t end_of_lists = text.size() - 4;
    for (std::size_t size = 1; size < text.size(); ++size) {
        if (size == end_of_lists || size == end_of_lists + 1) continue;
        expect_error<IoError>("a.mesh", text.substr(0, size), {"line"});
    }
}

TEST(Medit, WithoutEndCompleteListsAreReadWithAWarning) {
    const auto file = read_bytes("a.mesh", medit_head + four_vertices + "Triangles 1 1 2 3 7\n");
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("without 'End'"), std::string::npos);
}

TEST(Medit, WithoutFacesTheSurfaceOfVolumesIsRead) {
    const std::string five = "Vertices 5 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0 1 1 1 0\n";
    const auto file = with_references(medit_head + five +
                                      "Tetrahedra 2 1 2 3 4 7 4 3 2 5 8 RequiredTriangles 0 End");
    EXPECT_EQ(file.mesh.positions.size(), 5u);
    EXPECT_EQ(
        file.mesh.triangles,
        (std::vector<Triangle>{{0, 1, 3}, {2, 0, 3}, {0, 2, 1}, {4, 2, 3}, {4, 1, 2}, {4, 3, 1}}));
    EXPECT_EQ(file.attributes.of_faces.at(0).values, (std::vector<double>{7, 7, 7, 8, 8, 8}));
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("2 volume cells: their surface is read, the 6 faces"),
              std::string::npos)
        << file.warnings[0];
    expect_error<InvalidInput>("a.mesh", medit_head + five + "Tetrahedra 1 1 2 3 6 0 End",
                               {"line 4", "last of the 5"});
    expect_error<InvalidInput>("a.mesh", medit_head + five + "Tetrahedra 1 0 2 3 4 0 End",
                               {"from 1"});
}

TEST(Medit, WrongFilesAreRefused) {
    expect_error<IoError>("a.mesh", "OFF\n", {"line 1", "MeshVersionFormatted", ".meshb"});
    expect_error<IoError>("a.mesh", "MeshVersionFormatted 9\n", {"line 1", "version 9"});
    expect_error<IoError>("a.mesh", "MeshVersionFormatted 2 Dimension 2\n", {"three dimensions"});
    const std::string begin = medit_head + four_vertices;
    expect_error<IoError>("a.mesh", begin + "Trias 1\n", {"line 9", "'Trias'"});
    expect_error<IoError>("a.mesh", begin + "Triangles -1\n", {"negative"});
    expect_error<IoError>("a.mesh", begin + "Triangles 1 1 2 x 0\n", {"line 9", "'x'"});
    expect_error<IoError>("a.mesh", begin + "Triangles 1 1 2 3 99999999999\nEnd", {"32 bits"});
    expect_error<IoError>("a.mesh", begin + "Triangles 99999999999999\n1 2 3 0\n", {"truncated"});
    expect_error<InvalidInput>("a.mesh", begin + "Triangles 1\n1 2 5 0\nEnd",
                               {"line 10", "vertex 5", "counted from 1"});
    expect_error<InvalidInput>("a.mesh", begin + "Triangles 1\n1 2 0 0\nEnd",
                               {"line 10", "from 1"});
    expect_error<InvalidInput>("a.mesh", medit_head + "Vertices 1 0 nan 0 0\nEnd", {"not finite"});
    expect_error<InvalidInput>("a.mesh", begin + "End\n", {"4 vertices but no face"});
}

TEST(Medit, EdgesAreFeatureEdgesAndCornersAndRequiredElementsAreLocked) {
    using Edges = std::vector<std::array<agvd::Index, 2>>;
    const std::string lists =
        "Edges 4\n2 3 0\n2 1 5\n1 4 0\n9 1 0\nRidges 1 1\nRequiredEdges 2 2 7\n"
        "RequiredVertices 2 4 4\nCorners 2 1 9\nRequiredTriangles 1 1\n";
    const auto file = read_bytes(
        "a.mesh", medit_head + lists + four_vertices + "Triangles\n2\n1 2 3 7\n2 4 3 8\nEnd");
    EXPECT_EQ(file.feature_edges, (Edges{{1, 2}, {0, 1}}));
    EXPECT_EQ(file.locked_edges, (Edges{{0, 1}}));
    EXPECT_EQ(file.locked, (std::vector<agvd::Index>{0, 3}));
    ASSERT_EQ(file.warnings.size(), 2u);
    EXPECT_EQ(file.warnings[0], "a.mesh: RequiredTriangles are skipped");
    EXPECT_NE(file.warnings[1].find(": 4 edges, corners or required vertices"), std::string::npos)
        << file.warnings[1];
}

TEST(Medit, EdgesThatAreThoseOfAllFacesAreNoFeatureEdges) {
    const auto file =
        read_bytes("a.mesh", medit_head + four_vertices +
                                 "Triangles 1 1 2 3 0\nEdges 3 1 2 0 2 3 0 3 1 0\nEnd");
    EXPECT_TRUE(file.feature_edges.empty());
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("none is a feature edge"), std::string::npos);
}
