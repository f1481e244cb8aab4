#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "support/read_text.h"

using agvd::InvalidInput;
using agvd::IoError;
using agvd::Triangle;
using agvd::Vec3;
using texts::expect_error;
using texts::read_bytes;

namespace {

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string faces = "property list uchar int vertex_indices\n";

std::string header(const std::string& format, const std::string& elements) {
    return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}

std::string triangle_header(const std::string& format) {
    return header(format, "element vertex 3\n" + xyz + "element face 1\n" + faces);
}

template <typename T>
std::string bytes_of(T value, bool is_big) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (is_big) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

const std::string three = "0 0 0\n1 0 0\n0 1 0\n";

void expect_one_ply_triangle(const std::string& bytes) {
    const auto file = read_bytes("a.ply", bytes);
    ASSERT_EQ(file.mesh.positions.size(), 3u) << bytes;
    EXPECT_EQ(file.mesh.positions[1], Vec3(1, 0, 0)) << bytes;
    EXPECT_EQ(file.mesh.positions[2], Vec3(0, 1, 0)) << bytes;
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}})) << bytes;
}

remesh::MeshFile read_leniently(const std::string& bytes) {
    return remesh::read_ply({.path = "a.ply", .bytes = bytes, .is_lenient = true});
}

template <typename Real, typename Size, typename Corner>
void expect_binary_read(const std::string& real, const std::string& size,
                        const std::string& corner) {
    for (const bool is_big : {false, true}) {
        const std::string p = "property " + real + " ";
        std::string bytes = header(is_big ? "binary_big_endian" : "binary_little_endian",
                                   "element vertex 3\n" + p + "x\n" + p + "y\n" + p +
                                       "z\nelement face 1\nproperty list " + size + " " + corner +
                                       " vertex_index\n");
        for (const int x : {0, 0, 0, 1, 0, 0, 0, 1, 0})
            bytes += bytes_of(static_cast<Real>(x), is_big);
        bytes += bytes_of(Size{3}, is_big);
        for (const int v : {0, 1, 2}) bytes += bytes_of(static_cast<Corner>(v), is_big);
        expect_one_ply_triangle(bytes);
    }
}

const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
const std::string six = three + "1 1 0\n0 2 0\n1 2 0\n";

// The triangles of strips over six vertices.
std::vector<Triangle> triangles_of_strips(const std::string& list) {
    return read_bytes("a.ply", header("ascii", "element vertex 6\n" + xyz + strips) + six + list)
        .mesh.triangles;
}

}  // namespace

TEST(Ply, AsciiIsRead) {
    expect_one_ply_triangle(triangle_header("ascii") + three + "3 0 1 2\n");
    std::string crlf = triangle_header("ascii") + three + "3 0 1 2\n";
    for (std::size_t at = 0; (at = crlf.find('\n', at)) != std::string::npos; at += 2) {
        crlf.replace(at, 1, "\r\n");
    }
    expect_one_ply_triangle(crlf);
}

TEST(Ply, BinariesOfAllTypesAreRead) {
    expect_binary_read<float, std::uint8_t, std::int32_t>("float", "uchar", "int");
    expect_binary_read<double, std::int8_t, std::uint32_t>("double", "int8", "uint32");
    expect_binary_read<double, std::uint32_t, std::uint8_t>("float64", "uint", "uint8");
    expect_binary_read<std::int16_t, std::int16_t, std::int16_t>("short", "int16", "short");
    expect_binary_read<std::uint16_t, std::int32_t, std::uint16_t>("uint16", "int32", "ushort");
    expect_binary_read<float, std::uint16_t, std::int8_t>("float32", "ushort", "char");
}

