// Texture coordinates in files: read, written, and read again.
#include <gtest/gtest.h>

#include <cmath>

#include "remesh/meshfile/mesh_file.h"
#include "remesh/transfer/transfer.h"
#include "support/read_text.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Vec2;
using remesh::CornerCoordinates;
using remesh::find_texture_seams;
using remesh::MeshAttributes;
using remesh::MeshFile;
using remesh::NumberType;

namespace {

MeshFile read_textured(const std::string& name, const std::string& bytes) {
    return remesh::require_format({name}).read(
        {.path = name, .bytes = bytes, .with_attributes = true});
}

const remesh::TextureCoordinates& texture_of(const MeshFile& file) {
    return file.attributes.texture;
}

std::string complaints_of(const MeshFile& file) {
    std::string text;
    for (const auto& [name, reason] : file.attributes.declined) text += name + ": " + reason + "\n";
    return text;
}

// Equal values, and NaN in the same places.
void expect_same_corners(const std::vector<CornerCoordinates>& a,
                         const std::vector<CornerCoordinates>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t f = 0; f < a.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (a[f][k].allFinite()) {
                EXPECT_EQ(a[f][k], b[f][k]) << f;
            } else {
                EXPECT_TRUE(std::isnan(b[f][k].x()) && std::isnan(b[f][k].y())) << f;
            }
        }
    }
}

constexpr const char* broken = ": some texture coordinates are missing, or no finite numbers\n";

// A square of two triangles.
// \param jump  of u on its diagonal.
MeshAttributes on_square(double jump) {
    const agvd::TriangleMesh square = shapes::grid(1);
    MeshAttributes attributes;
    attributes.texture.type = NumberType::Float32;
    for (std::size_t f = 0; f < 2; ++f) {
        const auto at = [&](Index v) {
            return Vec2(square.positions[v].x() + static_cast<double>(f) * jump,
                        square.positions[v].y());
        };
        const agvd::Triangle& t = square.triangles[f];
        attributes.texture.corners.push_back({at(t[0]), at(t[1]), at(t[2])});
    }
    attributes.texture.seams = find_texture_seams(square.view(), attributes.texture.corners);
    return attributes;
}

std::string written_square(const std::string& name, const MeshAttributes& attributes) {
    return remesh::format_mesh(name, shapes::grid(1).view(), attributes);
}

MeshFile square_read_back(const std::string& name, const MeshAttributes& attributes) {
    return read_textured(name, written_square(name, attributes));
}

}  // namespace

TEST(Texture, ObjHasNumbersForEachCorner) {
    const MeshFile file = read_textured(
        "a.obj",
        "vt 0 0\nvt 1\nvt 1 1 7\nvt 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
        "f 1/1 2/2/5 3/-2\nf 1/4 3/4 4//1\nf 1 3 4\nf 1/5 3/3 4/6\nvt .25 .5\nvt -3 1e3\n");
    EXPECT_EQ(complaints_of(file), "");
    const Vec2 none = remesh::no_coordinates()[0];
    expect_same_corners({{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1)},
                         {Vec2(9, 9), Vec2(9, 9), none},
                         {none, none, none},
                         {Vec2(0.25, 0.5), Vec2(1, 1), Vec2(-3, 1000)}},
                        texture_of(file).corners);
    EXPECT_EQ(file.mesh.positions.size(), 4u);
}

TEST(Texture, CornersOfPolygonsKeepTheirs) {
    const MeshFile file = read_textured(
        "a.obj",
        "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 1 2 0\nv 0 1 0\nvt 0 0\nvt 2 0\nvt 3 1\nvt 1 2\nvt 0 1\n"
        "vt 7 7\nf 1/1 2/2 3/3 4/4 5/5\nf 3/6 2/6 1/6\n");
    ASSERT_EQ(file.mesh.triangles.size(), 4u);
    for (std::size_t f = 0; f < 3; ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(texture_of(file).corners[f][k],
                      file.mesh.positions[file.mesh.triangles[f][k]].head<2>());
        }
    }
    for (const Vec2& corner : texture_of(file).corners[3]) EXPECT_EQ(corner, Vec2(7, 7));
}

