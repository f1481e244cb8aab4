#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "agvd/core/progress.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/xml_reader.h"
#include "support/read_text.h"
#include "support/shapes.h"
#include "support/vtp_text.h"

using agvd::InvalidInput;
using agvd::IoError;
using agvd::Triangle;
using agvd::Vec3;

namespace {

class Vtp : public testing::Test {
protected:
    void SetUp() override {
        if (!remesh::knows_xml()) GTEST_SKIP() << "built without expat";
    }
};

remesh::MeshFile with_xml_arrays(const std::string& bytes) {
    return texts::read_bytes("a.vtp", bytes, true);
}

template <typename E>
void expect_error(const std::string& bytes, const std::vector<std::string>& words) {
    texts::expect_error<E>("a.vtp", bytes, words, true);
}

std::vector<VtpStyle> all_styles() {
    std::vector<VtpStyle> styles;
    for (const auto encoding :
         {VtpStyle::Ascii, VtpStyle::Binary, VtpStyle::Base64, VtpStyle::Raw}) {
        for (const auto order : {std::endian::little, std::endian::big}) {
            for (const bool is_wide : {false, true}) {
                for (const bool is_packed : {false, true}) {
                    if (is_packed && !remesh::knows_gzip()) continue;
                    styles.push_back({encoding, order, is_wide, is_packed});
                }
            }
        }
    }
    return styles;
}

// A triangle and a quad, a strip of two triangles, a line; arrays of points and cells.
std::string five_xml_points(const VtpStyle& style) {
    VtpText text(style);
    text.add(
        "<PolyData><Piece NumberOfPoints='5' NumberOfVerts='0' NumberOfLines='1' "
        "NumberOfStrips='1' NumberOfPolys='2'>\n<PointData Normals='n' TCoords='uv'>");
    text.array<double>("type='Float64' Name='heat'", {0.1, -0.5, 1e300, 0, 3});
    text.array<std::uint8_t>("type='UInt8' Name='paint' NumberOfComponents='3'",
                             {255, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13});
    text.array<float>("type='Float32' Name='n' NumberOfComponents='3'", std::vector<float>(15, 1));
    text.array<float>("type='Float32' Name='uv' NumberOfComponents='2'", std::vector<float>(10));
    text.add("</PointData><CellData>");
    text.array<std::int64_t>("type='Int64' Name='part id'", {7, 9, 8, -3});
    text.add("</CellData><Points>");
    text.array<double>("type='Float64' NumberOfComponents='3'",
                       {0, 0, 0, 1, 0, 0, 0, 1, 0.1, 1, 1, 0, 0, 2, 0});
    text.add("</Points><Strips>");
    text.array<std::int32_t>("type='Int32' Name='connectivity'", {1, 3, 2, 4});
    text.array<std::int32_t>("type='Int32' Name='offsets'", {4});
    text.add("</Strips><Polys>");
    text.array<std::int64_t>("type='Int64' Name='connectivity'", {0, 1, 2, 0, 1, 3, 2});
    text.array<std::int64_t>("type='Int64' Name='offsets'", {3, 7});
    text.add("</Polys><Lines>");
    text.array<std::int64_t>("type='Int64' Name='connectivity'", {0, 4});
    text.array<std::int64_t>("type='Int64' Name='offsets'", {2});
    text.add("</Lines></Piece></PolyData>");
    return text.finish();
}

const std::string ascii = five_xml_points({});

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

void expect_io_error(const std::string& from, const std::string& to,
                     const std::vector<std::string>& words) {
    expect_error<IoError>(replaced(ascii, from, to), words);
}

}  // namespace

