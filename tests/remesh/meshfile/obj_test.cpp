#include <gtest/gtest.h>

#include "support/read_text.h"

using agvd::InvalidInput;
using agvd::IoError;
using agvd::Triangle;
using agvd::Vec3;
using texts::expect_error;
using texts::read_bytes;

namespace {
const std::string four = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
}

TEST(Obj, AllFormsOfCornersAreRead) {
    for (const std::string face :
         {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//7 2//7 3//7", "f 1/1/1 2/2/1 3/3/1", "f -4 -3 -2",
          "f -4/-1/-1 -3/-1/-1 -2//-1", "f 1/ 2/ 3/", "  f\t1  2 3 # face"}) {
        const auto file = read_bytes("a.obj", four + face);
        ASSERT_EQ(file.mesh.positions.size(), 4u) << face;
        ASSERT_EQ(file.mesh.triangles.size(), 1u) << face;
        EXPECT_EQ(file.mesh.triangles[0], (Triangle{0, 1, 2})) << face;
    }
}

TEST(Obj, TextureSeamsDoNotSplitVertices) {
    const auto file = read_bytes("a.obj", four +
                                              "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 9 9\n"
                                              "f 1/1 2/2 3/3\nf 1/5 3/1 4/2\n");
    EXPECT_EQ(file.mesh.positions.size(), 4u);
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Obj, OtherStatementsArePassedOver) {
    const auto file = read_bytes("a.obj",
                                 "# Blender\nmtllib C:\\a\\\no thing\ng\nvn 0 0 1\n"
                                 "v 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nusemtl none\n"
                                 "s off\nl 1 2\np 1\nvp 0.1\nf 1 2 3\n");
    EXPECT_EQ(file.mesh.positions.size(), 3u);
    EXPECT_EQ(file.mesh.triangles.size(), 1u);
}

TEST(Obj, LinesMayBeJoinedAndEndedInAnyWay) {
    const std::vector<std::string> ends = {"\n", "\r\n", "\r"};
    for (const std::string& end : ends) {
        std::string text =
            "v 0 \\\n 0 0\nv 1 0 0 \\\n 0.5 \\\n0.5 0.5\nv 1 1 0\nv 0 1 0\nf 1 2\\\n3 \\\n 4\n";
        for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;
             at += end.size()) {
            text.replace(at, 1, end);
        }
        const auto file = read_bytes("a.obj", text);
        ASSERT_EQ(file.mesh.positions.size(), 4u);
        EXPECT_EQ(file.mesh.positions[1], Vec3(1, 0, 0));
        EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
        EXPECT_EQ(file.polygons, 1u);
    }
}

TEST(Obj, JoinedTextureLinesEndAtTheSamePlaceWithAndWithoutAttributes) {
    for (const bool with_attributes : {false, true}) {
        const auto file = read_bytes("a.obj", four + "vt 0 \\\nv 9\nf 1 2 3\n", with_attributes);
        EXPECT_EQ(file.mesh.positions.size(), 4u);
        EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    }
}

TEST(Obj, ACommentThatEndsInABackslashSwallowsNothing) {
    const auto file =
        read_bytes("a.obj", "# C:\\temp\\\nv 0 0 0\nv 1 0 0 # here\\\nv 1 1 0\nf 1 2 3");
    EXPECT_EQ(file.mesh.positions.size(), 3u);
}

TEST(Obj, NegativeIndicesCountFromTheLatestVertex) {
    const auto file = read_bytes("a.obj",
                                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n"
                                 "v 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n");
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
}

TEST(Obj, VerticesMayFollowTheirFaces) {
    EXPECT_EQ(read_bytes("a.obj", "f 1 2 3\n" + four).mesh.triangles[0], (Triangle{0, 1, 2}));
}

TEST(Obj, FlatDrawingsGetZeroForZAndAWarning) {
    const auto file = read_bytes("a.obj", "v 0 0 # flat\nv 1 0\nv 1 \\\n1\nf 1 2 3\n", true);
    EXPECT_EQ(file.mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("two coordinates; z = 0"), std::string::npos);
    EXPECT_TRUE(file.attributes.empty());
}

TEST(Obj, IndicesOutOfRangeAreRefused) {
    expect_error<InvalidInput>("a.obj", four + "f 1 2 3\nf 1 2 5\nf 1 2 4\n",
                               {"line 6", "face 1", "vertex 5", "4 vertices", "from 1"});
    expect_error<InvalidInput>("a.obj", four + "f 1 2 0\n", {"line 5", "vertex 0", "from 1"});
    expect_error<InvalidInput>("a.obj", four + "f -5 2 1\n", {"line 5", "-5", "4 vertices"});
    expect_error<InvalidInput>("a.obj", four + "f 1 2 99999999999\n", {"line 5", "too large"});
    expect_error<InvalidInput>("a.obj", four + "f 1 2 99999999999999999999\n",
                               {"line 5", "too large"});
    expect_error<InvalidInput>("a.obj", four + "f 1 2 -9223372036854775808\n", {"line 5"});
}

TEST(Obj, WrongNumbersAreRefused) {
    expect_error<InvalidInput>("a.obj", "v 0 0 nan\n", {"line 1", "not finite"});
    expect_error<InvalidInput>("a.obj", "\nv 0 -inf 0\n", {"line 2", "not finite"});
    expect_error<IoError>("a.obj", "v 0 0\nv 1 0 0\n", {"line 2", "two coordinates", "'0'"});
    expect_error<IoError>("a.obj", "v 1 0 0\nv 0 0\n", {"line 2", "end of the line"});
    expect_error<IoError>("a.obj", "v 1\n", {"line 1", "end of the line"});
    expect_error<IoError>("a.obj", four + "f 1 2 three\n", {"line 5", "'three'"});
    expect_error<IoError>("a.obj", four + "f 1/a 2 3\n", {"line 5", "texture"});
    expect_error<IoError>("a.obj", four + "f 1.5 2 3\n", {"line 5", "'1.5'"});
}

TEST(Obj, FilesWithoutFacesAreRefused) {
    expect_error<InvalidInput>("a.obj", four, {"4 vertices but no face"});
    expect_error<InvalidInput>("a.obj", "# nothing\n", {"neither a vertex nor a face"});
    const std::string utf16("\xff\xfev\0 \0\x31\0", 8);
    expect_error<InvalidInput>("a.obj", utf16, {"neither a vertex nor a face"});
    expect_error<InvalidInput>("a.obj", four + "f 1 2\nf 3\nf\n", {"three corners"});
}
