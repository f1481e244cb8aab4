#include <gtest/gtest.h>

#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/xml_reader.h"
#include "support/read_text.h"
#include "support/shapes.h"

using agvd::InvalidInput;
using agvd::IoError;
using agvd::Triangle;
using agvd::Vec3;
using texts::expect_error;
using texts::read_bytes;

namespace {

class Read3mf : public testing::Test {
protected:
    void SetUp() override {
        if (!remesh::knows_gzip() || !remesh::knows_xml()) GTEST_SKIP() << "without zlib or expat";
    }
};

using Parts = std::vector<std::pair<std::string, std::string>>;

std::string package(const Parts& parts) {
    agvd::Ticker ticker;
    return remesh::pack_zip(parts, ticker);
}

const std::string relations =
    "<Relationships xmlns='http://schemas.openxmlformats.org/package/2006/relationships'>"
    "<Relationship Target='/Metadata/thumbnail.png' Id='a' Type='http://schemas.openxmlformats.org/"
    "package/2006/relationships/metadata/thumbnail'/>"
    "<Relationship Target='/3D/Main.model' Id='b' "
    "Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'/></Relationships>";

std::string model(const std::string& content, const std::string& attributes = "") {
    return "<?xml version='1.0' encoding='UTF-8'?>\n<model unit='inch' "
           "xmlns='http://schemas.microsoft.com/3dmanufacturing/core/2015/02' "
           "xmlns:m='http://schemas.microsoft.com/3dmanufacturing/material/2015/02' "
           "xmlns:p='http://schemas.microsoft.com/3dmanufacturing/production/2015/06' "
           "xmlns:b='http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02'" +
           attributes + ">\n" + content + "</model>\n";
}

std::string file_of(const std::string& content, const std::string& attributes = "") {
    return package({{"_rels/.rels", relations}, {"3D/Main.model", model(content, attributes)}});
}

const std::string unit_square =
    "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/>"
    "<vertex x='1' y='1' z='0'/><vertex x=' 1e-1 ' y='+1' z='-.5'/></vertices>"
    "<triangles><triangle v1='0' v2='1' v3='2'/><triangle v1='0' v2='2' "
    "v3='3'/></triangles></mesh>";

std::string object(int id, const std::string& content, const std::string& attributes = "") {
    return "<object id='" + std::to_string(id) + "' " + attributes + ">" + content + "</object>\n";
}

std::string build(const std::string& items) { return "<build>" + items + "</build>"; }

std::string one_square(const std::string& item) {
    return file_of("<resources>" + object(1, unit_square) + "</resources>" + build(item));
}

remesh::MeshFile with_attributes(const std::string& bytes) {
    return read_bytes("a.3mf", bytes, true);
}

}  // namespace

TEST_F(Read3mf, AMeshIsReadAsItStands) {
    const auto file = read_bytes("a.3mf", one_square("<item objectid='1'/>"));
    EXPECT_EQ(file.mesh.positions,
              (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.1, 1, -0.5}}));
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_TRUE(file.warnings.empty());
}

TEST_F(Read3mf, ItemsAreMovedAndReflectionsTurnTheirFaces) {
    const auto file = read_bytes(
        "a.3mf", one_square("<item objectid='1' transform='0 1 0 -1 0 0 0 0 1 10 20 30'/>"
                            "<item objectid='1' transform=' 2 0 0  0 -1 0\n0 0 1 0 0 0 '/>"));
    ASSERT_EQ(file.mesh.positions.size(), 8u);
    // A row vector times the matrix: x goes to y, y to -x.
    EXPECT_EQ(file.mesh.positions[1], Vec3(10, 21, 30));
    EXPECT_EQ(file.mesh.positions[2], Vec3(9, 21, 30));
    EXPECT_EQ(file.mesh.triangles[0], (Triangle{0, 1, 2}));
    EXPECT_EQ(file.mesh.positions[6], Vec3(2, -1, 0));
    EXPECT_EQ(file.mesh.triangles[2], (Triangle{4, 6, 5}));
}

