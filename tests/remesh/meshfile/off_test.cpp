#include <gtest/gtest.h>

#include "remesh/meshfile/numbers.h"
#include "support/read_text.h"

using agvd::InvalidInput;
using agvd::IoError;
using agvd::Triangle;
using agvd::Vec3;
using texts::expect_error;
using texts::read_bytes;

namespace {

const std::string three_vertices = "0 0 0\n1 0 0\n0 1 0\n";

void expect_one_off_triangle(const std::string& bytes) {
    const auto file = read_bytes("a.off", bytes);
    ASSERT_EQ(file.mesh.positions.size(), 3u) << bytes;
    EXPECT_EQ(file.mesh.positions[1], Vec3(1, 0, 0)) << bytes;
    EXPECT_EQ(file.mesh.positions[2], Vec3(0, 1, 0)) << bytes;
    ASSERT_EQ(file.mesh.triangles.size(), 1u) << bytes;
    EXPECT_EQ(file.mesh.triangles[0], (Triangle{0, 1, 2})) << bytes;
}

}  // namespace

TEST(Off, PlainFileIsRead) {
    expect_one_off_triangle("OFF\n3 1 0\n" + three_vertices + "3 0 1 2\n");
    expect_one_off_triangle("OFF\n3 1 3\n" + three_vertices + "3 0 1 2");
    expect_one_off_triangle("OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n");
    expect_one_off_triangle("\xEF\xBB\xBFOFF\n3 1 0\n" + three_vertices + "3 0 1 2\n");
}

TEST(Off, HeaderMayHoldTheCounts) {
    expect_one_off_triangle("OFF 3 1 0\n" + three_vertices + "3 0 1 2\n");
    expect_one_off_triangle("OFF3 1 0\n" + three_vertices + "3 0 1 2\n");
    expect_one_off_triangle("OFF\n3 1\n" + three_vertices + "3 0 1 2\n");
}

TEST(Off, CommentsAndEmptyLinesArePassedOver) {
    expect_one_off_triangle(
        "# made by hand\n\nOFF # the keyword\n#\n3 1 0#counts\n\n0 0 0 # first\n"
        "  1\t0 0\n# between\n0 1 0\n\n3 0 1 2 # face\n# end\n");
}