TEST(Ply, DoublesKeepEveryDigit) {
    std::string bytes = header("binary_big_endian",
                               "element vertex 3\nproperty double x\nproperty "
                               "double y\nproperty double z\nelement face 1\n" +
                                   faces);
    for (int k = 0; k < 9; ++k) bytes += bytes_of(0.1 + k, true);
    bytes += bytes_of(std::uint8_t{3}, true);
    for (int v = 0; v < 3; ++v) bytes += bytes_of(v, true);
    EXPECT_EQ(read_bytes("a.ply", bytes).mesh.positions[2], Vec3(0.1 + 6, 0.1 + 7, 0.1 + 8));
}

TEST(Ply, OtherPropertiesAndElementsArePassedOver) {
    const std::string elements =
        "comment made by hand\nobj_info x\nelement camera 1\nproperty double fov\nproperty list "
        "short "
        "double parameters\nelement vertex 3\nproperty uchar red\n" +
        xyz +
        "property list uint char name\nproperty double quality\nelement nothing 99999999999\n"
        "element face 1\nproperty ushort flags\n" +
        faces + "property list uchar float texcoord\nelement edge 1\nproperty int a\n";
    expect_one_ply_triangle(header("ascii", elements) +
                            "0.5 2 1 2\n255 0 0 0 0 1\n255 1 0 0 3 1 2 3 1\n0 0 1 0 0 1\n"
                            "7 3 0 1 2 2 0.5 0.5\n5\n");
    std::string bytes = header("binary_little_endian", elements) + bytes_of(0.5, false) +
                        bytes_of(std::int16_t{2}, false) + bytes_of(1.0, false) +
                        bytes_of(2.0, false);
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
        bytes += '\xff';
        for (const double x : p) bytes += bytes_of(static_cast<float>(x), false);
        bytes += bytes_of(std::uint32_t{2}, false) + "ab" + bytes_of(1.0, false);
    }
    bytes += bytes_of(std::uint16_t{7}, false) + '\3' + bytes_of(0, false) + bytes_of(1, false) +
             bytes_of(2, false) + '\1' + bytes_of(0.5f, false) + bytes_of(5, false);
    expect_one_ply_triangle(bytes);
}

TEST(Ply, FacesMayPrecedeVertices) {
    expect_one_ply_triangle(
        header("ascii", "element face 1\n" + faces + "element vertex 3\n" + xyz) + "3 0 1 2\n" +
        three);
}

TEST(Ply, TheLastLineOfTheHeaderMayEndInCrLfUnderLf) {
    std::string bytes = triangle_header("binary_little_endian");
    bytes.insert(bytes.size() - 1, "\r");
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) bytes += bytes_of(x, false);
    expect_one_ply_triangle(bytes + '\3' + bytes_of(0, false) + bytes_of(1, false) +
                            bytes_of(2, false));
}

TEST(Ply, LenientlyValuesLeftOverOnALineArePassedOver) {
    const std::string bytes = triangle_header("ascii") + "0 0 0 255\n1 0 0 0 0\n0 1 0\n3 0 1 2 9\n";
    expect_error<IoError>("a.ply", bytes, {"line 10", "more values", "--lenient"});
    const auto file = read_leniently(bytes);
    EXPECT_EQ(file.mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("line 10: 3 lines have more values"), std::string::npos)
        << file.warnings[0];
}

TEST(Ply, LenientlyLinesOfTheHeaderWithoutAKeywordArePassedOver) {
    std::string bytes = triangle_header("ascii") + three + "3 0 1 2\n";
    bytes.insert(bytes.find("element"), "Created by a program\n");
    bytes.insert(bytes.find("end_header"), "more of it\n");
    expect_error<IoError>("a.ply", bytes, {"line 3", "'Created'", "--lenient"});
    const auto file = read_leniently(bytes);
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("line 3: 2 lines of the header"), std::string::npos)
        << file.warnings[0];
    EXPECT_THROW((void)read_leniently(header("ascii", "property int x\n")), IoError);
}

