#include "remesh/meshfile/lines_file.h"

#include <gtest/gtest.h>

#include "agvd/core/error.h"
#include "remesh/meshfile/numbers.h"

using namespace agvd;

namespace {

// An open line, one without points, one that turns back, and a closed one.
remesh::Lines some_lines() {
    remesh::Lines lines;
    lines.points = {{0, 0, 0}, {1, 0.5, 0}, {2, 0, 0}, {3, 0, 0}, {2, 0, 0},
                    {5, 0, 0}, {6, 0, 0},   {6, 1, 0}, {5, 0, 0}};
    lines.offsets = {0, 2, 2, 5, 9};
    lines.of_points.push_back({.name = "distance", .values = {0, 1, 2, 3, 4, 5, 6, 7, 8}});
    lines.of_lines.push_back({.name = "length", .values = {1.25, 0, 2, 3.5}});
    lines.of_lines.push_back(
        {.name = "site", .type = remesh::NumberType::Int32, .values = {7, -1, 8, 9}});
    return lines;
}

}  // namespace

TEST(LinesFile, ObjHasThePointsAndLinesWithTheirValues) {
    EXPECT_EQ(remesh::format_lines("a.OBJ", some_lines()),
              "v 0 0 0\nv 1 0.5 0\nv 2 0 0\nv 3 0 0\nv 2 0 0\nv 5 0 0\nv 6 0 0\nv 6 1 0\n"
              "# line 0 length 1.25 site 7\nl 1 2\n# line 2 length 2 site 8\nl 3 4 5\n"
              "# line 3 length 3.5 site 9\nl 6 7 8 6\n");
}

TEST(LinesFile, PlyHasAFaceOfTwoVerticesForEachPiece) {
    const std::string bytes = remesh::format_lines("a.ply", some_lines());
    const std::string end = "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
    ASSERT_NE(bytes.find(end), std::string::npos) << bytes;
    const std::size_t body = bytes.find(end) + end.size();
    EXPECT_NE(bytes.find("element vertex 8\n"), std::string::npos);
    constexpr std::size_t vertex = 4 * 8 + 4 + 8 + 4, face = 1 + 2 * 4;
    ASSERT_EQ(bytes.size(), body + 8 * vertex + 6 * face);
    const char* const third = bytes.data() + body + 2 * vertex;
    EXPECT_EQ(remesh::load<double>(third), 2);
    EXPECT_EQ(remesh::load<double>(third + 24), 2);
    EXPECT_EQ(remesh::load<std::int32_t>(third + 32), 2) << "the line's number";
    EXPECT_EQ(remesh::load<double>(third + 36), 2);
    EXPECT_EQ(remesh::load<std::int32_t>(third + 44), 8);
    const char* const last = bytes.data() + body + 8 * vertex + 5 * face;
    EXPECT_EQ(*last, 2);
    EXPECT_EQ(remesh::load<std::int32_t>(last + 1), 7);
    EXPECT_EQ(remesh::load<std::int32_t>(last + 5), 5);
}

// VTK 9.1 ends at a polyline without points.
TEST(LinesFile, VtpNamesTheValuesOfLinesWithPoints) {
    const std::string text = remesh::format_lines("a.vtp", some_lines());
    EXPECT_NE(text.find("NumberOfPoints=\"8\""), std::string::npos);
    EXPECT_NE(text.find("NumberOfLines=\"3\""), std::string::npos);
    for (const char* name : {"\"distance\"", "\"line\"", "\"length\"", "\"site\""}) {
        EXPECT_NE(text.find(name), std::string::npos) << name;
    }
}

TEST(LinesFile, RefusesOtherExtensions) {
    EXPECT_THROW(remesh::check_lines_extension("a.off"), IoError);
    EXPECT_THROW((void)remesh::format_lines("a", some_lines()), IoError);
}
