// Physical groups of Gmsh as labels of faces, read and written.
#include <gtest/gtest.h>

#include "support/msh_text.h"
#include "support/read_text.h"
#include "support/shapes.h"

using agvd::Triangle;
using texts::read_bytes;
using Values = std::vector<double>;

namespace {

remesh::MeshFile read_groups(const std::string& bytes) { return read_bytes("a.msh", bytes, true); }

}  // namespace

TEST(MshGroups, PartsOfAPartitionHaveTheGroupsOfWhatTheyArePartOf) {
    const auto file = read_groups(
        msh::text_4 +
        "$Entities\n0 0 1 1\n1 0 0 0 1 1 0 1 5 0\n1 0 0 0 1 1 1 1 6 0\n$EndEntities\n"
        "$PartitionedEntities\n2\n1\n9 1\n0 0 2 0\n"
        "4 2 1 1 1 0 0 0 1 1 0 1 5 1 -1\n8 3 1 2 1 2 0 0 0 1 1 0 1 6 0\n$EndPartitionedEntities\n" +
        msh::three_nodes_4 +
        "$Elements\n2 2 1 2\n2 8 2 1\n1 3 2 1\n2 4 2 1\n2 1 2 3\n$EndElements\n");
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}))
        << "the other one lies between two parts of a volume";
    EXPECT_EQ(file.attributes.of_faces.at(0).values, (Values{5}));
}

TEST(MshGroups, OfSeveralGroupsTheFirstOneCounts) {
    const auto file =
        read_groups(msh::text_4 + "$Entities\n0 0 1 0\n1 0 0 0 1 1 0 2 8 5 0\n$EndEntities\n" +
                    msh::three_nodes_4 + msh::one_triangle_4);
    EXPECT_EQ(file.attributes.of_faces.at(0).values, (Values{8}));
    EXPECT_TRUE(file.attributes.of_faces.at(0).names.empty());
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("a.msh: some entities are in several"), std::string::npos);
}

TEST(MshGroups, TrianglesAreWrittenAsTextOfVersion22) {
    remesh::MeshAttributes attributes;
    attributes.of_faces.push_back({.name = "group",
                                   .type = remesh::NumberType::Int32,
                                   .values = {2, 0},
                                   .names = {"", "unused", "the \"wet\" side"}});
    const agvd::TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, .1, 0}, {1, 1, -1e-7}},
                                  {{0, 1, 2}, {1, 3, 2}}};
    EXPECT_EQ(remesh::format_mesh("a.msh", mesh.view(), attributes),
              msh::text_2 +
                  "$PhysicalNames\n1\n2 2 \"the 'wet' side\"\n$EndPhysicalNames\n"
                  "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 0.1 0\n4 1 1 -1e-07\n$EndNodes\n"
                  "$Elements\n2\n1 2 2 2 2 1 2 3\n2 2 2 0 1 2 4 3\n$EndElements\n");
}

TEST(MshGroups, WhatWasWrittenComesBack) {
    const agvd::TriangleMesh mesh = shapes::jitter(shapes::icosahedron(), 0.01, 3);
    Values labels(mesh.triangles.size(), 3);
    labels[4] = 12;
    remesh::MeshAttributes attributes;
    attributes.of_faces.push_back({.name = "quality", .values = labels});
    attributes.of_faces.push_back(
        {.name = "part", .type = remesh::NumberType::Int16, .values = Values(labels.size(), 1)});
    attributes.of_faces.push_back(
        {.name = "group", .type = remesh::NumberType::Int16, .values = labels});
    const std::vector<std::string> removed = remesh::remove_unwritable("a.msh", attributes);
    EXPECT_EQ(removed, (std::vector<std::string>{"face quality", "face part"}));
    const auto file = read_groups(remesh::format_mesh("a.msh", mesh.view(), attributes));
    EXPECT_EQ(file.mesh.positions, mesh.positions);
    EXPECT_EQ(file.mesh.triangles, mesh.triangles);
    EXPECT_EQ(file.attributes.of_faces.at(0).values, labels);
    EXPECT_TRUE(file.attributes.of_faces.at(0).names.empty());
}

