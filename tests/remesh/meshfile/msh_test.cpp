// Gmsh's .msh in both versions, as text and in binary.
#include <gtest/gtest.h>

#include "support/msh_text.h"
#include "support/read_text.h"

using agvd::InvalidInput;
using agvd::IoError;
using agvd::Triangle;
using agvd::Vec3;
using texts::expect_error;
using texts::read_bytes;
using Values = std::vector<double>;

namespace {

remesh::MeshFile with_groups(const std::string& bytes) { return read_bytes("a.msh", bytes, true); }

void add_names(msh::Text& text) {
    text.raw(
        "$PhysicalNames\n3\n1 4 \"a curve\"\n2 7 \"wet walls\"\n3 7 \"body\"\n$EndPhysicalNames\n");
}

// A point, a curve of one edge, a triangle of group 7 and a quad of group 9.
void add_mesh_2(msh::Text& text) {
    text.raw("$Nodes\n4\n");
    for (const auto& [tag, p] : {std::pair(10, Vec3(0, 0, 0)), std::pair(3, Vec3(1, 0, 0)),
                                 std::pair(7, Vec3(0, 1, 0)), std::pair(5, Vec3(1, 1, 0.5))}) {
        text.integers({tag}).reals({p.x(), p.y(), p.z()}).raw(text.form().is_binary ? "" : "\n");
    }
    text.end_line().raw("$EndNodes\n$Elements\n4\n");
    const auto element = [&](int tag, int type, std::initializer_list<int> tags,
                             std::initializer_list<int> nodes) {
        const int num_tags = static_cast<int>(tags.size());
        if (text.form().is_binary) {
            text.integers({type, 1, num_tags, tag});
        } else {
            text.integers({tag, type, num_tags});
        }
        text.integers(tags).integers(nodes).raw(text.form().is_binary ? "" : "\n");
    };
    element(1, 15, {0, 1}, {10});
    element(2, 1, {4, 1}, {10, 3});
    element(30, 2, {7, 1, 1, 4}, {10, 3, 7});
    element(4, 3, {9, 2}, {10, 3, 5, 7});
    text.end_line().raw("$EndElements\n");
}

// The same. Of the second block of nodes the parameters are given as well.
void add_mesh_4(msh::Text& text) {
    text.raw("$Entities\n").sizes({1, 1, 2, 0});
    text.integers({1}).reals({0, 0, 0}).sizes({0});
    text.integers({1})
        .reals({0, 0, 0, 1, 0, 0})
        .sizes({1})
        .integers({4})
        .sizes({2})
        .integers({1, -1});
    text.integers({1}).reals({0, 0, 0, 1, 1, 0}).sizes({1}).integers({7}).sizes({0});
    text.integers({2}).reals({0, 0, 0, 1, 1, 1}).sizes({1}).integers({-9}).sizes({1}).integers({1});
    text.end_line().raw("$EndEntities\n$Nodes\n").sizes({3, 4, 3, 10});
    text.integers({0, 1, 0}).sizes({1}).tags({10}).reals({0, 0, 0});
    text.integers({2, 1, 1}).sizes({2}).tags({3, 7}).reals({1, 0, 0, .1, .2, 0, 1, 0, .3, .4});
    text.integers({2, 2, 0}).sizes({1}).tags({5}).reals({1, 1, 0.5});
    text.end_line().raw("$EndNodes\n$Elements\n").sizes({4, 4, 1, 30});
    text.integers({0, 1, 15}).sizes({1}).tags({1, 10});
    text.integers({1, 1, 1}).sizes({1}).tags({2, 10, 3});
    text.integers({2, 1, 2}).sizes({1}).tags({30, 10, 3, 7});
    text.integers({2, 2, 3}).sizes({1}).tags({4, 10, 3, 5, 7});
    text.end_line().raw("$EndElements\n");
}

std::string mesh_in(const msh::Form& form) {
    msh::Text text(form);
    add_names(text);
    form.is_version_2 ? add_mesh_2(text) : add_mesh_4(text);
    return text.bytes();
}

class MshForms : public testing::TestWithParam<msh::Form> {};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Msh, MshForms,
                         testing::Values(msh::Form{true, false}, msh::Form{true, true},
                                         msh::Form{true, true, std::endian::big},
                                         msh::Form{false, false}, msh::Form{false, true},
                                         msh::Form{false, true, std::endian::big},
                                         msh::Form{false, true, std::endian::little, 4}));