TEST_F(Read3mf, ComponentsArePlacedInTheirObjects) {
    const std::string moved = "transform='1 0 0 0 1 0 0 0 1 ";
    const std::string parts = "<components><component objectid='1' " + moved +
                              "1 0 0'/><component objectid='1'/></components>";
    const auto file = with_attributes(
        file_of("<resources>" + object(1, unit_square, "name='Plate'") + object(2, parts) +
                object(3,
                       "<components><component objectid='2' transform='2 0 0 0 2 0 0 0 2 0 0 0'/>"
                       "</components>") +
                object(4, unit_square) + "</resources>" +
                build("<item objectid='3' " + moved + "0 0 5'/><item objectid='4'/>")));
    ASSERT_EQ(file.mesh.positions.size(), 12u);
    EXPECT_EQ(file.mesh.positions[2], Vec3(4, 2, 5));  // Moved by 1, then doubled, then moved.
    EXPECT_EQ(file.mesh.positions[6], Vec3(2, 2, 5));
    EXPECT_EQ(file.mesh.positions[10], Vec3(1, 1, 0));
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].name, "object");
    EXPECT_EQ(file.attributes.of_faces[0].names,
              (std::vector<std::string>{"Plate", "Plate_2", "object_4"}));
    EXPECT_EQ(file.attributes.of_faces[0].values, (std::vector<double>{0, 0, 1, 1, 2, 2}));
}

TEST_F(Read3mf, MaterialsBecomeLabels) {
    const std::string triangles =
        "<triangles><triangle v1='0' v2='1' v3='2'/><triangle v1='1' v2='2' v3='3' p1='0'/>"
        "<triangle v1='2' v2='3' v3='0' pid='6' p1='1' p2='1' p3='0'/>"
        "<triangle v1='3' v2='0' v3='1' pid='7' p1='0'/></triangles></mesh>";
    const std::string mesh = unit_square.substr(0, unit_square.find("<triangles>")) + triangles;
    const auto file = with_attributes(file_of(
        "<resources><basematerials id='5'><base name='PLA' displaycolor='#00FF00'/>"
        "<base name='steel\\' displaycolor='#111111'/></basematerials>"
        "<m:colorgroup id='6'><m:color color='#FF0000'/><m:color color='#0000FFFF'/></m:colorgroup>"
        "<m:texture2dgroup id='7' texid='8'><m:tex2coord u='0' v='0'/></m:texture2dgroup>" +
        object(1, mesh, "pid='5' pindex='1'") + "</resources>" + build("<item objectid='1'/>")));
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].name, "material");
    EXPECT_EQ(file.attributes.of_faces[0].names,
              (std::vector<std::string>{"steel", "PLA", "#0000FFFF", ""}));
    EXPECT_EQ(file.attributes.of_faces[0].values, (std::vector<double>{0, 1, 2, 3}));
    ASSERT_EQ(file.attributes.declined.size(), 2u);
    EXPECT_EQ(file.attributes.declined[0].name, "properties of triangles");
    EXPECT_EQ(file.attributes.declined[1].name, "colours of corners");
}

TEST_F(Read3mf, ASingleMaterialIsALabelTooButNoSingleObject) {
    const auto file = with_attributes(
        file_of("<resources><basematerials id='5'><base name='PLA' displaycolor='#00FF00'/>"
                "</basematerials>" +
                object(1, unit_square, "pid='5' pindex='0'") + "</resources>" +
                build("<item objectid='1'/>")));
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].names, (std::vector<std::string>{"PLA"}));
    EXPECT_TRUE(with_attributes(one_square("<item objectid='1'/>")).attributes.empty());
}

TEST_F(Read3mf, SupportsAndLatticesArePassedOver) {
    const std::string lattice =
        "<b:beamlattice radius='1'><b:beams><b:beam v1='0' v2='1'/></b:beams>"
        "</b:beamlattice></mesh>";
    const std::string beams = unit_square.substr(0, unit_square.find("</mesh>")) + lattice;
    const auto file = read_bytes(
        "a.3mf", file_of("<resources>" + object(1, unit_square, "type='support'") +
                         object(2, beams, "type='surface'") +
                         object(3, unit_square, "type='other'") + "</resources>" +
                         build("<item objectid='1'/><item objectid='2'/><item objectid='3'/>")));
    EXPECT_EQ(file.mesh.triangles.size(), 2u);
    ASSERT_EQ(file.warnings.size(), 2u);
    EXPECT_NE(file.warnings[0].find("2 objects"), std::string::npos);
    EXPECT_NE(file.warnings[1].find("lattice"), std::string::npos);
}