TEST_F(Vtp, EveryEncodingIsRead) {
    for (const VtpStyle& style : all_styles()) {
        SCOPED_TRACE(style.name());
        const auto file = with_xml_arrays(five_xml_points(style));
        EXPECT_EQ(file.mesh.positions,
                  (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1}, {1, 1, 0}, {0, 2, 0}}));
        ASSERT_EQ(file.mesh.triangles.size(), 5u);
        EXPECT_EQ(file.mesh.triangles[0], (Triangle{0, 1, 2}));
        EXPECT_EQ(file.mesh.triangles[3], (Triangle{1, 3, 2}));
        EXPECT_EQ(file.mesh.triangles[4], (Triangle{2, 3, 4}));
        const auto& vertices = file.attributes.of_vertices;
        ASSERT_EQ(vertices.size(), 4u);
        EXPECT_EQ(vertices[0].name, "heat");
        EXPECT_EQ(vertices[0].values, (std::vector<double>{0.1, -0.5, 1e300, 0, 3}));
        EXPECT_EQ(vertices[1].name, "red");
        EXPECT_EQ(vertices[3].values, (std::vector<double>{1, 4, 7, 10, 13}));
        ASSERT_EQ(file.attributes.of_faces.size(), 1u);
        EXPECT_EQ(file.attributes.of_faces[0].name, "part_id");  // Lines come before polygons.
        EXPECT_EQ(file.attributes.of_faces[0].values, (std::vector<double>{9, 8, 8, -3, -3}));
        EXPECT_EQ(file.attributes.normals, remesh::NumberType::Float32);
        ASSERT_EQ(file.warnings.size(), 1u);
        EXPECT_NE(file.warnings[0].find("1 cells that are neither faces"), std::string::npos);
    }
}

TEST_F(Vtp, FilesThatEndEarlyAreRefused) {
    for (const VtpStyle& style : all_styles()) {
        if (style.is_wide) continue;
        SCOPED_TRACE(style.name());
        const std::string whole = five_xml_points(style);
        const std::size_t last =
            style.is_appended() ? whole.find("</AppendedData") - 4 : whole.size() - 11;
        for (std::size_t size = 1; size < last; ++size) {
            EXPECT_THROW(static_cast<void>(with_xml_arrays(whole.substr(0, size))), agvd::Error)
                << size;
        }
    }
}

TEST_F(Vtp, PiecesBecomeOneMesh) {
    VtpText text({});
    text.add("<PolyData>");
    for (int piece = 0; piece < 3; ++piece) {
        if (piece == 1) {
            text.add("<Piece NumberOfPoints='0' NumberOfPolys='0'></Piece>");
            continue;
        }
        const double x = piece;
        text.add("<Piece NumberOfPoints='3' NumberOfPolys='1'><PointData>");
        text.array<double>("type='Float64' Name='heat'", {x, x + 1, x + 2});
        if (piece == 0) text.array<double>("type='Float64' Name='first'", {1, 2, 3});
        text.add("</PointData><CellData>");
        text.array<std::int32_t>("type='Int32' Name='part'", {piece});
        text.add("</CellData><Points>");
        text.array<double>("type='Float64' NumberOfComponents='3'",
                           {x, 0, 0, x + 1, 0, 0, x, 1, 0});
        text.add("</Points><Polys>");
        text.array<std::int32_t>("type='Int32' Name='connectivity'", {0, 2, 1});
        text.array<std::int32_t>("type='Int32' Name='offsets'", {3});
        text.add("</Polys></Piece>");
    }
    text.add("</PolyData>");
    const auto file = with_xml_arrays(text.finish());
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 2, 1}, {3, 5, 4}}));
    EXPECT_EQ(file.mesh.positions[4], Vec3(3, 0, 0));
    ASSERT_EQ(file.attributes.of_vertices.size(), 1u);
    EXPECT_EQ(file.attributes.of_vertices[0].values, (std::vector<double>{0, 1, 2, 2, 3, 4}));
    EXPECT_EQ(file.attributes.of_faces[0].values, (std::vector<double>{0, 2}));
    ASSERT_EQ(file.attributes.declined.size(), 1u);
    EXPECT_EQ(file.attributes.declined[0].name, "vertex first");
    // A corner must not reach into the piece before or after its own.
    expect_error<InvalidInput>(replaced(text.finish(), "0 2 1 \n<Info", "0 2 3 \n<Info"),
                               {"point 3", "only 3 points"});
}