TEST_P(MshForms, NodesFacesAndGroupsAreRead) {
    const auto file = with_groups(mesh_in(GetParam()));
    EXPECT_EQ(file.mesh.positions,
              (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, .5}}));
    ASSERT_EQ(file.mesh.triangles.size(), 3u);
    EXPECT_EQ(file.mesh.triangles[0], (Triangle{0, 1, 2}));
    EXPECT_EQ(file.polygons, 1u);
    EXPECT_EQ(file.face_polygon, (std::vector<agvd::Index>{0, 1, 1}));
    EXPECT_TRUE(file.attributes.of_vertices.empty());
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    const remesh::Attribute& groups = file.attributes.of_faces[0];
    EXPECT_EQ(groups.name, "group");
    EXPECT_TRUE(remesh::is_label(groups));
    EXPECT_EQ(groups.values, (Values{7, 9, 9}));
    EXPECT_EQ(groups.names,
              (std::vector<std::string>{"", "", "", "", "", "", "", "wet walls", "", "9"}));
    EXPECT_TRUE(file.warnings.empty()) << file.warnings[0];
}

TEST_P(MshForms, TruncatedFilesAreRefused) {
    const std::string bytes = mesh_in(GetParam());
    const auto has = [](const std::exception& error, const char* words) {
        return std::string(error.what()).find(words) != std::string::npos;
    };
    for (std::size_t size = 1; size + 1 < bytes.size(); ++size) {
        try {
            static_cast<void>(with_groups(bytes.substr(0, size)));
            ADD_FAILURE() << "read without complaint: " << size << " of " << bytes.size();
        } catch (const IoError& error) {
            EXPECT_TRUE(has(error, "line ") || has(error, "byte ")) << error.what();
        } catch (const InvalidInput& error) {
            // Whole sections are left, or of a number the first digits.
            EXPECT_TRUE(has(error, "face") || has(error, "names node 1,")) << error.what();
        }
    }
}

TEST(Msh, NodesWithoutGapsMayComeInAnyOrder) {
    const auto file =
        read_bytes("a.msh", msh::text_2 + "$Nodes\n3\n3 0 1 0\n1 0 0 0\n2 1 0 0\n$EndNodes\n" +
                                msh::one_triangle_2);
    EXPECT_EQ(file.mesh.positions, (std::vector<Vec3>{{0, 1, 0}, {0, 0, 0}, {1, 0, 0}}));
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{1, 2, 0}}));
}

// In binary files the end of the line before the numbers matters.
TEST_P(MshForms, LinesMayEndInCarriageReturnAndLineFeed) {
    std::string bytes = mesh_in(GetParam());
    for (const std::string word : {"$MeshFormat", " 8", " 4", "$Nodes", "$Entities", "$Elements",
                                   "$Nodes\r\n4", "$Elements\r\n4", "wet walls\""}) {
        const std::size_t at = bytes.find(word + '\n');
        if (at != std::string::npos) bytes.insert(at + word.size(), 1, '\r');
    }
    const auto file = with_groups(bytes);
    ASSERT_EQ(file.mesh.positions.size(), 4u);
    EXPECT_EQ(file.mesh.positions[3], Vec3(1, 1, .5));
    EXPECT_EQ(file.attributes.of_faces.at(0).values, (Values{7, 9, 9}));
}

TEST(Msh, OtherSectionsArePassedOver) {
    const auto file =
        with_groups(msh::text_2 + "$Comments\n$Nodes are below\n$EndComments\n" +
                    msh::three_nodes_2 + msh::one_triangle_2 +
                    "$Periodic\n1\n0 1 2\n1\n1 "
                    "2\n$EndPeriodic\n$ElementNodeData\n1\n\"h\"\n$EndElementNodeData\n");
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    EXPECT_TRUE(file.attributes.of_faces.empty()) << "there is no group";
    ASSERT_EQ(file.attributes.declined.size(), 1u);
    EXPECT_EQ(file.attributes.declined[0].name, "section ElementNodeData");
    for (const std::string name : {"NodeData", "ElementData"}) {
        const auto early =
            with_groups(msh::text_2 + "$" + name + "\n1\n\"h\"\n0\n3\n0\n1\n0\n$End" + name + "\n" +
                        msh::three_nodes_2 + msh::one_triangle_2);
        ASSERT_EQ(early.attributes.declined.size(), 1u);
        EXPECT_EQ(early.attributes.declined[0].name, "section " + name);
    }
}