TEST_F(Read3mf, ObjectsOfOtherPartsAreRead) {
    const std::string root =
        model("<resources>" +
                  object(8,
                         "<components><component p:path='/3D/Objects/a.model' objectid='1'/>"
                         "<component p:path='/3D/OBJECTS/A.model' objectid='2'/></components>") +
                  "</resources>" + build("<item objectid='8'/>"),
              " requiredextensions=' p m '");
    const std::string part = model("<resources>" + object(1, unit_square) +
                                   object(2, "<components><component objectid='1'/></components>") +
                                   "</resources><build/>");
    const auto file = read_bytes("a.3mf", package({{"_rels/.rels", relations},
                                                   {"3D/Main.model", root},
                                                   {"3D/Objects/a.model", part}}));
    EXPECT_EQ(file.mesh.triangles.size(), 4u);
    expect_error<IoError>("a.3mf", package({{"_rels/.rels", relations}, {"3D/Main.model", root}}),
                          {"no part '3D/Objects/a.model'"});
}

TEST_F(Read3mf, WhatWasWrittenComesBack) {
    agvd::TriangleMesh mesh = shapes::jitter(shapes::icosahedron(), 0.01, 3);
    mesh.positions[0] = Vec3(-0.0, 1e-300, 1.7976931348623157e308);
    const std::string bytes = remesh::format_mesh("a.3mf", mesh.view());
    const auto file = read_bytes("a.3mf", bytes);
    EXPECT_EQ(file.mesh.positions, mesh.positions);
    EXPECT_TRUE(std::signbit(file.mesh.positions[0].x()));
    EXPECT_EQ(file.mesh.triangles, mesh.triangles);
    EXPECT_EQ(remesh::format_mesh("a.3mf", mesh.view()), bytes);
    // What the core specification asks of a package.
    remesh::SourceFile source{.path = "a.3mf", .bytes = bytes};
    const remesh::ZipArchive zip(source);
    EXPECT_NE(zip.read("[Content_Types].xml").bytes.find("3dmanufacturing-3dmodel+xml"),
              std::string::npos);
    EXPECT_NE(zip.read("_rels/.rels").bytes.find("Target=\"/3D/3dmodel.model\""),
              std::string::npos);
    EXPECT_NE(zip.read("3D/3dmodel.model").bytes.find("unit=\"millimeter\""), std::string::npos);
}

TEST_F(Read3mf, WrongPackagesAreRefused) {
    expect_error<IoError>("a.3mf", "solid a", {"byte 0", "not a ZIP file", "extension"});
    expect_error<IoError>("a.3mf", package({{"word/document.xml", "<a/>"}}), {"'_rels/.rels'"});
    expect_error<IoError>("a.3mf", package({{"_rels/.rels", "<Relationships/>"}}),
                          {"not a 3MF file"});
    expect_error<IoError>("a.3mf", package({{"_rels/.rels", relations}}), {"'3D/Main.model'"});
    expect_error<IoError>("a.3mf",
                          package({{"_rels/.rels", relations}, {"3D/Main.model", "<model/>"}}),
                          {"a.3mf: 3D/Main.model: line 1", "not a model of 3MF"});
}

TEST_F(Read3mf, WrongModelsAreRefused) {
    const auto expect_refused = [](const std::string& content, std::vector<std::string> words,
                                   const std::string& attributes = "") {
        words.emplace_back("a.3mf: 3D/Main.model: line ");
        expect_error<IoError>("a.3mf", file_of(content, attributes), words);
    };
    const std::string good = "<resources>" + object(1, unit_square) + "</resources>";
    expect_refused(good, {"no item"});
    expect_refused(good + build("<item objectid='2'/>"), {"id 2"});
    expect_refused(good + build("<item/>"), {"'item' has no objectid"});
    expect_refused(good + build("<item objectid='-1'/>"), {"'-1'"});
    expect_refused(good + build("<item objectid='1'/>"), {"beamlattice/2017"},
                   " requiredextensions='b'");
    expect_refused(good + build("<item objectid='1'/>"), {"'q'"}, " requiredextensions='q'");
    for (const char* transform : {"1 0 0 0 1 0 0 0 1 0 0", "1 0 0 0 1 0 0 0 1 0 0 0 0", "", "a",
                                  "1 0 0 0 1 0 0 0 1 0 0 nan"}) {
        expect_refused(
            good + build(std::string("<item objectid='1' transform='") + transform + "'/>"),
            {"twelve finite numbers"});
    }
    expect_refused("<resources>" + object(1, unit_square) + object(1, unit_square) + "</resources>",
                   {"two objects"});
    expect_refused("<resources>" + object(1, object(2, unit_square)) + "</resources>",
                   {"inside of another"});
    expect_refused("<vertex x='1' y='2' z='3'/>", {"'vertex' is in no object"});
    const auto with_vertex = [](const std::string& vertex) {
        return "<resources>" +
               object(1, "<mesh><vertices><vertex " + vertex + "/></vertices></mesh>") +
               "</resources>";
    };
    expect_refused(with_vertex("x='1' y='2'"), {"z of a vertex is ''"});
    expect_refused(with_vertex("x='1' y='2' z='3 4'"), {"'3 4'"});
    expect_refused("<resources><basematerials id='5'><base name='a'/></basematerials>", {"XML"});
}

