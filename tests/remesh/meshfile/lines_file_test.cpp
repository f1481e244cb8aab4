#include "remesh/meshfile/lines_file.h"

#include <gtest/gtest.h>

#include "agvd/core/error.h"
#include "remesh/meshfile/numbers.h"

using namespace agvd;

namespace {

// An open line, one without points, and a closed one.
remesh::Lines some_lines() {
    remesh::Lines lines;
    lines.points = {{0, 0, 0}, {1, 0.5, 0}, {2, 0, 0}, {3, 0, 0}, {2, 0, 0}};
    lines.offsets = {0, 2, 2, 5};
    lines.of_points.push_back({.name = "distance", .values = {0, 1, 2, 3, 4}});
    lines.of_lines.push_back({.name = "length", .values = {1.25, 0, 2}});
    lines.of_lines.push_back(
        {.name = "site", .type = remesh::NumberType::Int32, .values = {7, -1, 8}});
    return lines;
}

}  // namespace

TEST(LinesFile, ObjHasThePointsAndLinesWithTheirValues) {
    EXPECT_EQ(remesh::format_lines("a.OBJ", some_lines()),
              "v 0 0 0\nv 1 0.5 0\nv 2 0 0\nv 3 0 0\nv 2 0 0\n# length 1.25 site 7\nl 1 2\n"
              "# length 2 site 8\nl 3 4 5\n");
}

TEST(LinesFile, PlyHasAnEdgeForEachPiece) {
    const std::string bytes = remesh::format_lines("a.ply", some_lines());
    const std::string end = "end_header\n";
    const std::size_t body = bytes.find(end) + end.size();
    EXPECT_NE(bytes.find("element vertex 5\n"), std::string::npos);
    EXPECT_NE(bytes.find("element edge 3\n"), std::string::npos);
    constexpr std::size_t vertex = 4 * 8, edge = 3 * 4 + 8 + 4;
    ASSERT_EQ(bytes.size(), body + 5 * vertex + 3 * edge);
    const char* const second = bytes.data() + body + vertex;
    EXPECT_EQ(remesh::load<double>(second + 8), 0.5);
    EXPECT_EQ(remesh::load<double>(second + 24), 1);
    const char* const last = bytes.data() + body + 5 * vertex + 2 * edge;
    EXPECT_EQ(remesh::load<std::int32_t>(last), 3);
    EXPECT_EQ(remesh::load<std::int32_t>(last + 4), 4);
    EXPECT_EQ(remesh::load<std::int32_t>(last + 8), 2);
    EXPECT_EQ(remesh::load<double>(last + 12), 2);
    EXPECT_EQ(remesh::load<std::int32_t>(last + 20), 8);
}

TEST(LinesFile, VtpNamesTheValues) {
    const std::string text = remesh::format_lines("a.vtp", some_lines());
    EXPECT_NE(text.find("NumberOfPoints=\"5\""), std::string::npos);
    EXPECT_NE(text.find("NumberOfLines=\"3\""), std::string::npos);
    for (const char* name : {"\"distance\"", "\"length\"", "\"site\""}) {
        EXPECT_NE(text.find(name), std::string::npos) << name;
    }
}

TEST(LinesFile, RefusesOtherExtensions) {
    EXPECT_THROW(remesh::check_lines_extension("a.off"), IoError);
    EXPECT_THROW((void)remesh::format_lines("a", some_lines()), IoError);
}