TEST(Texture, ObjWithWrongOnesIsReadWithoutThem) {
    const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\n";
    int num_tried = 0;
    for (const char* tail :
         {"vt 0 x\nf 1/1 2/2 3/3\n", "f 1/1 2/2 3/3\n", "f 1/1 2/2 3/-3\n", "f 1/1 2/2 3/0\n",
          "vt 0 inf\nf 1/1 2/2 3/3\n", "f 1/1 2/2 3/1-1\n", "f 1/1 2/2 3/99999999999999999999\n"}) {
        const MeshFile file = read_textured("a.obj", head + tail);
        EXPECT_TRUE(texture_of(file).empty()) << tail;
        EXPECT_EQ(complaints_of(file), std::string("vt") + broken) << tail;
        EXPECT_EQ(file.mesh.triangles.size(), 1u);
        ++num_tried;
    }
    EXPECT_EQ(num_tried, 7);
    EXPECT_TRUE(texture_of(read_textured("a.obj", head + "f 1 2 3\n")).empty());
    EXPECT_TRUE(texture_of(texts::read_bytes("a.obj", head + "f 1/1 2/2 3/1\n")).empty());
}

TEST(Texture, PlyHasPairsOfVertices) {
    for (const char* names : {"s t", "u v", "texture_u texture_v", "texture_s texture_t"}) {
        const std::string name = names;
        const MeshFile file = read_textured(
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\nproperty float " +
                name.substr(0, name.find(' ')) + "\nproperty double " +
                name.substr(name.find(' ') + 1) +
                "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                "0 0 0 0 .5\n1 0 0 1 0\n1 1 0 1 1\n3 0 1 2\n");
        expect_same_corners(texture_of(file).corners, {{Vec2(0, 0.5), Vec2(1, 0), Vec2(1, 1)}});
        EXPECT_EQ(texture_of(file).type, NumberType::Float64);
        EXPECT_TRUE(file.attributes.of_vertices.empty());
    }
}

TEST(Texture, PlyHasListsOfFaces) {
    const auto lists = [](const std::string& faces) {
        return read_textured("a.ply",
                             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                             "property float y\nproperty float z\nelement face 2\n"
                             "property list uchar float texcoord\nproperty list uchar int "
                             "vertex_indices\nproperty int texnumber\nend_header\n"
                             "0 0 0\n1 0 0\n1 1 0\n0 1 0\n" +
                                 faces);
    };
    const MeshFile file = lists("8 0 0 5 0 5 5 0 5 4 0 1 2 3 2\n0 3 2 1 0 3\n");
    ASSERT_EQ(texture_of(file).corners.size(), 3u);
    for (std::size_t f = 0; f < 2; ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(texture_of(file).corners[f][k],
                      5 * file.mesh.positions[file.mesh.triangles[f][k]].head<2>());
        }
    }
    EXPECT_TRUE(std::isnan(texture_of(file).corners[2][0].x()));
    EXPECT_EQ(texture_of(file).type, NumberType::Float32);
    // The image is a label of the face.
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].values, (std::vector<double>{2, 2, 3}));
    for (const char* faces : {"6 0 0 5 0 5 5 4 0 1 2 3 2\n0 3 2 1 0 3\n",
                              "8 0 0 5 0 x 5 0 5 4 0 1 2 3 2\n0 3 2 1 0 3\n",
                              "8 0 0 5 0 nan 5 0 5 4 0 1 2 3 2\n0 3 2 1 0 3\n"}) {
        EXPECT_EQ(complaints_of(lists(faces)), std::string("face texcoord") + broken);
    }
    EXPECT_EQ(complaints_of(lists("0 4 0 1 2 3 2\n0 3 2 1 0 3\n")), "");
}