TEST_F(Vtp, FacesOfAGridAreRead) {
    VtpText text({}, "UnstructuredGrid");
    text.add("<UnstructuredGrid><Piece NumberOfPoints='4' NumberOfCells='3'><Points>");
    text.array<float>("type='Float32' NumberOfComponents='3'",
                      {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    text.add("</Points><Cells>");
    text.array<std::int32_t>("type='Int32' Name='connectivity'", {0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 3});
    text.array<std::int32_t>("type='Int32' Name='offsets'", {3, 7, 11});
    text.array<std::uint8_t>("type='UInt8' Name='types'", {5, 10, 8});
    text.add("</Cells></Piece></UnstructuredGrid>");
    const std::string good = text.finish();
    const auto file = with_xml_arrays(good);
    ASSERT_EQ(file.mesh.triangles.size(), 3u);
    EXPECT_EQ(file.mesh.triangles[0], (Triangle{0, 1, 2}));
    EXPECT_EQ(file.warnings.size(), 1u);  // The tetrahedron.
    expect_error<IoError>(replaced(good, "5 10 8", "5 10"), {"types", "2 numbers for 3"});
    expect_error<IoError>(replaced(good, "'types'", "'kinds'"), {"Cells", "not the arrays"});
}

TEST_F(Vtp, WhatWasWrittenComesBack) {
    const agvd::TriangleMesh mesh = shapes::jitter(shapes::icosahedron(), 0.01, 3);
    remesh::MeshAttributes attributes{.normals = remesh::NumberType::Float32};
    const auto values = [](std::size_t count, double step) {
        std::vector<double> result(count);
        for (std::size_t i = 0; i < count; ++i) result[i] = static_cast<double>(i) * step;
        return result;
    };
    for (const char* name : {"red", "green", "blue", "alpha"}) {
        attributes.of_vertices.push_back(
            {.name = name, .type = remesh::NumberType::UInt8, .values = values(12, 3)});
    }
    attributes.of_vertices.push_back({.name = "a<b&\"c\">'", .values = values(12, 0.1)});
    for (const auto type : {remesh::NumberType::Int8, remesh::NumberType::UInt16,
                            remesh::NumberType::Int32, remesh::NumberType::UInt32}) {
        attributes.of_faces.push_back(
            {.name = "H\xC3\xB6he" + std::to_string(static_cast<int>(type)),
             .type = type,
             .values = values(20, 2)});
    }
    const std::string bytes = remesh::format_mesh("a.vtp", mesh.view(), attributes);
    const auto file = with_xml_arrays(bytes);
    EXPECT_EQ(file.mesh.positions, mesh.positions);
    EXPECT_EQ(file.mesh.triangles, mesh.triangles);
    EXPECT_EQ(file.attributes.normals, remesh::NumberType::Float32);
    EXPECT_TRUE(file.attributes.declined.empty());
    const auto expect_same = [](const auto& found, const auto& expected) {
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].name, expected[i].name);
            EXPECT_EQ(found[i].type, expected[i].type);
            EXPECT_EQ(found[i].values, expected[i].values);
        }
    };
    expect_same(file.attributes.of_vertices, attributes.of_vertices);
    expect_same(file.attributes.of_faces, attributes.of_faces);
    EXPECT_EQ(remesh::format_mesh("a.vtp", file.mesh.view(), file.attributes), bytes);
    const auto grid =
        texts::read_bytes("a.vtu", remesh::format_mesh("a.vtu", mesh.view(), attributes), true);
    EXPECT_EQ(grid.mesh.positions, mesh.positions);
    EXPECT_EQ(grid.mesh.triangles, mesh.triangles);
    EXPECT_TRUE(grid.warnings.empty());
    expect_same(grid.attributes.of_vertices, attributes.of_vertices);
    expect_same(grid.attributes.of_faces, attributes.of_faces);
}

TEST_F(Vtp, NamesThatXmlCannotHoldAreChanged) {
    const agvd::TriangleMesh mesh = shapes::tetrahedron();
    remesh::MeshAttributes attributes;
    for (const char* name : {"a\x01"
                             "b",
                             "c\xFF", "d\xC3", "e\xED\xA0\x80", "f\xEF\xBF\xBF", "g\xC0\x80"}) {
        attributes.of_vertices.push_back({.name = name, .values = {1, 2, 3, 4}});
    }
    const auto file = with_xml_arrays(remesh::format_mesh("a.vtp", mesh.view(), attributes));
    EXPECT_EQ(remesh::names_of(file.attributes.of_vertices), "a_b, c_, d_, e___, f___, g__");
}

