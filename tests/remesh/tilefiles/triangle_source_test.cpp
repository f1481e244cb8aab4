#include "remesh/tilefiles/triangle_source.h"

#include <gtest/gtest.h>

#include "agvd/core/error.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/files.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::TriangleSource;

namespace {

class Source : public testing::Test {
protected:
    std::filesystem::path put(const std::string& name, const std::string& bytes) {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    }
    // What reading it to its end throws.
    template <typename Error>
    std::string complaint(const std::filesystem::path& path) {
        try {
            TriangleSource source(path);
            std::array<Vec3, 3> corners;
            while (source.next(corners)) {
            }
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    files::TemporaryFolder folder_;
};

void expect_faces(TriangleSource& source, const TriangleMesh& mesh) {
    EXPECT_EQ(source.num_faces(), mesh.triangles.size());
    for (int pass = 0; pass < 2; ++pass) {
        std::array<Vec3, 3> corners;
        Index f = 0;
        for (; source.next(corners); ++f) {
            for (Index k = 0; k < 3; ++k) {
                ASSERT_EQ(corners[k], mesh.positions[mesh.triangles[f][k]]) << f;
            }
        }
        EXPECT_EQ(f, mesh.triangles.size());
        source.rewind();
    }
}

TEST_F(Source, ReadsWhatTheProgramsWrite) {
    TriangleMesh mesh = shapes::sphere(2);
    for (Vec3& p : mesh.positions) p = p.cast<float>().cast<double>();
    for (const char* name : {"a.ply", "a.stl"}) {
        SCOPED_TRACE(name);
        remesh::write_mesh(folder_ / name, mesh.view());
        TriangleSource source(folder_ / name);
        EXPECT_EQ(source.num_bytes(), std::filesystem::file_size(folder_ / name));
        expect_faces(source, mesh);
    }
}

// Big-endian, with properties before, between and behind those that count, and another element.
TEST_F(Source, PassesOverOtherProperties) {
    std::string bytes =
        "ply\nformat binary_big_endian 1.0\nelement range 1\nproperty ushort a\n"
        "element vertex 3\nproperty uchar red\nproperty float y\nproperty double x\n"
        "property float z\nelement face 1\nproperty list uchar short other\n"
        "property list uchar ushort vertex_indices\nproperty float quality\nend_header\n";
    bytes += std::string("\0\1", 2);
    const auto big = [&](auto value) {
        auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
        std::reverse(raw.begin(), raw.end());
        bytes.append(raw.data(), raw.size());
    };
    for (int v = 0; v < 3; ++v) {
        bytes += '\7';
        big(static_cast<float>(v == 2));
        big(static_cast<double>(v == 1));
        big(0.5F);
    }
    bytes += '\2';
    big(std::int16_t{5});
    big(std::int16_t{6});
    bytes += '\3';
    for (std::uint16_t v = 0; v < 3; ++v) big(v);
    big(1.0F);
    TriangleSource source(put("a.ply", bytes));
    std::array<Vec3, 3> corners;
    ASSERT_TRUE(source.next(corners));
    EXPECT_EQ(corners[0], Vec3(0, 0, 0.5));
    EXPECT_EQ(corners[1], Vec3(1, 0, 0.5));
    EXPECT_EQ(corners[2], Vec3(0, 1, 0.5));
    EXPECT_FALSE(source.next(corners));
}

TEST_F(Source, NamesTheFaceThatIsWrong) {
    const std::string head =
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
        "property float y\nproperty float z\nelement face 2\n"
        "property list uchar uchar vertex_indices\nend_header\n";
    const std::string vertex(12, '\0'), face("\3\0\0\0", 4);
    EXPECT_EQ(complaint<remesh::InvalidInput>(put("a.ply", head + vertex + face + face)), "");
    EXPECT_NE(complaint<remesh::InvalidInput>(
                  put("a.ply", head + vertex + face + std::string("\3\0\0\1", 4)))
                  .find("face 1 has a vertex that the file does not have"),
              std::string::npos);
    EXPECT_NE(complaint<remesh::InvalidInput>(
                  put("a.ply", head + vertex + face + std::string("\4\0\0\0\0", 5)))
                  .find("face 1 is no triangle"),
              std::string::npos);
    EXPECT_NE(complaint<remesh::InvalidInput>(
                  put("a.ply", head + std::string("\0\0\xC0\x7F", 4) + vertex.substr(4) + face))
                  .find("face 0 has a coordinate that is not finite"),
              std::string::npos);
    EXPECT_NE(
        complaint<remesh::IoError>(put("a.ply", head + vertex + face + "\3")).find("truncated"),
        std::string::npos);
    EXPECT_NE(complaint<remesh::IoError>(put("a.ply", head + "abc")).find("truncated"),
              std::string::npos);
}

TEST_F(Source, RefusesOtherFormats) {
    remesh::write_mesh(folder_ / "a.off", shapes::cube().view());
    EXPECT_NE(
        complaint<remesh::IoError>(folder_ / "a.off").find("neither binary PLY nor binary STL"),
        std::string::npos);
    EXPECT_NE(complaint<remesh::IoError>(put("a.stl", "solid a\nendsolid a\n")).find("neither"),
              std::string::npos);
    EXPECT_NE(complaint<remesh::IoError>(put("b.ply", "ply\nformat ascii 1.0\nend_header\n"))
                  .find("ascii"),
              std::string::npos);
    EXPECT_NE(complaint<remesh::IoError>(put("c.ply", "")).find("empty"), std::string::npos);
    EXPECT_NE(complaint<remesh::IoError>(folder_ / "none.ply").find("cannot be read"),
              std::string::npos);
    EXPECT_NE(complaint<remesh::IoError>(folder_.path()).find("no regular file"),
              std::string::npos);
}

}  // namespace