TEST(Off, ColoursNormalsAndTextureCoordinatesArePassedOver) {
    expect_one_off_triangle(
        "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 9 9 9 9\n0 1 0 1 1 1 1\n3 0 1 2 1 0 0\n");
    expect_one_off_triangle("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n");
    expect_one_off_triangle("STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
    expect_one_off_triangle(
        "STCNOFF 3 1 0\n0 0 0 0 0 1 9 9 9 9 0 0\n1 0 0 0\n0 1 0 0\n3 0 1 2 0.5\n");
}

TEST(Off, PolygonsAreTriangulatedAndLinesLeftOut) {
    const auto file = read_bytes("a.off",
                                 "OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                 "4 0 1 2 3\n2 0 1\n3 0 1 2\n");
    EXPECT_EQ(file.mesh.triangles.size(), 3u);
    EXPECT_EQ(file.polygons, 1u);
    EXPECT_EQ(file.dropped_polygons, 1u);
    EXPECT_EQ(file.face_polygon, (std::vector<agvd::Index>{0, 0, 2}));
}

TEST(Off, CoordinatesKeepEveryDigit) {
    const auto file = read_bytes("a.off",
                                 "OFF\n3 1 0\n0.1 -1e-300 +3.0000000000000004\n"
                                 "1 .5 1.\n0 1 0\n3 0 1 2\n");
    EXPECT_EQ(file.mesh.positions[0], Vec3(0.1, -1e-300, 3.0000000000000004));
    EXPECT_EQ(file.mesh.positions[1], Vec3(1, 0.5, 1));
}

TEST(Off, BinaryIsReadInBothByteOrders) {
    for (const std::endian order : {std::endian::big, std::endian::little}) {
        std::string bytes = "CNOFF BINARY\n";
        const auto put = [&](std::initializer_list<std::int32_t> numbers) {
            for (const std::int32_t number : numbers) remesh::append(bytes, number, order);
        };
        put({4, 2, 0});
        for (const float x : {0.f, 1.f, 2.f, 3.f}) {
            for (const float value : {x, x * x, 0.f, 0.f, 0.f, 1.f, x / 4, 0.f, 0.f, 1.f}) {
                remesh::append(bytes, value, order);
            }
        }
        put({4, 0, 1, 2, 3, 3});
        for (const float part : {.5f, 0.f, 1.f}) remesh::append(bytes, part, order);
        put({3, 3, 1, 0, 0});
        const auto file = read_bytes("a.off", bytes, true);
        EXPECT_EQ(file.mesh.positions,
                  (std::vector<Vec3>{{0, 0, 0}, {1, 1, 0}, {2, 4, 0}, {3, 9, 0}}));
        ASSERT_EQ(file.mesh.triangles.size(), 3u);
        EXPECT_EQ(file.mesh.triangles[2], (Triangle{3, 1, 0}));
        ASSERT_EQ(file.attributes.of_vertices.size(), 4u);
        EXPECT_EQ(file.attributes.of_vertices[0].name, "red");
        EXPECT_EQ(file.attributes.of_vertices[0].values, (std::vector<double>{0, .25, .5, .75}));
        EXPECT_TRUE(file.attributes.declined.empty());
        EXPECT_TRUE(file.warnings.empty());
        for (std::size_t size = 1; size < bytes.size(); ++size) {
            expect_error<IoError>("a.off", bytes.substr(0, size), {});
        }
    }
}

TEST(Off, WrongHeadersAreRefused) {
    expect_error<IoError>("a.off", "\n\n", {"line 3", "OFF"});
    expect_error<IoError>("a.off", "3 1 0\n" + three_vertices + "3 0 1 2\n",
                          {"line 1", "keyword OFF", "'3'"});
    expect_error<IoError>("a.off", "4OFF\n3 1 0\n", {"line 1", "three dimensions"});
    expect_error<IoError>("a.off", "OFF BINARY\n3 1 0\n", {"byte 11", "truncated"});
    expect_error<IoError>("a.off", "OFF\n3\n0 0 0\n", {"line 2", "number of faces"});
    expect_error<IoError>("a.off", "OFF\n-3 1 0\n", {"line 2", "negative"});
    expect_error<IoError>("a.off", "OFF\nthree 1 0\n", {"line 2", "number of vertices", "'three'"});
}

TEST(Off, TruncatedFilesAreRefused) {
    const std::string whole = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (std::size_t size = 1; size < whole.size() - 1; ++size) {
        if (size == whole.size() - 2) continue;  // "3 0 1 ": tested below
        expect_error<IoError>("a.off", whole.substr(0, size), {"line"});
    }
    expect_error<IoError>("a.off", "OFF\n3 1 0\n" + three_vertices + "3 0 1 ",
                          {"line 6", "truncated"});
    expect_error<IoError>("a.off", "OFF\n3 2 0\n" + three_vertices + "3 0 1 2\n",
                          {"line 7", "face 1 of 2"});
    expect_error<IoError>("a.off", "OFF\n3 1 0\n0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                          {"line 3", "coordinate", "end of the line"});
}

TEST(Off, CornersOfAFaceMayGoOverSeveralLines) {
    const auto file = read_bytes("a.off", "OFF\n4 2 0\n" + three_vertices +
                                              "1 1 0\n3\n0\n\n1 # a comment\n2\n\n3 2 \n1 3\n");
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
}

TEST(Off, MissingCornersAreNotTakenFromTheNextFace) {
    for (const char* first : {"3 0 1\n", "3 0\n", "3\n"}) {
        expect_error<IoError>("a.off", "OFF\n3 2 0\n" + three_vertices + first + "3 0 1 2\n",
                              {"line 6", "face 0 has fewer than 3 corners"});
    }
    expect_error<IoError>("a.off", "OFF\n3 1 0\n" + three_vertices + "3 0 1\n",
                          {"a corner", "end of the file"});
}

TEST(Off, SeveralElementsOnALineAreRefusedNotMisread) {
    expect_error<IoError>("a.off", "OFF\n3 2 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n3 0 1 2\n", {"line"});
    expect_error<IoError>("a.off", "OFF\n3 2 0\n" + three_vertices + "3 0 1 2 3 0 1 2\n",
                          {"several"});
}

TEST(Off, WrongNumbersAreRefused) {
    for (const std::string bad : {"nan", "inf", "-inf", "1e999"}) {
        expect_error<InvalidInput>("a.off", "OFF\n3 1 0\n0 0 0\n1 " + bad + " 0\n0 1 0\n3 0 1 2\n",
                                   {"line 4", "not finite"});
    }
    for (const std::string bad : {"x", "1,0", "0x10", "1.5.2", "1e"}) {
        expect_error<IoError>("a.off", "OFF\n3 1 0\n0 0 0\n1 " + bad + " 0\n0 1 0\n3 0 1 2\n",
                              {"line 4", "'" + bad + "'"});
    }
    expect_error<IoError>("a.off", "OFF\n3 1 0\n" + three_vertices + "3 0 1.0 2\n",
                          {"line 6", "'1.0'"});
    expect_error<IoError>("a.off", "OFF\n3 1 0\n" + three_vertices + "-3 0 1 2\n",
                          {"line 6", "negative"});
}

TEST(Off, IndicesOutOfRangeAreRefused) {
    expect_error<InvalidInput>("a.off", "OFF\n3 2 0\n" + three_vertices + "3 0 1 2\n3 0 1 3\n",
                               {"line 7", "face 1", "vertex 3", "3 vertices"});
    expect_error<InvalidInput>("a.off", "OFF\n3 1 0\n" + three_vertices + "3 0 1 -2\n",
                               {"line 6", "-2", "negative"});
    expect_error<InvalidInput>("a.off", "OFF\n3 1 0\n" + three_vertices + "3 0 1 4294967295\n",
                               {"line 6", "too large"});
    expect_error<InvalidInput>("a.off",
                               "OFF\n3 1 0\n" + three_vertices + "3 0 1 99999999999999999999\n",
                               {"line 6", "too large"});
}

TEST(Off, CountsAreNotBelieved) {
    expect_error<IoError>("a.off",
                          "OFF\n9223372036854775807 9223372036854775807 0\n" + three_vertices,
                          {"line 6", "vertex 3 of 9223372036854775807"});
    expect_error<IoError>("a.off", "OFF\n3 1 0\n" + three_vertices + "4000000000000 0 1 2\n",
                          {"line 7", "end of the file"});
}

TEST(Off, PointCloudsAndEmptyMeshesAreRefused) {
    expect_error<InvalidInput>("a.off", "OFF\n3 0 0\n" + three_vertices,
                               {"3 vertices but no face"});
    expect_error<InvalidInput>("a.off", "OFF\n0 0 0\n", {"nor a face"});
    expect_error<InvalidInput>("a.off", "OFF\n3 1 0\n" + three_vertices + "2 0 1\n",
                               {"three corners"});
}