TEST_F(Read3mf, UnusableModelsAreRefused) {
    const auto expect_unusable = [](const std::string& from, const std::string& to,
                                    const std::vector<std::string>& words) {
        std::string content = unit_square;
        content.replace(content.find(from), from.size(), to);
        expect_error<InvalidInput>("a.3mf",
                                   file_of("<resources>" + object(1, content) + "</resources>" +
                                           build("<item objectid='1'/>")),
                                   words);
    };
    expect_unusable("x='1'", "x='nan'",
                    {"3D/Main.model: line 3", "vertex 1 of object 'object_1'", "finite"});
    expect_unusable("x='1'", "x='1e999'", {"finite"});
    expect_unusable("v3='3'", "v3='4'", {"names vertex 4", "only 4 vertices"});
    expect_unusable("v3='3'", "v3='99999999999'", {"names vertex 99999999999"});
    expect_error<InvalidInput>(
        "a.3mf", one_square("<item objectid='1' transform='1e308 0 0 0 1 0 0 0 1 1.7e308 0 0'/>"),
        {"transform", "beyond double precision"});
    expect_error<InvalidInput>(
        "a.3mf",
        file_of("<resources>" + object(1, "") + "</resources>" + build("<item objectid='1'/>")),
        {"neither a vertex nor a face"});
}

// Each of 20 objects has the one before ten times.
TEST_F(Read3mf, CirclesAndTowersOfComponentsAreRefused) {
    const auto component = [](int id) {
        return "<component objectid='" + std::to_string(id) + "'/>";
    };
    const std::string circle =
        file_of("<resources>" + object(1, "<components>" + component(2) + "</components>") +
                object(2, "<components>" + component(1) + "</components>") + "</resources>" +
                build("<item objectid='1'/>"));
    expect_error<IoError>("a.3mf", circle, {"'object_1' is a component of itself"});
    std::string tower = object(1, unit_square);
    for (int id = 2; id < 20; ++id) {
        std::string ten;
        for (int k = 0; k < 10; ++k) ten += component(id - 1);
        tower += object(id, "<components>" + ten + "</components>");
    }
    expect_error<IoError>(
        "a.3mf", file_of("<resources>" + tower + "</resources>" + build("<item objectid='19'/>")),
        {"more than 65536 objects"});
}

TEST_F(Read3mf, PropertiesOutOfRangeAreRefused) {
    const std::string bytes =
        file_of("<resources><basematerials id='5'><base name='PLA'/></basematerials>" +
                object(1, unit_square, "pid='5' pindex='1'") + "</resources>" +
                build("<item objectid='1'/>"));
    EXPECT_THROW(static_cast<void>(with_attributes(bytes)), IoError);
    EXPECT_EQ(read_bytes("a.3mf", bytes).mesh.triangles.size(), 2u);
}

TEST_F(Read3mf, TheUnitIsKept) {
    const auto file = read_bytes("a.3mf", one_square("<item objectid='1'/>"));
    EXPECT_EQ(file.attributes.unit, "inch");
    const std::string bytes = remesh::format_mesh("b.3mf", file.mesh.view(), file.attributes);
    const auto again = read_bytes("b.3mf", bytes);
    EXPECT_EQ(again.attributes.unit, "inch");
    EXPECT_EQ(again.mesh.positions, file.mesh.positions);
    std::string other = model("");
    other.replace(other.find("inch"), 4, "mile");
    expect_error<IoError>("a.3mf", package({{"_rels/.rels", relations}, {"3D/Main.model", other}}),
                          {"'mile'"});
}

