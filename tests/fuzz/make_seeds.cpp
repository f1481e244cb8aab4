// make_seeds FOLDER: the first inputs of every fuzz target, in FOLDER/TARGET: small files of every
// format, and bytes that give each shape of small_mesh once.
#include <bit>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/packed.h"
#include "support/dice.h"
#include "support/msh_text.h"
#include "support/points.h"
#include "support/shapes.h"
#include "support/vtp_text.h"

namespace {

using agvd::Index;
using agvd::TriangleMesh;

class Seeds {
public:
    explicit Seeds(std::filesystem::path folder) : folder_(std::move(folder)) {}

    void put(const char* target, const std::string& bytes) {
        std::filesystem::create_directories(folder_ / target);
        std::ofstream file(folder_ / target / ("seed-" + std::to_string(number_++)),
                           std::ios::binary);
        file << bytes;
    }

private:
    std::filesystem::path folder_;
    int number_ = 0;
};

std::string ply_header(const TriangleMesh& mesh, const char* format) {
    std::ostringstream text;
    text << "ply\nformat " << format << " 1.0\ncomment a seed\nelement vertex "
         << mesh.positions.size() << "\nproperty float x\nproperty float y\nproperty double z\n"
         << "property uchar red\nelement face " << mesh.triangles.size()
         << "\nproperty list uchar short vertex_indices\nproperty list ushort float texcoord\n"
         << "end_header\n";
    return text.str();
}

std::string ascii_ply(const TriangleMesh& mesh) {
    std::ostringstream text;
    text << ply_header(mesh, "ascii");
    for (const auto& p : mesh.positions) text << p.transpose() << " 7\n";
    for (const auto& [a, b, c] : mesh.triangles)
        text << "3 " << a << ' ' << b << ' ' << c << " 1 .5\n";
    return text.str();
}

template <typename T>
void append_big_endian(std::string& bytes, T value) {
    auto stored = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (std::endian::native == std::endian::little) std::ranges::reverse(stored);
    bytes.append(stored.data(), stored.size());
}

std::string big_endian_ply(const TriangleMesh& mesh) {
    std::string bytes = ply_header(mesh, "binary_big_endian");
    for (const auto& p : mesh.positions) {
        append_big_endian(bytes, static_cast<float>(p.x()));
        append_big_endian(bytes, static_cast<float>(p.y()));
        append_big_endian(bytes, p.z());
        append_big_endian(bytes, std::uint8_t{7});
    }
    for (const agvd::Triangle& t : mesh.triangles) {
        append_big_endian(bytes, std::uint8_t{3});
        for (const Index v : t) append_big_endian(bytes, static_cast<std::int16_t>(v));
        append_big_endian(bytes, std::uint16_t{1});
        append_big_endian(bytes, 0.5f);
    }
    return bytes;
}

std::string ascii_stl(const TriangleMesh& mesh) {
    std::ostringstream text;
    text << "solid seed\n";
    for (const agvd::Triangle& t : mesh.triangles) {
        text << "facet normal 0 0 1\n outer loop\n";
        for (const Index v : t) text << "  vertex " << mesh.positions[v].transpose() << '\n';
        text << " endloop\nendfacet\n";
    }
    text << "endsolid seed\n";
    return text.str();
}

// Texture coordinates with a seam, without one, and with faces that have none.
void put_textures(Seeds& seeds) {
    const TriangleMesh mesh = shapes::grid(2);
    remesh::MeshAttributes attributes;
    for (const agvd::Triangle& t : mesh.triangles) {
        const auto at = [&](Index v) { return agvd::Vec2(mesh.positions[v].head<2>()); };
        attributes.texture.corners.push_back({at(t[0]), at(t[1]), at(t[2])});
    }
    seeds.put("read_off", remesh::format_mesh("a.off", mesh.view(), attributes));
    seeds.put("read_vtk", remesh::format_mesh("a.vtk", mesh.view(), attributes));
    for (agvd::Vec2& corner : attributes.texture.corners[3]) corner.x() += 1;
    attributes.texture.corners[5] = remesh::no_coordinates();
    for (const auto& [target, name] :
         {std::pair("read_ply", "a.ply"), {"read_obj", "a.obj"}, {"read_glb", "a.glb"}}) {
        seeds.put(target, remesh::format_mesh(name, mesh.view(), attributes));
    }
    seeds.put("read_ply",
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
              "property float z\nproperty float s\nproperty double t\nelement face 2\n"
              "property list uchar float texcoord\nproperty list uchar int vertex_indices\n"
              "property int texnumber\nend_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n"
              "8 0 0 1 0 1 1 0 1 4 0 1 2 3 0\n0 3 0 1 2 1\n");
    seeds.put("read_obj",
              "vt 0 0\nvt 1\nvt 1 1 0\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1 2/-2 3/3/1\n"
              "f 4//1 1/4 3\nvt .5 -2\nf 1/1 3/3 2/2 4/4\n");
}

// A triangle and a tetrahedron of Gmsh's version 4.1.
void put_msh(Seeds& seeds) {
    for (const bool is_binary : {false, true}) {
        msh::Text text({.is_binary = is_binary});
        text.raw("$PhysicalNames\n1\n2 7 \"walls\"\n$EndPhysicalNames\n$Entities\n");
        text.sizes({0, 0, 1, 0}).integers({1}).reals({0, 0, 0, 1, 1, 0}).sizes({1}).integers({7});
        text.sizes({0}).end_line().raw("$EndEntities\n$PartitionedEntities\n").sizes({2, 0});
        text.sizes({0, 0, 1, 0}).integers({2, 2, 1}).sizes({1}).integers({1});
        text.reals({0, 0, 0, 1, 1, 0}).sizes({1}).integers({7}).sizes({0}).end_line();
        text.raw("$EndPartitionedEntities\n$Nodes\n").sizes({1, 4, 3, 9}).integers({2, 1, 0});
        text.sizes({4}).tags({9, 4, 3, 5}).reals({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}).end_line();
        text.raw("$EndNodes\n$Elements\n").sizes({2, 2, 1, 2}).integers({2, 2, 2}).sizes({1});
        text.tags({1, 9, 4, 3}).integers({3, 1, 4}).sizes({1}).tags({2, 9, 4, 3, 5}).end_line();
        text.raw("$EndElements\n$ElementData\n1\n\"h\"\n0\n3\n0\n1\n1\n").integers({1});
        text.reals({.5}).end_line().raw("$EndElementData\n");
        seeds.put("read_msh", text.bytes());
    }
}

void put_meshes(Seeds& seeds) {
    for (const TriangleMesh& mesh : {shapes::tetrahedron(), shapes::grid(2), shapes::cube()}) {
        seeds.put("read_ply", remesh::format_mesh("a.ply", mesh.view()));
        seeds.put("read_ply", ascii_ply(mesh));
        seeds.put("read_ply", big_endian_ply(mesh));
        seeds.put("read_obj", remesh::format_mesh("a.obj", mesh.view()));
        seeds.put("read_off", remesh::format_mesh("a.off", mesh.view()));
        seeds.put("read_stl", remesh::format_mesh("a.stl", mesh.view()));
        seeds.put("read_stl", ascii_stl(mesh));
        seeds.put("read_vtk", remesh::format_mesh("a.vtk", mesh.view()));
        seeds.put("read_vtp", remesh::format_mesh("a.vtp", mesh.view()));
        seeds.put("read_3mf", remesh::format_mesh("a.3mf", mesh.view()));
        seeds.put("read_medit", remesh::format_mesh("a.mesh", mesh.view()));
        seeds.put("read_msh", remesh::format_mesh("a.msh", mesh.view()));
        seeds.put("read_glb", remesh::format_mesh("a.glb", mesh.view()));
        seeds.put("read_gzip", remesh::pack_gzip(ascii_ply(mesh), {}));
    }
    seeds.put("read_off",
              "COFF # colours\n5 2 0\n0 0 0 255 0 0 255\n1 0 0 0 1 0 1\n1 1 0 .5 .5 .5 1\n"
              "0 1 0 9 9 9 9\n.5 2 0 9 9 9 9\n4 0 1 2 3 128 128 0\n3 3 2 4\n");
    seeds.put("read_off",
              "STNOFF 6 1 0\n1 0 0 0 0 1 0 0\n2 0 0 0 0 1 0 0\n2 1 0 0 0 1 0 0\n"
              "1.5 .5 0 0 0 1 0 0\n1 2 0 0 0 1 0 0\n0 1 0 0 0 1 0 0\n6 0 1 2 3 4 5\n");
    seeds.put("read_ply",
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
              "property float z\nproperty float nx\nproperty short id\nproperty float s\n"
              "property float t\nproperty list uchar int near\nelement face 2\n"
              "property uint label\nproperty list uchar int vertex_indices\n"
              "property double heat\nend_header\n0 0 0 1 7 0 0 0\n1 0 0 1 -7 0 1 1 2\n"
              "1 1 0 1 8 1 1 0\n0 1 0 1 9 1 0 0\n5 4 0 1 2 3 nan\n9 3 0 1 2 -1e9\n");
    seeds.put("read_ply",
              "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
              "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
              "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 4 -1 0 1 3\n");
    seeds.put("read_vtk",
              "# vtk DataFile Version 2.0\na seed\nASCII\nDATASET UNSTRUCTURED_GRID\n"
              "POINTS 5 float\n0 0 0 1 0 0\n0 1 0 1 1 0 0 2 0\nCELLS 4 19\n3 0 1 2\n4 0 1 2 3\n"
              "4 0 1 3 2\n4 1 3 2 4\nCELL_TYPES 4\n5 8 9 6\nCELL_DATA 4\n"
              "SCALARS part%20id int\nLOOKUP_TABLE default\n9 7 8 6\nFIELD f 1\nheat 1 4 double\n"
              ".5 1.5 2.5 3\nPOINT_DATA 5\nCOLOR_SCALARS c 3\n1 0 0 1 0 1 0 1 0 0 1 1 1 1 1\n"
              "NORMALS n float\n0 0 1 0 0 1 0 0 1 0 0 1 0 0 1\n");
    seeds.put("read_vtk",
              "# vtk DataFile Version 5.1\na seed\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n"
              "0 0 0 1 0 0 0 1 0 1 1 0\nMETADATA\nINFORMATION 0\n\nLINES 2 2\nOFFSETS int\n0 2\n"
              "CONNECTIVITY int\n0 1\nPOLYGONS 2 4\nOFFSETS vtktypeint64\n0 4\n"
              "CONNECTIVITY vtktypeint64\n0 1 3 2\nTRIANGLE_STRIPS 2 4\nOFFSETS int\n0 4\n"
              "CONNECTIVITY int\n0 1 2 3\n");
    seeds.put("read_medit",
              "MeshVersionFormatted 1\nDimension\n3\n# a seed\nVertices 5\n0 0 0 1\n1 0 0 0\n"
              "0 1 0 0\n1 1 0 -3\n0 2 0 0\nEdges 1 1 2 0\nTriangles 2 1 2 3 7\n3 4 5 8\n"
              "Quadrilaterals 1 1 2 4 3 9\nCorners 1 1\nEnd\n");
    put_msh(seeds);
    const auto glb = [](std::string json, const std::string& data) {
        json.resize((json.size() + 3) / 4 * 4, ' ');
        std::string bytes = "glTF";
        remesh::append(bytes, std::uint32_t{2});
        remesh::append(bytes, static_cast<std::uint32_t>(28 + json.size() + data.size()));
        remesh::append(bytes, static_cast<std::uint32_t>(json.size()));
        bytes += "JSON" + json;
        remesh::append(bytes, static_cast<std::uint32_t>(data.size()));
        return bytes + std::string("BIN\0", 4) + data;
    };
    std::string points;
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f}) {
        remesh::append(points, x);
    }
    seeds.put(
        "read_glb",
        glb("{\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"children\":[1,2],\"scale\":[1,-1,2]},"
            "{\"mesh\":0,\"rotation\":[0,0,1,1]},{\"mesh\":0,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,"
            "5,0,0,1]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":5,"
            "\"material\":0},{\"attributes\":{\"POSITION\":0,\"COLOR_0\":1},\"mode\":6}]}],"
            "\"materials\":[{\"name\":\"a\"}],\"buffers\":[{\"byteLength\":48}],\"bufferViews\":"
            "[{\"buffer\":0,\"byteLength\":48}],\"accessors\":[{\"bufferView\":0,\"componentType\":"
            "5126,\"count\":4,\"type\":\"VEC3\"},{\"bufferView\":0,\"componentType\":5121,"
            "\"count\":4,"
            "\"type\":\"VEC4\",\"normalized\":true}]}",
            points));
    seeds.put("read_obj",
              "mtllib a.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\nusemtl a b\n"
              "g x\nf 3 2 1\nusemtl c\\\\\no y\nf 1 3 2\n");
    seeds.put("read_obj",
              "# a seed\no part\nv 0 0 0\r\nv 1 0 0 1 .5 .5\r\nv 1 1 0\r\nv 0 1e0 0\r\nvt 0 0\n"
              "vn 0 0 1\nusemtl m\nf 1/1/1 2//1 \\\n 3/1 4\nf -4 -2 -1\nl 1 2\nv +.5 2 -0\n"
              "f 4 3 5 1 2\n");
}