TEST_P(MshForms, ValuesOfNodesAndFacesAreRead) {
    msh::Text text(GetParam());
    GetParam().is_version_2 ? add_mesh_2(text) : add_mesh_4(text);
    text.raw("$NodeData\n2\n\"edge length\"\n\"scheme\"\n1\n0.5\n4\n0\n1\n5\n0\n");
    for (const int node : {5, 99, 10, 3, 7}) text.integers({node}).reals({node / 8.0});
    text.end_line().raw("$EndNodeData\n$NodeData\n1\n\"part\"\n0\n3\n0\n1\n1\n");
    text.integers({10}).reals({1}).end_line().raw("$EndNodeData\n");
    text.raw("$ElementData\n1\n\"group\"\n0\n3\n0\n1\n2\n");
    text.integers({4}).reals({.5}).integers({30}).reals({2}).end_line().raw("$EndElementData\n");
    text.raw("$ElementData\n1\n\"flow\"\n0\n3\n0\n3\n2\n").integers({4}).reals({1, 2, 3});
    text.integers({30}).reals({4, 5, 6}).end_line().raw("$EndElementData\n");
    const remesh::MeshAttributes attributes = with_groups(text.bytes()).attributes;
    ASSERT_EQ(attributes.of_vertices.size(), 1u);
    EXPECT_EQ(attributes.of_vertices[0].name, "edge_length");
    EXPECT_EQ(attributes.of_vertices[0].values, (Values{10 / 8.0, 3 / 8.0, 7 / 8.0, 5 / 8.0}));
    ASSERT_EQ(attributes.of_faces.size(), 4u);
    EXPECT_EQ(attributes.of_faces[0].values, (Values{7, 9, 9})) << "the groups";
    EXPECT_EQ(attributes.of_faces[1].name, "flow_0");
    EXPECT_EQ(attributes.of_faces[1].values, (Values{4, 1, 1}));
    EXPECT_EQ(attributes.of_faces[3].values, (Values{6, 3, 3}));
    ASSERT_EQ(attributes.declined.size(), 2u);
    EXPECT_EQ(attributes.declined[0].name, "vertex part");
    EXPECT_EQ(attributes.declined[1].name, "face group");
}

TEST(Msh, DamagedValuesAreRefused) {
    const auto values = [](const std::string& text) {
        return msh::text_2 + msh::three_nodes_2 + msh::one_triangle_2 + "$NodeData\n" + text +
               "$EndNodeData\n";
    };
    const auto expect = [&](const std::string& text, const std::vector<std::string>& words) {
        expect_error<IoError>("a.msh", values(text), words, true);
    };
    expect("1\nh\n0\n3\n0\n1\n0\n", {"line 16", "quotes"});
    expect("1\n\"h\"\n0\n2\n0\n1\n", {"line 18", "three integers"});
    expect("1\n\"h\"\n0\n3\n0\n65\n0\n", {"line 20", "65 components"});
    expect("1\n\"h\"\n0\n3\n0\n1\n2\n1 5\n", {"line 23", "number of a node"});
    expect("1\n\"h\"\n0\n3\n0\n1\n1\n1 5\n2 5\n", {"line 23", "'$EndNodeData'", "'2'"});
    expect_error<IoError>("a.msh",
                          msh::text_2 + msh::three_nodes_2 + msh::one_triangle_2 +
                              "$ElementData\n1\n\"h\"\n0\n3\n0\n1\n1\n1 5\n$EndElementData\n" +
                              msh::one_triangle_2,
                          {"array 'h' has 1 numbers for 2 elements"}, true);
}