TEST_F(Read3mf, FormatsSayWhatBecomesOfTheUnit) {
    const auto text = [](const char* name, const char* unit) {
        return remesh::describe_unit({name}, unit);
    };
    EXPECT_EQ(text("a.3mf", "inch"), "");
    EXPECT_NE(text("a.obj", "inch").find("is the inch, .obj files have none"), std::string::npos);
    EXPECT_EQ(text("a.obj", "millimeter"), "");
    EXPECT_EQ(text("a.obj", ""), "");
    EXPECT_EQ(text("a.stl", "millimeter"), "");
    EXPECT_NE(text("a.stl", "meter").find("count in millimeters"), std::string::npos);
    EXPECT_NE(text("a.glb", "millimeter").find("count in meters"), std::string::npos);
    EXPECT_EQ(text("a.gltf", "meter"), "");
}

TEST_F(Read3mf, ObjectsMaterialsAndColorsComeBack) {
    const std::string painted = unit_square.substr(0, unit_square.find("<triangles>")) +
                                "<triangles><triangle v1='0' v2='1' v3='2' pid='6' p1='1'/>"
                                "<triangle v1='0' v2='2' v3='3'/></triangles></mesh>";
    const auto file = with_attributes(file_of(
        "<resources><basematerials id='5'><base name='&lt;PLA&gt; &amp; more' "
        "displaycolor='#0180FF'/></basematerials><m:colorgroup id='6'><m:color color='#FF0000'/>"
        "<m:color color='#00FF0080'/></m:colorgroup>" +
        object(1, unit_square, "name='A' pid='5' pindex='0'") +
        object(2, painted, "name='A' pid='6' pindex='0'") + "</resources>" +
        build("<item objectid='1'/><item objectid='2' transform='1 0 0 0 1 0 0 0 1 5 0 0'/>")));
    const std::string bytes = remesh::format_mesh("b.3mf", file.mesh.view(), file.attributes);
    const auto again = with_attributes(bytes);
    EXPECT_EQ(again.mesh.positions, file.mesh.positions);
    EXPECT_EQ(again.mesh.triangles, file.mesh.triangles);
    ASSERT_EQ(again.attributes.of_faces.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(again.attributes.of_faces[i].names, file.attributes.of_faces[i].names);
        EXPECT_EQ(again.attributes.of_faces[i].values, file.attributes.of_faces[i].values);
    }
    EXPECT_EQ(again.attributes.of_faces[0].names,
              (std::vector<std::string>{"<PLA> & more", "#00FF0080", "#FF0000"}));
    EXPECT_EQ(again.attributes.of_faces[1].names, (std::vector<std::string>{"A", "A_2"}));
    remesh::SourceFile source{.path = "b.3mf", .bytes = bytes};
    const std::string text = remesh::ZipArchive(source).read("3D/3dmodel.model").bytes;
    for (const char* words :
         {"displaycolor=\"#0180FFFF\"", "displaycolor=\"#00FF0080\"", "displaycolor=\"#FF0000FF\"",
          "<item objectid=\"2\"/>", "<item objectid=\"3\"/>"}) {
        EXPECT_NE(text.find(words), std::string::npos) << words << text;
    }
}

TEST_F(Read3mf, GroupsAreObjectsWhereThereAreNoOthers) {
    const agvd::TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                  {{0, 1, 2}, {0, 2, 3}}};
    remesh::MeshAttributes attributes;
    attributes.of_faces.push_back({.name = "group", .values = {1, 0}, .names = {"a", "b"}});
    EXPECT_TRUE(remesh::remove_unwritable("a.3mf", attributes).empty());
    const auto file = with_attributes(remesh::format_mesh("a.3mf", mesh.view(), attributes));
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].names, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(file.mesh.positions.size(), 6u);  // An object has vertices of its own.
    EXPECT_EQ(file.mesh.positions[0], Vec3(0, 0, 0));
    EXPECT_EQ(file.mesh.positions[2], Vec3(0, 1, 0));
}
