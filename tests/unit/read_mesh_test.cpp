#include "remesh/io/read_mesh.h"

#include <gtest/gtest.h>

#include "remesh/quality/topology.h"
#include "support/files.h"
#include "support/read_text.h"

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
    expect_error<IoError>("a.vtk", "OFF", {"'.vtk'", ".ply, .obj, .off or .stl"});
    expect_error<IoError>("mesh", "OFF", {"unknown"});
}

TEST(ReadMesh, ExtensionsAreKnownInAnyCase) {
    EXPECT_EQ(texts::read_bytes("A.Off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
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
         {Expected{"spot.obj", 2930, 5856, 0, 0}, Expected{"bunny.off", 34835, 69666, 0, 0},
          Expected{"3holes.off", 3596, 7200, 3, 0}, Expected{"camelhead.off", 11381, 22704, 0, 1},
          Expected{"dirty/72214.stl", 830, 1660, 1, 0},
          Expected{"dirty/65004.stl", 731, 1466, 2, 0},
          Expected{"dirty/79741.stl", 7372, 14740, 0, 0},
          Expected{"dirty/58011.stl", 13215, 26430, 1, 0},
          Expected{"dirty/stl_box_ascii.stl", 8, 12, 0, 0}}) {
        const std::filesystem::path path = files::real_mesh(name);
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