// One byte too many behind the header: the first face read has no corner, and one more is left.
TEST(Ply, LenientlyNothingIsReadFromTheWrongPlace) {
    std::string bytes = triangle_header("binary_little_endian") + '\n';
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) bytes += bytes_of(x, false);
    bytes.replace(bytes.find("face 1"), 6, "face 2");
    for (int i = 0; i < 2; ++i) {
        bytes += '\3' + bytes_of(0, false) + bytes_of(1, false) + bytes_of(2, false);
    }
    expect_error<IoError>("a.ply", bytes, {"announces 2 face elements, the file holds 3"});
    try {
        (void)read_leniently(bytes);
        ADD_FAILURE() << "rubbish was read";
    } catch (const IoError& error) {
        EXPECT_NE(std::string(error.what()).find("not even leniently"), std::string::npos);
    }
}

TEST(Ply, BinaryDataMayBeginLikeALineEnd) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        std::string bytes =
            header("binary_little_endian",
                   "element vertex 3\nproperty char x\nproperty char y\nproperty char "
                   "z\nelement face 1\nproperty list char char vertex_indices\n");
        for (std::size_t at = 0; (at = bytes.find('\n', at)) != std::string::npos;
             at += end.size()) {
            bytes.replace(at, 1, end);
        }
        const auto file =
            read_bytes("a.ply", bytes + "\n\r\n" + "abcdef" + std::string("\3\0\1\2", 4));
        EXPECT_EQ(file.mesh.positions[0], Vec3(10, 13, 10));
    }
}

TEST(Ply, StripsAreTurnedAtEverySecondTriangle) {
    EXPECT_EQ(triangles_of_strips("6 0 1 2 3 4 5\n"),
              (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}}));
}

TEST(Ply, MinusOneEndsAStrip) {
    const std::vector<Triangle> expected{{0, 1, 2}, {2, 1, 3}, {3, 4, 5}};
    EXPECT_EQ(triangles_of_strips("8 0 1 2 3 -1 3 4 5\n"), expected);
    EXPECT_EQ(triangles_of_strips("11 -1 0 1 2 3 -1 -1 3 4 5 -1\n"), expected);
}

TEST(Ply, AVertexNamedTwiceTurnsAStrip) {
    EXPECT_EQ(triangles_of_strips("5 0 1 2 2 3\n"), (std::vector<Triangle>{{0, 1, 2}}));
    // The triangles 2 1 2 and 1 2 1 in between have no area.
    EXPECT_EQ(triangles_of_strips("7 0 1 2 1 2 3 4\n"),
              (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}}));
}

TEST(Ply, BinaryStripsOfSeveralListsAreRead) {
    for (const bool is_big : {false, true}) {
        std::string bytes =
            header(is_big ? "binary_big_endian" : "binary_little_endian",
                   "element tristrips 2\nproperty uchar flag\nproperty list uchar short "
                   "vertex_indices\nelement vertex 4\n" +
                       xyz);
        for (const std::vector<std::int16_t>& list :
             {std::vector<std::int16_t>{0, 1, 2, 3}, {3, 2, 0, -1}}) {
            bytes += '\7' + std::string(1, static_cast<char>(list.size()));
            for (const std::int16_t v : list) bytes += bytes_of(v, is_big);
        }
        for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f}) {
            bytes += bytes_of(x, is_big);
        }
        EXPECT_EQ(read_bytes("a.ply", bytes).mesh.triangles,
                  (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {3, 2, 0}}));
    }
}

TEST(Ply, StripsOfOneOrTwoVerticesAreCountedAsDroppedFaces) {
    const auto file = read_bytes("a.ply", header("ascii", "element vertex 6\n" + xyz + strips) +
                                              six + "8 0 -1 1 2 -1 3 4 5\n");
    EXPECT_EQ(file.dropped_polygons, 2u);
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{3, 4, 5}}));
}