// OBJ counts its labels from 0, Gmsh its groups from 1.
TEST(MshGroups, ALabelZeroThatHasANameIsGroupOne) {
    const auto obj = read_bytes("a.obj",
                                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nusemtl brass\nf 1 2 3\n"
                                "usemtl oak\nf 2 4 3\n",
                                true);
    const auto file = read_groups(remesh::format_mesh("a.msh", obj.mesh.view(), obj.attributes));
    const remesh::Attribute& groups = file.attributes.of_faces.at(0);
    EXPECT_EQ(groups.values, (Values{1, 2}));
    EXPECT_EQ(groups.names, (std::vector<std::string>{"", "brass", "oak"}));
    const auto again =
        read_bytes("b.obj", remesh::format_mesh("b.obj", file.mesh.view(), file.attributes), true);
    EXPECT_EQ(again.attributes.of_faces.at(0).name, "group");
    EXPECT_EQ(again.attributes.of_faces.at(0).names, (std::vector<std::string>{"brass", "oak"}));
}

TEST(MshGroups, LabelsBelowOneAreInNoGroup) {
    const auto ply = read_bytes("a.ply",
                                "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                                "property float y\nproperty float z\nelement face 3\n"
                                "property list uchar int vertex_indices\nproperty int part\n"
                                "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 0\n3 1 3 2 5\n"
                                "3 0 1 3 -4\n",
                                true);
    const auto file = read_groups(remesh::format_mesh("a.msh", ply.mesh.view(), ply.attributes));
    EXPECT_EQ(file.attributes.of_faces.at(0).values, (Values{0, 5, 0}));
}

TEST(MshGroups, NamesOfGroupsWithLargeNumbersAreDeclined) {
    const auto file =
        read_groups(msh::text_2 + "$PhysicalNames\n1\n2 65536 \"far\"\n$EndPhysicalNames\n" +
                    msh::three_nodes_2 + "$Elements\n1\n1 2 2 65536 1 1 2 3\n$EndElements\n");
    EXPECT_EQ(file.attributes.of_faces.at(0).values, (Values{65536}));
    EXPECT_TRUE(file.attributes.of_faces.at(0).names.empty());
    ASSERT_EQ(file.attributes.declined.size(), 1u);
    EXPECT_EQ(file.attributes.declined[0].name, "names of physical groups");
}

TEST(MshGroups, PlyHasCommentsOfNamesOnly) {
    const auto file = read_groups(
        msh::text_2 + "$PhysicalNames\n1\n2 2 \"wet walls\"\n$EndPhysicalNames\n" +
        msh::three_nodes_2 + "$Elements\n2\n1 2 1 2 1 2 3\n2 2 1 4 3 2 1\n$EndElements\n");
    const std::string ply = remesh::format_mesh("a.ply", file.mesh.view(), file.attributes);
    EXPECT_NE(ply.find("\ncomment group 2 wet walls\ncomment group 4 4\n"), std::string::npos);
    EXPECT_EQ(ply.find("comment group 0"), std::string::npos);
}

TEST(MshGroups, SeveralGroupsOfEdgesDoNotMatter) {
    const auto file = read_groups(
        msh::text_4 +
        "$Entities\n0 1 1 0\n1 0 0 0 1 1 0 2 8 5 0\n1 0 0 0 1 1 0 1 8 0\n$EndEntities\n" +
        msh::three_nodes_4 + msh::one_triangle_4);
    EXPECT_EQ(file.attributes.of_faces.at(0).values, (Values{8}));
    EXPECT_TRUE(file.warnings.empty());
}

TEST(MshGroups, WhatIsInNoGroupHasNoNameAndWhatHasNoneGetsNone) {
    const std::string names = "$PhysicalNames\n1\n2 2 \"walls\"\n$EndPhysicalNames\n";
    const std::string rest = msh::three_nodes_2 +
                             "$Elements\n3\n1 2 2 0 1 1 2 3\n2 2 2 2 2 3 2 1\n3 2 2 4 3 3 1 2\n"
                             "$EndElements\n";
    const auto file = read_groups(
        msh::text_2 + "$PhysicalNames\n2\n2 0 \"nothing\"\n2 2 \"walls\"\n$EndPhysicalNames\n" +
        rest);
    EXPECT_EQ(file.attributes.of_faces.at(0).names,
              (std::vector<std::string>{"", "", "walls", "", "4"}));
    EXPECT_EQ(remesh::format_mesh("a.msh", file.mesh.view(), file.attributes),
              msh::text_2 + names + rest);
}