TEST_F(Vtp, WrongFilesAreRefused) {
    expect_error<IoError>("# vtk DataFile Version 3.0\n", {"line 1", "XML", "extension"});
    expect_error<IoError>("<svg></svg>", {"'svg'", "VTKFile"});
    expect_error<IoError>("<VTKFile type='ImageData'></VTKFile>", {"'ImageData'", "surface"});
    expect_error<IoError>("<VTKFile type='PPolyData'></VTKFile>", {"'PPolyData'", "one file"});
    expect_error<InvalidInput>("<VTKFile type='PolyData'/>", {"neither a vertex nor a face"});
    expect_io_error("LittleEndian", "Middle", {"byte_order", "'Middle'"});
    expect_io_error("UInt32", "UInt16", {"header_type", "'UInt16'"});
    expect_io_error("</Points>", "</Dots>", {"XML", "mismatched"});
    expect_io_error("<VTKFile", "<!DOCTYPE VTKFile [<!ENTITY a 'b'>]><VTKFile",
                    {"document type", "DOCTYPE"});
    expect_io_error("format='ascii'", "format='hex'", {"'heat' of PointData", "'hex'"});
    expect_io_error("<PolyData>", "<PolyData><!--" + std::string(5'000'000, '-') + "-->", {"XML"});
    expect_io_error("<PolyData>", "<PolyData a='" + std::string(5'000'000, 'x') + "'>",
                    {"a tag is longer"});
}

TEST_F(Vtp, WrongArraysAreRefused) {
    const std::string points = "'Float64' NumberOfComponents='3'";
    expect_io_error(points, "'Float80' NumberOfComponents='3'", {"of Points", "'Float80'"});
    expect_io_error(points, "'Float64' NumberOfComponents='-3'", {"NumberOfComponents", "'-3'"});
    expect_io_error(points, "'Float64' NumberOfComponents='5'", {"three coordinates"});
    expect_io_error("NumberOfPoints='5'", "NumberOfPoints='6'", {"of Points", "15 numbers for 6"});
    expect_io_error("NumberOfPoints='5'", "NumberOfPoints='x'", {"NumberOfPoints", "'x'"});
    expect_io_error("NumberOfPoints='5'", "NumberOfPoints='6148914691236517210'", {"15 numbers"});
    expect_io_error("NumberOfPolys='2'", "NumberOfPolys='99999999999'",
                    {"'offsets' of Polys", "2 numbers"});
    expect_io_error("NumberOfPolys='2'", "NumberOfPolys='99999999999999999999'", {"whole number"});
    expect_io_error("7 9 8 -3", "7 9 8", {"'part id' of CellData", "3 numbers for 4"});
    expect_io_error("7 9 8 -3", "7 9 x -3", {"expected a number", "'x'"});
    expect_io_error("3 7 \n<", "3 8 \n<", {"offset of cell 1"});
    expect_io_error("3 7 \n<", "5 3 \n<", {"offset of cell 1"});
    expect_io_error("3 7 \n<", "-1 7 \n<", {"offset of cell 0"});
    expect_io_error("3 7 \n<", "nan 7 \n<", {"offset of cell 0"});
    expect_io_error("3 7 \n<", "3 6 \n<", {"last offset"});
    expect_error<InvalidInput>(replaced(ascii, "0 1 3 2 \n<", "0 1 3 5 \n<"),
                               {"'connectivity' of Polys", "point 5", "only 5 points"});
    for (const char* wrong : {"0 1 3 -1 \n<", "0 1 3 nan \n<", "0 1 3 1e30 \n<"}) {
        expect_error<InvalidInput>(replaced(ascii, "0 1 3 2 \n<", wrong), {"of Polys"});
    }
    expect_io_error("0 1 3 2 \n<", "0 1 3 1.5 \n<", {"whole number"});
    expect_error<InvalidInput>(replaced(ascii, "0 1 0.1", "0 nan 0.1"), {"point 2", "finite"});
    const std::size_t begin = ascii.find("<Points>"), end = ascii.find("</Points>");
    expect_error<IoError>(ascii.substr(0, begin + 8) + ascii.substr(end), {"no array of Points"});
}