TEST(Ply, StripsMayStandBesideFacesWhoseValuesAreThenDeclined) {
    const std::string bytes = header("ascii", "element vertex 6\n" + xyz + "element face 1\n" +
                                                  faces + "property int label\n" + strips) +
                              six + "4 0 1 3 2 7\n3 3 4 5\n";
    const auto file = remesh::read_ply({.path = "a.ply", .bytes = bytes, .with_attributes = true});
    EXPECT_EQ(file.mesh.triangles.size(), 3u);
    EXPECT_EQ(file.mesh.triangles.back(), (Triangle{3, 4, 5}));
    EXPECT_TRUE(file.attributes.of_faces.empty());
    ASSERT_EQ(file.attributes.declined.size(), 1u);
    EXPECT_EQ(file.attributes.declined[0].name, "face label");
}

TEST(Ply, WrongStripsAreRefused) {
    const std::string head = header("ascii", "element vertex 6\n" + xyz + strips) + six;
    expect_error<InvalidInput>("a.ply", head + "3 0 1 6\n", {"line 16", "vertex 6"});
    expect_error<InvalidInput>("a.ply", head + "3 0 1 -2\n", {"line 16", "negative"});
    expect_error<InvalidInput>("a.ply", head + "3 -1 -1 -1\n", {"no face"});
    expect_error<IoError>("a.ply", head + "4 0 1 2\n", {"line 16"});
    expect_error<IoError>("a.ply", head + "-1\n", {"line 16", "negative length"});
    expect_error<IoError>("a.ply", header("binary_little_endian", strips) + "\xff\xff\xff\x7f",
                          {"tristrips 0 of 1", "truncated"});
}

TEST(Ply, WrongHeadersAreRefused) {
    expect_error<IoError>("a.ply", "solid\n", {"line 1", "not a PLY"});
    expect_error<IoError>("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", {"end_header"});
    expect_error<IoError>("a.ply", "ply\nend_header\n", {"no 'format'"});
    expect_error<IoError>("a.ply", header("binary", ""), {"line 2", "'binary'"});
    expect_error<IoError>("a.ply", header("ascii", "element vertex\n"),
                          {"line 3", "end of the line"});
    expect_error<IoError>("a.ply", header("ascii", "element vertex -1\n"), {"line 3", "negative"});
    expect_error<IoError>("a.ply", header("ascii", "property int x\n"), {"line 3", "unexpected"});
    expect_error<IoError>("a.ply", header("ascii", "element vertex 1\nproperty half x\n"),
                          {"line 4", "'half'"});
    expect_error<IoError>("a.ply", header("ascii", "element face 1\nproperty list float int v\n"),
                          {"line 4", "integer"});
    expect_error<IoError>("a.ply", header("ascii", "element vertex 1\nproperty float x\n") + "1\n",
                          {"x, y and z"});
    expect_error<IoError>("a.ply", header("ascii", "element face 1\nproperty int a\n") + "1\n",
                          {"vertex_indices"});
    expect_error<IoError>("a.ply", header("ascii", "element tristrips 1\nproperty int a\n") + "1\n",
                          {"element tristrips", "vertex_indices"});
}

TEST(Ply, TruncatedFilesAreRefused) {
    const std::string ascii = triangle_header("ascii") + three + "3 0 1 2";
    std::string binary = triangle_header("binary_little_endian");
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f})
        binary += bytes_of(x, false);
    binary += '\3' + bytes_of(0, false) + bytes_of(1, false) + bytes_of(2, false);
    expect_one_ply_triangle(binary);
    for (std::size_t size = 1; size < ascii.size(); ++size) {
        expect_error<IoError>("a.ply", ascii.substr(0, size), {"line"});
    }
    for (std::size_t size = binary.size() - 49; size < binary.size(); ++size) {
        expect_error<IoError>("a.ply", binary.substr(0, size), {"byte", "truncated"});
    }
    expect_error<IoError>("a.ply", binary.substr(0, binary.size() - 20),
                          {"byte " + std::to_string(binary.size() - 20), "vertex 2 of 3"});
}

