#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "support/read_text.h"

using agvd::InvalidInput;
using agvd::IoError;
using agvd::Triangle;
using agvd::Vec3;
using texts::expect_error;
using texts::read_bytes;

namespace {

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
    return "facet normal 0 0 1\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
           "\nendloop\nendfacet\n";
}

const std::string two_facets =
    facet("0 0 0", "1 0 0", "1 1 0") + facet("-0 0 0", "1 1 0", "0 1e0 0");

std::string binary(const std::string& title, std::uint32_t count,
                   const std::vector<float>& values) {
    std::string bytes = title;
    bytes.resize(84, ' ');
    std::memcpy(&bytes[80], &count, 4);
    for (std::size_t i = 0; i < values.size(); ++i) {
        bytes.append(reinterpret_cast<const char*>(&values[i]), 4);
        if (i % 12 == 11) bytes.append(2, '\0');
    }
    return bytes;
}

const std::vector<float> two_records = {0, 0, 1, 0,    0, 0, 1, 0, 0, 1, 1, 0,
                                        0, 0, 1, -0.f, 0, 0, 1, 1, 0, 0, 1, 0};

void expect_welded_square(const std::string& bytes) {
    const auto file = read_bytes("a.stl", bytes);
    EXPECT_EQ(file.mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(file.welded_vertices, 2u);
}

}  // namespace

TEST(Stl, AsciiIsReadAndWelded) {
    expect_welded_square("solid name of it\n" + two_facets + "endsolid name of it\n");
    expect_welded_square("  solid\n" + two_facets + "endsolid");
    expect_welded_square("solid a\n" + facet("0 0 0", "1 0 0", "1 1 0") + "endsolid a\nsolid b\n" +
                         facet("0 0 0", "1 1 0", "0 1 0") + "endsolid b\n");
}

TEST(Stl, AsciiMayBeUpperCaseAndLaidOutFreely) {
    std::string text = "solid x\n" + two_facets + "endsolid x\n";
    for (char& c : text) c = static_cast<char>(std::toupper(c));
    expect_welded_square(text);
    expect_welded_square(
        "solid\r\n"
        "facet normal nan -nan(ind) 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 "
        "0 endloop endfacet\r\n"
        "facet normal 0 0 1 outer loop\r\n\r\nvertex 0 0 0 vertex 1 1 0\r\nvertex 0 1 "
        "0 endloop endfacet endsolid\r\n");
}

TEST(Stl, BinaryIsReadAndWelded) {
    expect_welded_square(binary("made by hand", 2, two_records));
    expect_welded_square(binary("made by hand", 2, two_records) + "trailing bytes");
}

TEST(Stl, BinaryThatBeginsWithSolidIsKnownByItsSize) {
    expect_welded_square(binary("solid made by a CAD program", 2, two_records));
    const std::string bytes = binary("solid cut short", 2, two_records);
    expect_error<IoError>("a.stl", bytes.substr(0, bytes.size() - 1),
                          {"byte 183", "1 of 2 triangles", "truncated"});
}

TEST(Stl, ACountOfZeroIsAnErrorThatNamesWhatTheFileHoldsAndLenientlyThatIsRead) {
    const std::string bytes = binary("never filled in", 0, two_records);
    expect_error<IoError>("a.stl", bytes, {"announces 0 triangles, the file holds 2", "--lenient"});
    const auto file = remesh::read_stl({.path = "a.stl", .bytes = bytes, .is_lenient = true});
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("announces 0 triangles, the file holds 2"), std::string::npos);
    expect_error<InvalidInput>("a.stl", bytes + "x", {"neither a vertex nor a face"});
}

TEST(Stl, NearbyPointsStayApart) {
    const float next = std::nextafter(1.f, 2.f);
    const auto file = read_bytes("a.stl", binary("", 2, {0, 0, 1, 0, 0, 0, 1,    0, 0, 1, 1, 0,
                                                         0, 0, 1, 0, 0, 0, next, 0, 0, 1, 1, 0}));
    EXPECT_EQ(file.mesh.positions.size(), 4u);
    EXPECT_EQ(file.welded_vertices, 2u);
}

TEST(Stl, DegenerateTrianglesAreKept) {
    const auto file =
        read_bytes("a.stl", "solid\n" + facet("0 0 0", "0 0 0", "1 0 0") + "endsolid\n");
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 0, 1}}));
}