TEST_F(Vtp, WrongDataAreRefused) {
    const std::string base64 = five_xml_points({.encoding = VtpStyle::Base64});
    expect_error<IoError>(replaced(base64, "offset='0'", "offset='999999'"), {"'heat'", "behind"});
    expect_error<IoError>(replaced(base64, "offset='0'", "offset=''"), {"no offset"});
    expect_error<IoError>(replaced(base64, "offset='0'", "offset='18446744073709551615'"),
                          {"behind"});
    expect_error<IoError>(replaced(base64, ">\n_", ">\n"), {"'_'"});
    expect_error<IoError>(replaced(base64, "'base64'", "'hex'"), {"'hex'"});
    // 40 bytes of heat are announced by the digits "KAAAA".
    expect_error<IoError>(replaced(base64, "_KAAAA", "_KAA*A"), {"'heat'", "not base64"});
    expect_error<IoError>(replaced(base64, "_KAAAA", "_=AAAA"), {"'heat'", "not base64"});
    expect_error<IoError>(replaced(base64, "_KAAAA", "_JwAAA"), {"'heat'", "39 bytes"});
    expect_error<IoError>(replaced(base64, "_KAAAA", "_IAAAA"), {"'heat'", "4 numbers for 5"});
    expect_error<IoError>(replaced(base64, "_KAAAA", "_/////"), {"'heat'", "ends within it"});
    const std::string binary = five_xml_points({.encoding = VtpStyle::Binary});
    expect_error<IoError>(replaced(binary, "KAAAA", "IAAAA"), {"'heat'", "more data"});
}

TEST_F(Vtp, WrongBlocksAreRefused) {
    if (!remesh::knows_gzip()) GTEST_SKIP() << "built without zlib";
    const VtpStyle style{.encoding = VtpStyle::Raw, .is_packed = true};
    const std::string good = five_xml_points(style);
    const std::size_t data = good.find("\n_") + 2;
    // Of `heat`: the number of blocks, their size, that of the last one, that of the first one
    // packed.
    const auto with_word = [&](std::size_t word, std::uint32_t value) {
        std::string bytes = good;
        std::memcpy(&bytes[data + 4 * word], &value, 4);
        return bytes;
    };
    EXPECT_EQ(with_word(0, 3), good);
    EXPECT_EQ(with_word(1, VtpStyle::block_size), good);
    EXPECT_EQ(with_word(2, 8), good);
    for (const auto& [word, value] :
         {std::pair{1u, 15u}, {1u, 17u}, {2u, 7u}, {2u, 9u}, {2u, 0u}, {1u, 0xFFFFFFFFu}}) {
        expect_error<IoError>(with_word(word, value), {"'heat'", "block", "damaged"});
    }
    for (const auto& [word, value] : {std::pair{0u, 0xFFFFFFFFu}, {3u, 0xFFFFFFFFu}}) {
        expect_error<IoError>(with_word(word, value), {"'heat'", "ends within it"});
    }
    EXPECT_THROW(static_cast<void>(with_xml_arrays(with_word(0, 2))), IoError);
    EXPECT_THROW(static_cast<void>(with_xml_arrays(with_word(3, 5))), IoError);
    expect_error<IoError>(replaced(good, "vtkZLibDataCompressor", "vtkLZ4DataCompressor"),
                          {"'vtkLZ4DataCompressor'", "zlib"});
}

// A callback, as of a memory limit, ends the reading of arrays and of XML alike.
TEST_F(Vtp, TheCallbackStopsReading) {
    const std::string many = replaced(
        ascii, "<PolyData>", "<PolyData>" + [] {
            std::string text;
            while (text.size() < 2'000'000) text += "<a/>\n";
            return text;
        }());
    for (const std::string& bytes :
         {many, remesh::format_mesh("a.vtp", shapes::grid(100).view())}) {
        int num_polls = 0;
        const agvd::Progress stop = [&](double) { return ++num_polls < 3; };
        agvd::Poller poller(stop);
        EXPECT_THROW(static_cast<void>(remesh::read_vtp(
                         {.path = "a.vtp", .bytes = bytes, .ticker = agvd::Ticker(poller)})),
                     agvd::Cancelled);
    }
}
