#include "remesh/meshfile/mesh_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cfloat>
#include <limits>

#include "agvd/core/error.h"
#include "remesh/meshfile/atomic_file.h"
#include "support/files.h"
#include "support/shapes.h"

namespace fs = std::filesystem;
using agvd::InvalidInput;
using agvd::IoError;
using agvd::Vec3;
using files::TemporaryFolder;

namespace {

std::string what_writing_says(const fs::path& path) {
    try {
        remesh::write_file_atomically(path, "new");
    } catch (const IoError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST(WriteMesh, DoublesComeBackTheSame) {
    const TemporaryFolder folder;
    agvd::TriangleMesh mesh = shapes::jitter(shapes::sphere(3), 0.1, 7);
    mesh.positions[0] = {DBL_MAX, DBL_MIN, std::numeric_limits<double>::denorm_min()};
    mesh.positions[1] = {-0.1, 1.0 / 3, 1e22};
    for (const char* name : {"a.ply", "a.obj", "a.off", "A.OBJ"}) {
        remesh::write_mesh(folder / name, mesh.view());
        const remesh::MeshFile back = remesh::read_mesh(folder / name);
        EXPECT_EQ(back.mesh.positions, mesh.positions) << name;
        EXPECT_EQ(back.mesh.triangles, mesh.triangles) << name;
        EXPECT_EQ(back.polygons + back.dropped_polygons + back.welded_vertices, 0u);
    }
}

TEST(WriteMesh, StlComesBackInFloat) {
    const TemporaryFolder folder;
    const agvd::TriangleMesh mesh = shapes::torus(12, 9);
    remesh::write_mesh(folder / "a.stl", mesh.view());
    EXPECT_EQ(fs::file_size(folder / "a.stl"), 84 + 50 * mesh.triangles.size());
    const remesh::MeshFile back = remesh::read_mesh(folder / "a.stl");
    EXPECT_EQ(back.mesh.positions.size(), mesh.positions.size());
    ASSERT_EQ(back.mesh.triangles.size(), mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = mesh.positions[mesh.triangles[f][k]];
            EXPECT_EQ(back.mesh.positions[back.mesh.triangles[f][k]],
                      p.cast<float>().cast<double>());
        }
    }
}

TEST(WriteMesh, OnlyTheExtensionsOfFormatsAreKnown) {
    for (const char* name : {"a.ply", "b/a.OBJ", "a.b.Off", "a.stl", "a.vtk", "a.mesh", "a.GLB"}) {
        EXPECT_TRUE(remesh::is_known_mesh_extension(name)) << name;
    }
    for (const char* name : {"a", "ply", ".ply", "a.gz", "a.plyx", "a.", ""}) {
        EXPECT_FALSE(remesh::is_known_mesh_extension(name)) << name;
    }
    EXPECT_THROW(remesh::write_mesh("a.step", shapes::cube().view()), IoError);
}

TEST(WriteMesh, WhatCouldNotBeReadBackIsNotWritten) {
    const TemporaryFolder folder;
    agvd::TriangleMesh mesh = shapes::cube();
    mesh.positions[3].x() = 1e39;
    EXPECT_THROW(remesh::write_mesh(folder / "a.stl", mesh.view()), InvalidInput);
    EXPECT_NO_THROW(remesh::write_mesh(folder / "a.ply", mesh.view()));
    mesh.positions[3].x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(remesh::write_mesh(folder / "b.ply", mesh.view()), InvalidInput);
    mesh = shapes::cube();
    mesh.triangles[4][1] = 8;
    EXPECT_THROW(remesh::write_mesh(folder / "b.obj", mesh.view()), InvalidInput);
    EXPECT_EQ(folder.num_entries(), 1u);
}

TEST(AtomicFile, OldContentIsReplacedWholeAndNothingElseIsLeft) {
    const TemporaryFolder folder;
    files::write(folder / "a", "a much longer old content");
    remesh::write_file_atomically(folder / "a", "new");
    EXPECT_EQ(files::read(folder / "a"), "new");
    EXPECT_EQ(folder.num_entries(), 1u);
}

TEST(AtomicFile, PermissionBitsAreKept) {
    const TemporaryFolder folder;
    files::write(folder / "a", "old");
    for (const auto bits : {fs::perms(0640), fs::perms(0777), fs::perms(0600)}) {
        fs::permissions(folder / "a", bits);
        remesh::write_file_atomically(folder / "a", "new");
        EXPECT_EQ(fs::status(folder / "a").permissions(), bits);
    }
}

TEST(AtomicFile, NewFilesFollowTheUmask) {
    const TemporaryFolder folder;
    const mode_t old = umask(027);
    remesh::write_file_atomically(folder / "a", "new");
    umask(old);
    EXPECT_EQ(fs::status(folder / "a").permissions(), fs::perms(0640));
}

TEST(AtomicFile, SymbolicLinksAreKeptAndFollowed) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "there");
    files::write(folder / "there/target", "old");
    fs::create_symlink("there/target", folder / "link");
    fs::create_symlink("link", folder / "link to link");
    remesh::write_file_atomically(folder / "link to link", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link to link") && fs::is_symlink(folder / "link"));
    EXPECT_FALSE(fs::is_symlink(folder / "there/target"));
    EXPECT_EQ(files::read(folder / "there/target"), "new");
    fs::create_symlink("there/not yet", folder / "dangling");
    remesh::write_file_atomically(folder / "dangling", "new");
    EXPECT_EQ(files::read(folder / "there/not yet"), "new");
    fs::create_symlink("loop", folder / "loop");
    EXPECT_NE(what_writing_says(folder / "loop"), "");
}

TEST(AtomicFile, DevicesAndPipesAreWrittenToNotReplaced) {
    remesh::write_file_atomically("/dev/null", "new");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(AtomicFile, FailuresSayWhyAndLeaveNothing) {
    const TemporaryFolder folder;
    EXPECT_NE(what_writing_says(folder / "none/a").find("No such file or directory"),
              std::string::npos);
    fs::create_directory(folder / "a folder");
    EXPECT_NE(what_writing_says(folder / "a folder").find("Is a directory"), std::string::npos);
    EXPECT_NE(what_writing_says(folder / std::string(300, 'x')).find("File name too long"),
              std::string::npos);
    EXPECT_EQ(folder.num_entries(), 1u);
}

TEST(AtomicFile, ProtectedFilesAndFoldersAreNotWritten) {
    if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere; run the tests as a user";
    const TemporaryFolder folder;
    files::write(folder / "a", "old");
    fs::permissions(folder / "a", fs::perms(0444));
    EXPECT_NE(what_writing_says(folder / "a").find("Permission denied"), std::string::npos);
    fs::permissions(folder.path(), fs::perms(0555));
    EXPECT_NE(what_writing_says(folder / "b").find("Permission denied"), std::string::npos);
    EXPECT_THROW(remesh::require_writable(folder / "b"), IoError);
    EXPECT_EQ(files::read(folder / "a"), "old");
    EXPECT_EQ(folder.num_entries(), 1u);
}

TEST(AtomicFile, AFullDiskLeavesTheOldFile) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
    EXPECT_NE(what_writing_says("/dev/full").find("No space left"), std::string::npos);
}

TEST(AtomicFile, WritabilityIsFoundOutWithoutATrace) {
    const TemporaryFolder folder;
    remesh::require_writable(folder / "a");
    EXPECT_EQ(folder.num_entries(), 0u);
    EXPECT_THROW(remesh::require_writable(folder / "none/a"), IoError);
}