TEST(Stl, TruncatedFilesAreRefused) {
    const std::string ascii = "solid\n" + two_facets + "endsolid";
    for (std::size_t size = 5; size < ascii.size(); ++size) {
        expect_error<IoError>("a.stl", ascii.substr(0, size), {"line"});
    }
    const std::string bytes = binary("", 2, two_records);
    for (std::size_t size = 1; size < bytes.size(); ++size) {
        expect_error<IoError>("a.stl", bytes.substr(0, size), {"byte"});
    }
    expect_error<IoError>("a.stl", binary("", 4294967295u, two_records), {"2 of 4294967295"});
}

TEST(Stl, WrongTextIsRefused) {
    expect_error<IoError>("a.stl", "solid\nface normal 0 0 1\n", {"line 2", "'facet'", "'face'"});
    expect_error<IoError>("a.stl", "solid\nfacet normal 0 0 1\nvertex 0 0 0\n",
                          {"line 3", "'outer'"});
    expect_error<IoError>("a.stl", "solid\n" + facet("0 0", "1 0 0", "0 1 0") + "endsolid\n",
                          {"line 4", "coordinate"});
    expect_error<InvalidInput>("a.stl",
                               "solid\n" + facet("0 0 nan", "1 0 0", "0 1 0") + "endsolid\n",
                               {"line 4", "not finite"});
    expect_error<InvalidInput>("a.stl", "solid\nendsolid\n", {"nor a face"});
}

TEST(Stl, WrongBinaryValuesAreRefused) {
    std::vector<float> values = two_records;
    values[16] = NAN;
    expect_error<InvalidInput>("a.stl", binary("", 2, values),
                               {"byte 146", "triangle 1", "not finite"});
    expect_error<InvalidInput>("a.stl", binary("", 0, {}), {"nor a face"});
}

// Several solids are labels, which keep their names in ascii STL.
TEST(ReadStl, NamesOfSolidsAreLabels) {
    const std::string text = "# made by hand\nsolid inlet pipe\n" +
                             facet("0 0 0", "1 0 0", "1 1 0") +
                             "endsolid inlet pipe\nsolid wall\n" +
                             facet("0 0 0", "1 1 0", "0 1 0") + "# more\nendsolid wall\n";
    const remesh::MeshFile file = remesh::read_mesh_bytes(text, "a.stl", {.with_attributes = true});
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    const remesh::Attribute& solid = file.attributes.of_faces[0];
    EXPECT_EQ(solid.name, "solid");
    EXPECT_EQ(solid.values, (std::vector<double>{0, 1}));
    EXPECT_EQ(solid.names, (std::vector<std::string>{"inlet pipe", "wall"}));
    remesh::MeshAttributes values{.of_faces = {solid}};
    EXPECT_TRUE(remesh::remove_unwritable("b.stl", values).empty());
    const std::string written = remesh::format_mesh("b.stl", file.mesh.view(), values);
    EXPECT_EQ(written.find("solid inlet pipe\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"), 0u);
    const remesh::MeshFile back =
        remesh::read_mesh_bytes(written, "b.stl", {.with_attributes = true});
    EXPECT_EQ(back.attributes.of_faces[0].names, solid.names);
    EXPECT_EQ(back.mesh.positions, file.mesh.positions);
    const remesh::MeshFile one = remesh::read_mesh_bytes("solid a\n" + two_facets + "endsolid a\n",
                                                         "a.stl", {.with_attributes = true});
    EXPECT_TRUE(one.attributes.empty());
}

TEST(ReadStl, WordsBehindKeywordsAreSkipped) {
    std::string text = "solid a\n" + two_facets + "endsolid a\n";
    for (const char* keyword : {"endloop", "endfacet"}) {
        for (std::size_t at = text.find(keyword); at != std::string::npos;
             at = text.find(keyword, at + 1)) {
            text.insert(at + std::strlen(keyword), " x 7");
        }
    }
    expect_welded_square(text);
}

TEST(ReadStl, AWebPageIsCalledThat) {
    for (const char* page :
         {"<!DOCTYPE html>\n<title>Sign in</title>", "  <HTML><body></body></HTML>"}) {
        expect_error<IoError>("a.stl", page, {"HTML page", "download the mesh itself"});
    }
}