TEST(Msh, WithoutFacesTheSurfaceOfVolumesIsRead) {
    const std::string head = msh::text_2 +
                             "$PhysicalNames\n2\n3 1 \"steel\"\n2 1 \"skin\"\n$EndPhysicalNames\n"
                             "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n";
    const std::string tetrahedra = "1 4 2 1 1 1 2 3 4\n2 4 2 2 1 4 3 2 5\n";
    const auto file = with_groups(head + "$Elements\n2\n" + tetrahedra + "$EndElements\n");
    EXPECT_EQ(
        file.mesh.triangles,
        (std::vector<Triangle>{{0, 1, 3}, {2, 0, 3}, {0, 2, 1}, {4, 2, 3}, {4, 1, 2}, {4, 3, 1}}));
    EXPECT_EQ(file.attributes.of_faces.at(0).values, (Values{1, 1, 1, 2, 2, 2}));
    EXPECT_EQ(file.attributes.of_faces.at(0).names, (std::vector<std::string>{"", "steel", "2"}));
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("2 volume cells: their surface is read, the 6 faces"),
              std::string::npos)
        << file.warnings[0];
    const auto with_face =
        with_groups(head + "$Elements\n3\n" + tetrahedra + "3 2 2 1 1 1 3 2\n$EndElements\n");
    EXPECT_EQ(with_face.mesh.triangles, (std::vector<Triangle>{{0, 2, 1}}));
    EXPECT_EQ(with_face.attributes.of_faces.at(0).names, (std::vector<std::string>{"", "skin"}));
}

// Of a box with the corners 1 to 8 and a roof.
TEST(Msh, AllKindsOfVolumesHaveTheirFaces) {
    const std::string nodes =
        "$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n"
        "$EndNodes\n$Elements\n1\n";
    const auto area_of = [&](const std::string& element) {
        const auto file = read_bytes("a.msh", msh::text_2 + nodes + element + "\n$EndElements\n");
        double area = 0;
        for (const auto& [a, b, c] : file.mesh.triangles) {
            const auto& p = file.mesh.positions;
            area += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
        }
        return area;
    };
    EXPECT_NEAR(area_of("1 5 2 0 1 1 2 3 4 5 6 7 8"), 6, 1e-12);
    EXPECT_NEAR(area_of("1 6 2 0 1 1 2 3 5 6 7"), 3 + std::sqrt(2), 1e-12);
    EXPECT_NEAR(area_of("1 7 2 0 1 1 2 3 4 5"), 2 + std::sqrt(2), 1e-12);
}

TEST(Msh, CurvedElementsAreReadByTheirCorners) {
    const auto file = read_bytes(
        "a.msh", msh::text_2 +
                     "$Nodes\n6\n1 0 0 0\n2 2 0 0\n3 0 2 0\n4 1 0 0\n5 1 1 0\n6 0 1 0\n$EndNodes\n"
                     "$Elements\n2\n1 9 2 0 1 1 2 3 4 5 6\n2 8 2 0 1 1 2 4\n$EndElements\n");
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("a.msh: 1 curved element: read as flat ones"),
              std::string::npos)
        << file.warnings[0];
}

TEST(Msh, WrongFilesAreRefused) {
    expect_error<IoError>("a.msh", "OFF\n", {"line 1", "'$Nodes'"});
    expect_error<IoError>("a.msh", "$NOD\n3\n", {"line 1", "$MeshFormat"});
    expect_error<IoError>("a.msh", "$MeshFormat\n4 0 8\n", {"line 2", "version 4 ", "msh41"});
    expect_error<IoError>("a.msh", "$MeshFormat\n3.1 0 8\n", {"line 2", "version 3.1 "});
    expect_error<IoError>("a.msh", "$MeshFormat\n4.1 2 8\n", {"line 2", "kind of the file is 2"});
    expect_error<IoError>("a.msh", "$MeshFormat\n4.1 0 16\n", {"line 2", "16 bytes"});
    expect_error<IoError>("a.msh", "$MeshFormat\n2.2 0 4\n", {"line 2", "4 bytes"});
    expect_error<IoError>("a.msh", "$MeshFormat\n4.1 1 8\nabcd\n", {"byte 20", "order of bytes"});
    expect_error<IoError>("a.msh", msh::text_2 + "Nodes\n", {"line 4", "'$Nodes'", "'Nodes'"});
    expect_error<IoError>("a.msh", msh::text_2 + "$EndNodes\n", {"line 4", "'$EndNodes'"});
    expect_error<IoError>("a.msh", msh::text_2 + "$Remark\nnothing\n", {"line 4", "'$EndRemark'"});
    expect_error<IoError>("a.msh", msh::text_2 + "$PhysicalNames\n1\n2 1 walls\n",
                          {"line 6", "quotes", "'walls'"});
    expect_error<IoError>("a.msh", msh::text_2 + "$ParametricNodes\n1\n$EndParametricNodes\n",
                          {"line 6", "parametric"});
    expect_error<InvalidInput>("a.msh", msh::text_2 + msh::three_nodes_2,
                               {"3 vertices but no face"});
    expect_error<IoError>("a.msh", msh::text_2 + msh::three_nodes_2 + msh::three_nodes_2,
                          {"line 10", "twice"});
}

