#include "remesh/meshfile/packed.h"

#include <gtest/gtest.h>

#include "agvd/core/error.h"
#include "agvd/core/progress.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/files.h"
#include "support/shapes.h"

using agvd::IoError;

namespace {

std::string unpacked(const std::string& bytes) {
    remesh::SourceFile file{.path = "a.ply.gz", .bytes = bytes};
    remesh::unpack_gzip(file);
    EXPECT_FALSE(file.is_binary);
    return file.bytes;
}

void expect_refused(const std::string& bytes, const char* what) {
    try {
        static_cast<void>(unpacked(bytes));
        ADD_FAILURE() << "unpacked without complaint";
    } catch (const IoError& error) {
        EXPECT_EQ(std::string(error.what()).find("a.ply.gz: "), 0u) << error.what();
        EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(';'), std::string::npos) << error.what();
    }
}

// Several chunks of 4 MB, which do not compress well.
std::string long_text() {
    std::string text;
    for (std::uint64_t i = 0; text.size() < 10'000'000; ++i)
        text += std::to_string(i * i * 2654435761u);
    return text;
}

class Gzip : public testing::Test {
protected:
    void SetUp() override {
        if (!remesh::knows_gzip()) GTEST_SKIP() << "built without zlib";
    }
};

}  // namespace

TEST_F(Gzip, WhatWasPackedComesBack) {
    for (const std::string& text : {std::string("a"), std::string(5'000'000, 'x'), long_text()}) {
        const std::string packed = remesh::pack_gzip(text, {});
        EXPECT_TRUE(remesh::is_gzip(packed));
        EXPECT_LT(packed.size(), text.size() + 100);
        EXPECT_TRUE(unpacked(packed) == text);
        EXPECT_EQ(packed, remesh::pack_gzip(text, {}));
    }
}

TEST_F(Gzip, MembersFollowEachOtherAndZerosMayFollowThem) {
    const std::string packed = remesh::pack_gzip("one", {}) + remesh::pack_gzip(" two", {});
    EXPECT_EQ(unpacked(packed), "one two");
    EXPECT_EQ(unpacked(packed + std::string(512, '\0')), "one two");
    expect_refused(packed + "x", "follow");
}

TEST_F(Gzip, DamagedAndTruncatedBytesAreRefused) {
    const std::string packed = remesh::pack_gzip("some text that is long enough", {});
    for (std::size_t size = 2; size < packed.size(); ++size) {
        expect_refused(packed.substr(0, size), "truncated");
    }
    for (const std::size_t at : {std::size_t{2}, packed.size() / 2, packed.size() - 1}) {
        std::string damaged = packed;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
        expect_refused(damaged, "byte ");
    }
    expect_refused(remesh::pack_gzip("", {}), "empty");
}

TEST_F(Gzip, AHugeContentIsStoppedByTheCallback) {
    const std::string packed = remesh::pack_gzip(std::string(100'000'000, '\0'), {});
    EXPECT_LT(packed.size(), 200'000u);
    int calls = 0;
    const agvd::Progress stop = [&](double) { return ++calls < 5; };
    agvd::Poller poller(stop);
    remesh::SourceFile file{.path = "a", .bytes = packed, .ticker = agvd::Ticker(poller)};
    EXPECT_THROW(remesh::unpack_gzip(file), agvd::Cancelled);
    EXPECT_THROW(static_cast<void>(remesh::pack_gzip(packed, agvd::Ticker(poller))),
                 agvd::Cancelled);
}

TEST_F(Gzip, MeshesAreWrittenAndReadByTheirExtension) {
    const files::TemporaryFolder folder;
    const agvd::TriangleMesh mesh = shapes::torus(12, 9);
    for (const char* name : {"a.ply.gz", "b.OBJ.GZ", "c.off.gz"}) {
        remesh::write_mesh(folder / name, mesh.view());
        EXPECT_TRUE(remesh::is_gzip(files::read(folder / name))) << name;
        EXPECT_EQ(remesh::read_mesh(folder / name).mesh.positions, mesh.positions) << name;
    }
    const std::string packed =
        remesh::format_mesh(remesh::MeshPath{"a", "ply.gz"}, mesh.view(), {});
    EXPECT_EQ(packed, files::read(folder / "a.ply.gz"));
    files::write(folder / "plain.ply.gz", remesh::format_mesh("a.ply", mesh.view()));
    files::write(folder / "packed.ply", packed);
    files::write(folder / "noname", packed);
    for (const char* name : {"plain.ply.gz", "packed.ply"}) {
        EXPECT_EQ(remesh::read_mesh(folder / name).mesh.triangles, mesh.triangles) << name;
    }
    EXPECT_EQ(
        remesh::read_mesh(folder / "noname", remesh::ReadOptions{.format = "ply"}).mesh.triangles,
        mesh.triangles);
    EXPECT_FALSE(remesh::is_known_mesh_extension("a.gz"));
    EXPECT_FALSE(remesh::is_known_mesh_extension("ply.gz"));
    EXPECT_EQ(remesh::mesh_format({"a.stl.gz"}), "stl");
}