TEST(Texture, OffAndVtkHaveThemAtVertices) {
    const std::vector<CornerCoordinates> wanted{{Vec2(0, 0.5), Vec2(1, 0), Vec2(0, 1)}};
    const MeshFile off =
        read_textured("a.off",
                      "STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 255 0 .5\n"
                      "1 0 0 0 0 1 0 0 0 255 1 0\n0 1 0 0 0 1 0 0 0 255 0 1\n3 0 1 2\n");
    expect_same_corners(texture_of(off).corners, wanted);
    EXPECT_EQ(off.attributes.of_vertices.size(), 4u);
    const MeshFile plain =
        read_textured("a.off", "STOFF\n3 1 0\n0 0 0 0 .5\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2 1 0 0\n");
    expect_same_corners(texture_of(plain).corners, wanted);
    EXPECT_TRUE(plain.attributes.of_vertices.empty());
    EXPECT_EQ(plain.attributes.of_faces.size(), 3u);
    for (const char* line : {"0 0 0 0", "0 0 0 0 x", "0 0 0"}) {
        const MeshFile file = read_textured(
            "a.off", std::string("STOFF\n3 1 0\n") + line + "\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
        EXPECT_EQ(complaints_of(file), std::string("ST") + broken) << line;
    }
    const std::string head =
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
        "0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\nPOINT_DATA 3\nTEXTURE_COORDINATES uv ";
    const MeshFile two = read_textured("a.vtk", head + "2 double\n0 .5 1 0 0 1\n");
    expect_same_corners(texture_of(two).corners, wanted);
    expect_same_corners(
        texture_of(read_textured("a.vtk", head + "3 float\n0 .5 9 1 0 9 0 1 9\n")).corners, wanted);
    EXPECT_NE(complaints_of(read_textured("a.vtk", head + "1 float\n0 .5 9\n")).find("vertex uv"),
              std::string::npos);
}

TEST(Texture, WhatWasWrittenComesBack) {
    for (const std::string name : {"a.ply", "a.obj", "a.glb"}) {
        const MeshAttributes attributes = on_square(0.375);
        const MeshFile file = square_read_back(name, attributes);
        EXPECT_EQ(complaints_of(file), "");
        expect_same_corners(texture_of(file).corners, attributes.texture.corners);
        EXPECT_EQ(texture_of(file).seams.size(), 1u) << name;
        EXPECT_EQ(file.mesh.positions.size(), name == "a.glb" ? 6u : 4u) << name;
    }
    for (const std::string name : {"a.ply", "a.obj", "a.glb", "a.vtk", "a.off"}) {
        MeshAttributes attributes = on_square(0);
        attributes.normals = NumberType::Float32;
        EXPECT_TRUE(remesh::remove_unwritable(name, attributes).empty()) << name;
        const MeshFile file = square_read_back(name, attributes);
        expect_same_corners(texture_of(file).corners, attributes.texture.corners);
        EXPECT_TRUE(texture_of(file).seams.empty()) << name;
        EXPECT_EQ(file.mesh.positions.size(), 4u) << name;
        EXPECT_TRUE(file.attributes.normals.has_value()) << name;
    }
}

TEST(Texture, GlbSplitsColoursAndNormalsAsWell) {
    MeshAttributes attributes = on_square(1);
    attributes.normals = NumberType::Float32;
    for (const char* name : {"red", "green", "blue"}) {
        attributes.of_vertices.push_back(
            {.name = name, .type = NumberType::UInt8, .values = {10, 20, 30, 40}});
    }
    const MeshFile file = square_read_back("a.glb", attributes);
    const auto& red = file.attributes.of_vertices[0].values;
    ASSERT_EQ(red.size(), 6u);
    const agvd::TriangleMesh square = shapes::grid(1);
    for (std::size_t v = 0; v < 6; ++v) {
        const auto at =
            std::find(square.positions.begin(), square.positions.end(), file.mesh.positions[v]);
        ASSERT_NE(at, square.positions.end());
        EXPECT_NEAR(255 * red[v], 10.0 * static_cast<double>(at - square.positions.begin() + 1),
                    1e-9);
    }
}

TEST(Texture, DoublesStayDoubles) {
    MeshAttributes attributes = on_square(1.0 / 3);
    attributes.texture.type = NumberType::Float64;
    for (const char* name : {"a.ply", "a.obj"}) {
        expect_same_corners(texture_of(square_read_back(name, attributes)).corners,
                            attributes.texture.corners);
    }
    // Decimals of a text are floats in PLY, as MeshLab reads them.
    attributes.texture.type.reset();
    expect_same_corners(texture_of(square_read_back("a.obj", attributes)).corners,
                        attributes.texture.corners);
    const std::string bytes = written_square("a.ply", attributes);
    EXPECT_NE(bytes.find("property list uchar float texcoord\n"), std::string::npos);
}

TEST(Texture, EqualOnesAreWrittenOnce) {
    const std::string text = written_square("a.obj", on_square(0));
    std::size_t count = 0;
    for (std::size_t at = text.find("vt "); at != std::string::npos; at = text.find("vt ", at + 1))
        ++count;
    EXPECT_EQ(count, 4u);
    MeshAttributes with_normals = on_square(0);
    with_normals.normals = NumberType::Float32;
    EXPECT_NE(written_square("a.obj", with_normals).find("f 1/1/1 "), std::string::npos);
}

TEST(Texture, FacesWithoutThemAreWrittenWithoutThem) {
    MeshAttributes attributes = on_square(0);
    attributes.texture.corners[1][2] = remesh::no_coordinates()[0];
    auto wanted = attributes.texture.corners;
    wanted[1] = remesh::no_coordinates();
    for (const char* name : {"a.ply", "a.obj"}) {
        expect_same_corners(wanted, texture_of(square_read_back(name, attributes)).corners);
    }
}

TEST(Texture, FormatsThatCannotHoldThemSaySo) {
    struct Wanted {
        const char* name;
        std::size_t with_seam, without;
    };
    for (const auto& [name, with_seam, without] :
         {Wanted{"a.stl", 1, 1}, Wanted{"a.mesh", 1, 1}, Wanted{"a.vtk", 1, 0},
          Wanted{"a.off", 1, 0}, Wanted{"a.ply", 0, 0}, Wanted{"a.obj", 0, 0},
          Wanted{"a.glb", 0, 0}}) {
        MeshAttributes seam = on_square(1), none = on_square(0);
        EXPECT_EQ(remesh::remove_unwritable(name, seam).size(), with_seam) << name;
        EXPECT_EQ(seam.texture.empty(), with_seam == 1);
        EXPECT_EQ(remesh::remove_unwritable(name, none).size(), without) << name;
    }
    MeshAttributes seam = on_square(1);
    EXPECT_EQ(remesh::remove_unwritable("a.stl", seam),
              std::vector<std::string>{"corner texcoord"});
    // Without asking first: left out.
    EXPECT_TRUE(texture_of(square_read_back("a.vtk", on_square(1))).empty());
    MeshAttributes few = on_square(0);
    few.texture.corners.pop_back();
    EXPECT_THROW(static_cast<void>(written_square("a.obj", few)), agvd::InvalidInput);
}

TEST(Texture, TheResultHasThemAndKeptFacesTheSameBits) {
    const agvd::TriangleMesh grid = shapes::grid(8);
    MeshFile input;
    input.mesh = grid;
    for (const agvd::Triangle& t : grid.triangles) {
        const auto at = [&](Index v) { return Vec2(grid.positions[v].head<2>() / 3); };
        input.attributes.texture.corners.push_back({at(t[0]), at(t[1]), at(t[2])});
    }
    const agvd::Triangle& first = grid.triangles[0];
    const agvd::TriangleMesh result{
        {grid.positions[first[0]], grid.positions[first[1]], grid.positions[first[2]]},
        {{0, 1, 2}, {2, 1, 0}}};
    const remesh::InputMap map{
        {{agvd::FaceId(0), {1, 0, 0}}, {agvd::FaceId(0), {0, 1, 0}}, {agvd::FaceId(0), {0, 0, 1}}},
        {}};
    remesh::MeshAttributes carried = transfer_attributes(input, result.view(), map);
    ASSERT_EQ(carried.texture.corners.size(), 2u);
    EXPECT_EQ(carried.texture.corners[0], input.attributes.texture.corners[0]);
    const std::vector<Index> vertices, faces{17};
    keep_attributes(input.attributes, vertices, faces, carried);
    EXPECT_EQ(carried.texture.corners[0], input.attributes.texture.corners[17]);
    EXPECT_EQ(carried.texture.corners[1][1], input.attributes.texture.corners[0][1]);
}