TEST(Msh, WrongNodesAreRefused) {
    const auto nodes = [](const std::string& text) {
        return msh::text_2 + "$Nodes\n" + text + "$EndNodes\n" + msh::one_triangle_2;
    };
    expect_error<IoError>("a.msh", nodes("2\n1 0 0 0\n2 1 0 0\n3 0 1 0\n"),
                          {"line 8", "'$EndNodes'", "'3'"});
    expect_error<IoError>("a.msh", nodes("4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n"),
                          {"line 9", "number of a node", "'$EndNodes'"});
    expect_error<IoError>("a.msh", nodes("-1\n"), {"line 5", "negative"});
    expect_error<IoError>("a.msh", nodes("1\n-1 0 0 0\n"), {"line 6", "negative"});
    expect_error<IoError>("a.msh", nodes("1\n1 0 zero 0\n"), {"line 6", "'zero'"});
    expect_error<InvalidInput>("a.msh", nodes("2\n1 0 0 0\n2 0 inf 0\n"),
                               {"line 7", "node 1 (from 0) is not finite"});
    expect_error<InvalidInput>("a.msh", nodes("3\n1 0 0 0\n2 1 0 0\n1 0 1 0\n"),
                               {"several nodes have the number 1"});
    expect_error<IoError>("a.msh", msh::text_4 + "$Nodes\n1 4 1 3\n2 1 0 1\n1\n0 0 0\n$EndNodes\n",
                          {"line 8", "1 nodes, but 4 are announced"});
    expect_error<IoError>("a.msh", msh::text_4 + "$Nodes\n1 1 1 1\n4 1 0 1\n1\n0 0 0\n$EndNodes\n",
                          {"line 6", "dimension is 4"});
    expect_error<IoError>("a.msh", nodes("99999999999999\n1 0 0 0\n"), {"line 7"});
}

TEST(Msh, WrongElementsAreRefused) {
    const auto elements = [](const std::string& text) {
        return msh::text_2 + msh::three_nodes_2 + "$Elements\n" + text + "$EndElements\n";
    };
    expect_error<InvalidInput>("a.msh", elements("1\n8 2 2 0 1 1 2 4\n"),
                               {"line 12", "element 8 names node 4", "3 nodes"});
    expect_error<InvalidInput>("a.msh", elements("1\n8 4 2 0 1 1 2 3 0\n"),
                               {"line 12", "element 8 names node 0"});
    expect_error<IoError>("a.msh", elements("1\n1 94 2 0 1 1 2 3\n"),
                          {"line 12", "elements of type 94", "order 1"});
    expect_error<IoError>("a.msh", elements("1\n1 2 -1 1 2 3\n"), {"line 12", "tags is negative"});
    expect_error<IoError>("a.msh", elements("2\n1 2 2 0 1 1 2 3\n"),
                          {"line 13", "number of an element", "'$EndElements'"});
    expect_error<IoError>("a.msh", elements("0\n1 2 2 0 1 1 2 3\n"),
                          {"line 12", "'$EndElements'", "'1'"});
    expect_error<IoError>("a.msh", elements("1\n1 2 2 2147483648 1 1 2 3\n"), {"32 bits"});
    expect_error<IoError>("a.msh", elements("1\n1 2 2 -9223372036854775808 1 1 2 3\n"),
                          {"32 bits"});
    expect_error<InvalidInput>("a.msh", msh::text_2 + msh::one_triangle_2, {"line 6", "0 nodes"});
    expect_error<IoError>(
        "a.msh",
        msh::text_4 + msh::three_nodes_4 + "$Elements\n1 2 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n",
        {"1 elements, but 2 are announced"});
    msh::Text binary({.is_version_2 = true, .is_binary = true});
    binary.raw("$Elements\n1\n").integers({2, 2, 2, 1});
    expect_error<IoError>("a.msh", binary.bytes(), {"byte ", "2 of the 1 elements"});
}
