#include "remesh/meshfile/mesh_file.h"

#include <gtest/gtest.h>

#include "agvd/mesh/topology.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/numbers.h"
#include "support/files.h"
#include "support/read_text.h"
#include "support/shapes.h"

using agvd::IoError;
using texts::expect_error;

namespace {

std::string what_reading_says(const std::filesystem::path& path) {
    try {
        static_cast<void>(remesh::read_mesh(path));
    } catch (const IoError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST(ReadMesh, WhatIsNoFileIsRefused) {
    const files::TemporaryFolder folder;
    EXPECT_NE(what_reading_says(folder / "none.ply").find("No such file"), std::string::npos);
    std::filesystem::create_directory(folder / "folder.off");
    EXPECT_NE(what_reading_says(folder / "folder.off").find("Is a directory"), std::string::npos);
    files::write(folder / "a.stl", "");
    EXPECT_NE(what_reading_says(folder / "a.stl").find("empty"), std::string::npos);
    expect_error<IoError>("a.step", "OFF", {"'.step'", ".ply, .obj, .off, .stl", " or .gltf"});
    expect_error<IoError>("mesh", "OFF", {"unknown", "--from"});
}

TEST(ReadMesh, NoReaderFollowsAFileThatNeverEnds) {
    const agvd::TriangleMesh mesh = shapes::tetrahedron();
    const auto expect_refused = [](const auto& read) {
        for (const char* path : {"/dev/zero", "/dev/full"}) {
            try {
                static_cast<void>(read(path));
                ADD_FAILURE() << path << " has been read";
            } catch (const IoError& error) {
                EXPECT_NE(std::string(error.what()).find("does not end within 16 MB"),
                          std::string::npos)
                    << error.what();
            }
        }
    };
    expect_refused([](const char* path) {
        return remesh::read_mesh(path, remesh::ReadOptions{.format = "ply"});
    });
    expect_refused([&](const char* path) { return remesh::read_sites(path, mesh.view()); });
    expect_refused([&](const char* path) { return remesh::read_vertices(path, mesh.view()); });
    expect_refused([](const char* path) { return remesh::read_edges(path); });
    expect_refused([](const char* path) { return remesh::read_diagram(path); });
}

TEST(ReadMesh, TextsInUtf16AreRead) {
    const std::u16string text =
        u"\uFEFFo Gr\u00F6\u00DFe \u20AC \U0001F642 \xD800\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const files::TemporaryFolder folder;
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        std::string bytes;
        for (const char16_t unit : text) {
            remesh::append(bytes, static_cast<std::uint16_t>(unit), order);
        }
        files::write(folder / "a.obj", bytes);
        const auto file =
            remesh::read_mesh(folder / "a.obj", remesh::ReadOptions{.with_attributes = true});
        EXPECT_EQ(file.mesh.positions.size(), 3u);
        EXPECT_EQ(file.mesh.triangles.size(), 1u);
        EXPECT_EQ(file.attributes.of_faces.at(0).names.at(0),
                  "Gr\xC3\xB6\xC3\x9F"
                  "e \xE2\x82\xAC \xF0\x9F\x99\x82 ?");
        // A binary file with such bytes in its free header is none.
        remesh::write_mesh(folder / "a.stl", shapes::tetrahedron().view());
        std::string stl = files::read(folder / "a.stl");
        stl.replace(0, 80, bytes.substr(0, 8) + std::string(72, '\0'));
        files::write(folder / "a.stl", stl);
        EXPECT_EQ(remesh::read_mesh(folder / "a.stl").mesh.triangles.size(), 4u);
    }
}

TEST(ReadMesh, ExtensionsAreKnownInAnyCase) {
    EXPECT_EQ(texts::read_bytes("A.Off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
                  .mesh.triangles.size(),
              1u);
}

TEST(ReadMesh, MoreElementsThanAnnouncedAreAnErrorThatNamesBothCounts) {
    const agvd::TriangleMesh mesh = shapes::sphere(1);  // 80 faces.
    const files::TemporaryFolder folder;
    const auto halved = [&](const char* name, const std::string& count, const std::string& half) {
        const std::filesystem::path path = folder / name;
        remesh::write_mesh(path, mesh.view());
        std::string bytes = files::read(path);
        const std::size_t at = bytes.find(count);
        EXPECT_NE(at, std::string::npos) << name;
        files::write(path, bytes.replace(at, count.size(), half));
        const std::string error = what_reading_says(path);
        EXPECT_NE(error.find("announces 40 "), std::string::npos) << error;
        EXPECT_NE(error.find("holds 80"), std::string::npos) << error;
        const remesh::MeshFile file =
            remesh::read_mesh(path, remesh::ReadOptions{.is_lenient = true});
        EXPECT_EQ(file.mesh.triangles.size(), 40u) << name;
        ASSERT_EQ(file.warnings.size(), 1u) << name;
        EXPECT_NE(file.warnings[0].find("announces 40 "), std::string::npos) << file.warnings[0];
    };
    halved("a.stl", std::string("\x50\0\0\0", 4), std::string("\x28\0\0\0", 4));
    halved("a.off", "42 80", "42 40");
    halved("a.ply", "face 80", "face 40");
    files::write(folder / "b.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
                 "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n");
    EXPECT_NE(
        what_reading_says(folder / "b.ply").find("announces 1 face elements, the file holds 2"),
        std::string::npos);
}

TEST(ReadMesh, StrayBytesAreAWarningAndCommentsAreNot) {
    const files::TemporaryFolder folder;
    const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    files::write(folder / "a.off", off + "made by hand\n");
    const auto warned = remesh::read_mesh(folder / "a.off").warnings;
    ASSERT_EQ(warned.size(), 1u);
    EXPECT_NE(warned[0].find("line 7: the 13 bytes after the last element"), std::string::npos)
        << warned[0];
    files::write(folder / "b.off", off + "# 3 0 1 2\n\n");
    EXPECT_TRUE(remesh::read_mesh(folder / "b.off").warnings.empty());
    remesh::write_mesh(folder / "c.stl", shapes::tetrahedron().view());
    files::write(folder / "d.stl", files::read(folder / "c.stl") + "xyz");
    EXPECT_EQ(remesh::read_mesh(folder / "d.stl").warnings.size(), 1u);
    EXPECT_TRUE(remesh::read_mesh(folder / "c.stl").warnings.empty());
}

TEST(ReadMesh, ByteOrderMarksAndLowerCaseAreRead) {
    const std::string mark = "\xEF\xBB\xBF";
    const std::string off = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_EQ(texts::read_bytes("a.off", "off\n" + off).mesh.triangles.size(), 1u);
    EXPECT_EQ(texts::read_bytes("a.off", mark + "OFF\n" + off).mesh.triangles.size(), 1u);
    EXPECT_EQ(
        texts::read_bytes("a.stl", mark + "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 "
                                          "0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
                                          "endsolid a\n")
            .mesh.triangles.size(),
        1u);
}

TEST(ReadMesh, ErrorsStayReadableOnBinaryGarbage) {
    expect_error<IoError>("a.off", std::string(500, '\x01'),
                          {"'????????????????????????????????????????...'"});
}

TEST(ReadMesh, RealMeshesHaveTheirCountsAndTopology) {
    struct Expected {
        const char* name;
        std::size_t vertices, faces;
        int genus, loops;
    };
    for (const auto& [name, vertices, faces, genus, loops] :
         {Expected{"data/part.off", 1312, 2660, 10, 0},
          Expected{"data/shell.obj", 3168, 6144, 0, 2},
          Expected{"data/plate.stl", 2050, 4096, 0, 0}, Expected{"spot.obj", 2930, 5856, 0, 0},
          Expected{"bunny.off", 34835, 69666, 0, 0}, Expected{"3holes.off", 3596, 7200, 3, 0},
          Expected{"camelhead.off", 11381, 22704, 0, 1},
          Expected{"dirty/72214.stl", 830, 1660, 1, 0},
          Expected{"dirty/65004.stl", 731, 1466, 2, 0},
          Expected{"dirty/79741.stl", 7372, 14740, 0, 0},
          Expected{"dirty/58011.stl", 13215, 26430, 1, 0},
          Expected{"dirty/stl_box_ascii.stl", 8, 12, 0, 0}}) {
        const std::filesystem::path path = files::find_mesh(name);
        if (!std::filesystem::exists(path)) {
            GTEST_SKIP() << path << " is absent: set AGVD_MESHES to the folder of real meshes";
        }
        const remesh::MeshFile file = remesh::read_mesh(path);
        EXPECT_EQ(file.mesh.positions.size(), vertices) << name;
        EXPECT_EQ(file.mesh.triangles.size(), faces) << name;
        const remesh::Topology topology = remesh::analyze_topology(file.mesh.view());
        EXPECT_TRUE(topology.is_manifold && topology.is_oriented) << name;
        EXPECT_EQ(topology.components.size(), 1u) << name;
        EXPECT_EQ(topology.genus(), genus) << name;
        EXPECT_EQ(topology.boundary_loops(), loops) << name;
    }
}

TEST(ReadMesh, BytesAreReadAsTheFileThatHoldsThem) {
    const files::TemporaryFolder folder;
    const std::string text = "OFF\r\n3 1 0\n0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n";
    std::string wide = "\xFF\xFE";  // The same in UTF-16.
    for (const char c : text) wide += {c, '\0'};
    for (const std::string& bytes : {text, wide}) {
        files::write(folder / "a.off", bytes);
        const remesh::MeshFile file = remesh::read_mesh(folder / "a.off");
        const remesh::MeshFile read = remesh::read_mesh_bytes(bytes, "a.off");
        EXPECT_EQ(read.mesh.positions, file.mesh.positions);
        EXPECT_EQ(read.mesh.triangles, file.mesh.triangles);
        const remesh::MeshFile named = remesh::read_mesh_bytes(bytes, "a", {.format = "off"});
        EXPECT_EQ(named.mesh.positions, file.mesh.positions);
    }
    try {
        static_cast<void>(remesh::read_mesh_bytes("OFF\n3 1 0\n", "sent.off"));
        ADD_FAILURE() << "a truncated file has been read";
    } catch (const IoError& error) {
        EXPECT_EQ(std::string(error.what()).rfind("sent.off: line ", 0), 0U) << error.what();
    }
    EXPECT_THROW(static_cast<void>(remesh::read_mesh_bytes("", "a.off")), IoError);
    EXPECT_THROW(static_cast<void>(remesh::read_mesh_bytes(text, "a.step")), IoError);
}