TEST(Ply, WrongValuesAreRefused) {
    const std::string head = triangle_header("ascii");
    expect_error<InvalidInput>("a.ply", head + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n",
                               {"line 11", "vertex 1", "not finite"});
    expect_error<InvalidInput>("a.ply", head + three + "3 0 1 3\n", {"line 13", "vertex 3"});
    expect_error<InvalidInput>("a.ply", head + three + "3 0 1 -1\n", {"line 13", "negative"});
    expect_error<IoError>("a.ply", head + three + "-3 0 1 2\n", {"line 13", "negative length"});
    expect_error<IoError>("a.ply", head + "0 0 0 9\n1 0 0 9\n0 1 0 9\n3 0 1 2\n",
                          {"line 10", "more values"});
    std::string binary = triangle_header("binary_big_endian");
    for (const float x : {0.f, 0.f, 0.f, 1.f, INFINITY, 0.f}) binary += bytes_of(x, true);
    expect_error<InvalidInput>("a.ply", binary + std::string(99, '\0'),
                               {"byte", "vertex 1", "not finite"});
}

TEST(Ply, CountsAndLengthsAreNotBelieved) {
    const std::string huge = "9223372036854775807";
    expect_error<IoError>("a.ply", header("ascii", "element vertex " + huge + "\n" + xyz) + three,
                          {"vertex 3 of " + huge});
    expect_error<IoError>(
        "a.ply", header("binary_little_endian", "element vertex " + huge + "\n" + xyz) + three,
        {"vertex 1 of " + huge});
    expect_error<IoError>("a.ply",
                          header("binary_little_endian", "element vertex 0\n" + xyz +
                                                             "element face 1\nproperty list "
                                                             "uint int vertex_indices\n") +
                              "\xff\xff\xff\xff",
                          {"face 0"});
    expect_error<IoError>(
        "a.ply",
        header("binary_little_endian", "element x " + huge + "\nproperty list uint double y\n") +
            "\xff\xff\xff\xff",
        {"x 0 of"});
}

TEST(Ply, PointCloudsAreRefused) {
    expect_error<InvalidInput>("a.ply", header("ascii", "element vertex 3\n" + xyz) + three,
                               {"3 vertices but no face"});
    expect_error<InvalidInput>("a.ply", header("ascii", ""), {"nor a face"});
}

// Of all types, with values of faces, which some programs do not read in a binary file.
TEST(WritePly, AsTextReadsBackTheSame) {
    const agvd::TriangleMesh mesh{{{0.1, 0, 0}, {1, 0, 1e-300}, {4.2e6, 1, 0}}, {{0, 1, 2}}};
    const remesh::MeshAttributes values{
        .of_vertices = {{.name = "distance", .values = {0, 1.0 / 3, agvd::infinity}},
                        {.name = "quality",
                         .type = remesh::NumberType::Float32,
                         .values = {.5, 1, 2}}},
        .of_faces = {{.name = "site", .type = remesh::NumberType::Int32, .values = {-1}}}};
    const std::string text = remesh::ply_as_text(remesh::format_mesh("a.ply", mesh.view(), values));
    EXPECT_EQ(text.find("ply\nformat ascii 1.0\nelement vertex 3\n"), 0u) << text;
    EXPECT_NE(text.find("end_header\n0.1 0 0 0 0.5\n"), std::string::npos) << text;
    EXPECT_NE(text.find("\n3 0 1 2 -1\n"), std::string::npos) << text;
    const remesh::MeshFile back = remesh::read_mesh_bytes(text, "a.ply", {.with_attributes = true});
    EXPECT_EQ(back.mesh.positions, mesh.positions);
    EXPECT_EQ(back.mesh.triangles, mesh.triangles);
    EXPECT_EQ(back.attributes.of_vertices[0].values, values.of_vertices[0].values);
    EXPECT_EQ(back.attributes.of_faces[0].values, values.of_faces[0].values);
    EXPECT_EQ(remesh::ply_as_text(text), text);
}