std::string small_vtp(const VtpStyle& style) {
    VtpText text(style);
    text.add(
        "<PolyData><Piece NumberOfPoints='4' NumberOfLines='1' NumberOfStrips='1' "
        "NumberOfPolys='1'><PointData Normals='n'>");
    text.array<float>("type='Float32' Name='heat'", {.5f, 1, 2, 3});
    text.add("</PointData><CellData>");
    text.array<std::int64_t>("type='Int64' Name='part'", {7, 9, 8});
    text.add("</CellData><Points>");
    text.array<float>("type='Float32' NumberOfComponents='3'",
                      {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    text.add("</Points><Polys>");
    text.array<std::int32_t>("type='Int32' Name='connectivity'", {0, 1, 3, 2});
    text.array<std::int32_t>("type='Int32' Name='offsets'", {4});
    text.add("</Polys><Strips>");
    text.array<std::int32_t>("type='Int32' Name='connectivity'", {1, 3, 2});
    text.array<std::int32_t>("type='Int32' Name='offsets'", {3});
    text.add("</Strips><Lines>");
    text.array<std::int32_t>("type='Int32' Name='connectivity'", {0, 1});
    text.array<std::int32_t>("type='Int32' Name='offsets'", {2});
    text.add("</Lines></Piece></PolyData>");
    return text.finish();
}

void put_packages(Seeds& seeds) {
    for (const auto encoding :
         {VtpStyle::Ascii, VtpStyle::Binary, VtpStyle::Base64, VtpStyle::Raw}) {
        seeds.put("read_vtp", small_vtp({.encoding = encoding, .order = std::endian::big}));
        seeds.put("read_vtp",
                  small_vtp({.encoding = encoding, .is_wide = true, .is_packed = true}));
    }
    seeds.put("read_3mf",
              "<model xmlns='http://schemas.microsoft.com/3dmanufacturing/core/2015/02' "
              "xmlns:m='http://schemas.microsoft.com/3dmanufacturing/material/2015/02'><resources>"
              "<basematerials id='5'><base name='a'/></basematerials><m:colorgroup id='6'>"
              "<m:color color='#FF0000'/></m:colorgroup><object id='1' pid='5' pindex='0' name='b'>"
              "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/>"
              "<vertex x='0' y='1' z='0'/></vertices><triangles><triangle v1='0' v2='1' v3='2'/>"
              "<triangle v1='2' v2='1' v3='0' pid='6' p1='0'/></triangles></mesh></object>"
              "<object id='2'><components><component objectid='1'/><component objectid='1' "
              "transform='1 0 0 0 -1 0 0 0 1 5 0 0'/></components></object></resources><build>"
              "<item objectid='2' transform='2 0 0 0 2 0 0 0 2 0 0 0'/></build></model>");
}

void put_sites(Seeds& seeds) {
    seeds.put("read_sites", "# sites\nv 0\nv 15 # the last one\nf 17 .25 .25 .5\nf 0 1 0 0\n");
    seeds.put("read_sites", "p 0.5 0.5 0\r\np -1 2e0 +.3\rp 1e308 0 0\n\xEF\xBB\xBF");
    seeds.put("read_sites", "\xEF\xBB\xBFv 16\nf 0 0.3333333 0.3333333 0.3333334\n");
    seeds.put("read_edges", "0 1\n1 2 # one\n\n4294967294 7\r\n");
    const agvd::Surface surface = agvd::build_surface(shapes::icosahedron().view());
    for (const Index num_sites : {1u, 6u}) {
        const auto sites = points::scattered(surface, num_sites, 3);
        const agvd::Diagram diagram =
            agvd::build_diagram(surface, sites, agvd::propagate(surface, sites));
        seeds.put("read_diagram", remesh::format_diagram("a.agvd", surface, sites, diagram));
    }
    const std::vector<agvd::SiteShape> shapes{{.edges = {0, 1}, .site = 0},
                                              {.faces = {7}, .site = 1}};
    const agvd::Diagram diagram =
        agvd::build_diagram(surface, {}, agvd::propagate(surface, {}, {.shapes = shapes}));
    seeds.put("read_diagram",
              remesh::format_diagram("a.agvd", surface, {}, diagram, {}, {}, shapes));
}

// Random options and each shape of small_mesh: as it is, and moved at random. What is left are
// random sites.
void put_shapes(Seeds& seeds) {
    Dice dice(1);
    const auto random = [&](Index count) {
        std::string bytes;
        for (; count > 0; --count) bytes += static_cast<char>(dice.count(0, 255));
        return bytes;
    };
    for (int shape = 0; shape < 16; ++shape) {
        for (const bool is_moved : {false, true}) {
            for (const auto& [target, num_options] : {std::pair("remesh", 17u), {"diagram", 6u}}) {
                const std::string bytes = random(num_options) + static_cast<char>(shape) +
                                          random(2) + (is_moved ? "" : std::string("\0\0\7", 3));
                seeds.put(target, bytes + random(80));
            }
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    Seeds seeds(argv[1]);
    put_meshes(seeds);
    put_packages(seeds);
    put_textures(seeds);
    put_sites(seeds);
    put_shapes(seeds);
}
