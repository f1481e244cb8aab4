#include "remesh/meshfile/diagram_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "agvd/core/error.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/vtk_data.h"
#include "remesh/meshfile/xml_reader.h"
#include "support/scratch.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

class WriteDiagram : public Scratch {
protected:
    // On the unit square: an open edge between sites 0 and 1, a closed curve around site 2, and a
    // boundary arc of site 0.
    WriteDiagram() {
        diagram_.num_sites = 3;
        diagram_.points.assign(7, {FaceId(0), {1, 0, 0}});
        diagram_.points[1] = {FaceId(0), {0, 0.5, 0.5}};
        diagram_.point_distance = {0, 0.25, 2, 3, 4, 5, 6};
        diagram_.edge_points = {0, 2, 5, 7};
        diagram_.edges = {
            {SiteId(0), SiteId(1), 0, 1}, {SiteId(1), SiteId(2)}, {SiteId(0), SiteId(), 1, 0}};
        sites_.assign(3, {FaceId(1), {0.5, 0.25, 0.25}});
        diagram_.cell_area = {0.5, 0.25, 0.25};
        diagram_.cell_euler = {1, 0, 1};
        diagram_.vertices = {{FaceId(0), {1, 0, 0}}, {FaceId(0), {0, 0.5, 0.5}}};
        diagram_.vertex_distance = {0, 0.25};
        diagram_.vertex_offsets = {0, 2, 4};
        diagram_.vertex_ends = {{0, true}, {2, false}, {2, true}, {0, false}};
        diagram_.vertex_sites = {SiteId(0), SiteId(), SiteId(0), SiteId(1)};
        diagram_.nearest_site = {SiteId(2), SiteId(0), SiteId(1), SiteId()};
        diagram_.nearest_distance = {0.5, 1, 2, INFINITY};
    }
    [[nodiscard]] std::string written(const std::string& name) const {
        remesh::write_diagram(at(name), surface_, sites_, diagram_);
        return bytes(name);
    }

    Surface surface_ = build_surface(shapes::grid(1).view());
    std::vector<SurfacePoint> sites_;
    Diagram diagram_;
};

TEST_F(WriteDiagram, ObjLinesCloseClosedCurvesAndNameTheSites) {
    const std::string text = written("d.OBJ");
    EXPECT_NE(text.find("v 0 0 0\nv 1 0.5 0\n"), std::string::npos) << text;
    EXPECT_NE(text.find("# sites 0 1\nl 1 2\n# sites 1 2\nl 3 4 5 3\n# sites 0 -1\nl 6 7\n"),
              std::string::npos)
        << text;
}

// Points: 4 vertices of the mesh, 3 sites, 7 points of edges.
TEST_F(WriteDiagram, VtpHasTheSurfaceTheEdgesAndTheSites) {
    const std::string text = written("d.vtp");
    EXPECT_NE(text.find("NumberOfPoints=\"14\" NumberOfVerts=\"3\" NumberOfLines=\"3\""),
              std::string::npos);
    EXPECT_NE(text.find("NumberOfPolys=\"2\""), std::string::npos);
    if (!remesh::knows_xml()) GTEST_SKIP() << "built without expat";
    const remesh::VtkData data =
        remesh::read_vtk_xml({.path = "d.vtp", .bytes = text, .with_attributes = true});
    ASSERT_EQ(data.cells.size(), 3u);
    EXPECT_EQ(data.cells[0].corners.values, (std::vector<double>{4, 5, 6}));
    EXPECT_EQ(data.cells[1].corners.values, (std::vector<double>{7, 8, 9, 10, 11, 9, 12, 13}));
    EXPECT_EQ(data.cells[1].ends, (std::vector<std::size_t>{2, 6, 8}));
    const auto& faces = surface_.mesh.triangles;
    EXPECT_EQ(data.cells[2].corners.values,
              (std::vector<double>{double(faces[0][0]), double(faces[0][1]), double(faces[0][2]),
                                   double(faces[1][0]), double(faces[1][1]), double(faces[1][2])}));
    ASSERT_EQ(data.of_cells.size(), 2u);
    EXPECT_EQ(data.of_cells[0].name, "site_left");
    EXPECT_EQ(data.of_cells[0].values, (std::vector<double>{-1, -1, -1, 0, 1, 0, -1, -1}));
    EXPECT_EQ(data.of_cells[1].values, (std::vector<double>{-1, -1, -1, 1, 2, -1, -1, -1}));
    ASSERT_EQ(data.of_points.size(), 2u);
    EXPECT_EQ(data.of_points[0].name, "site");
    EXPECT_EQ(data.of_points[0].values,
              (std::vector<double>{2, 0, 1, -1, 0, 1, 2, 0, 0, 1, 1, 1, 0, 0}));
    EXPECT_EQ(data.of_points[1].name, "distance");
    EXPECT_EQ(data.of_points[1].values,
              (std::vector<double>{0.5, 1, 2, INFINITY, 0, 0, 0, 0, 0.25, 2, 3, 4, 5, 6}));
    const auto& coordinates = data.points->values;
    const Vec3 site = position(surface_.mesh.view(), sites_[0]);
    EXPECT_EQ(Vec3(coordinates[12], coordinates[13], coordinates[14]), site);
    EXPECT_EQ(Vec3(coordinates[24], coordinates[25], coordinates[26]), Vec3(1, 0.5, 0));
}

// Programs that know no other elements than vertices and faces fail at them (meshio, MeshLab).
TEST_F(WriteDiagram, PlyIsAMeshWithLabelsAndDistancesAndNothingElse) {
    const std::string header = written("d.ply").substr(0, bytes("d.ply").find("end_header"));
    EXPECT_EQ(header,
              "ply\nformat binary_little_endian 1.0\nelement vertex 4\n"
              "property double x\nproperty double y\nproperty double z\n"
              "property int site\nproperty double distance\n"
              "element face 2\nproperty list uchar int vertex_indices\n");
}

TEST_F(WriteDiagram, PlyHoldsLabelsAndDistancesOfTheVertices) {
    (void)written("d.PLY");
    const remesh::MeshFile file =
        remesh::read_mesh(at("d.PLY"), remesh::ReadOptions{.with_attributes = true});
    EXPECT_EQ(file.mesh.positions, surface_.mesh.positions);
    EXPECT_EQ(file.mesh.triangles, surface_.mesh.triangles);
    const auto& values = file.attributes.of_vertices;
    ASSERT_EQ(values.size(), 2u);
    EXPECT_EQ(values[0].values, (std::vector<double>{2, 0, 1, -1}));
    EXPECT_EQ(values[1].name, "distance");
    EXPECT_EQ(values[1].values, diagram_.nearest_distance);
}

TEST_F(WriteDiagram, GzBehindTheExtensionCompresses) {
    if (!remesh::knows_gzip()) GTEST_SKIP() << "built without zlib";
    for (const char* name : {"d.vtp", "d.obj", "d.ply", "d.agvd"}) {
        const std::string plain = written(name);
        const std::string packed = written(name + std::string(".GZ"));
        ASSERT_TRUE(remesh::is_gzip(packed)) << name;
        remesh::SourceFile file{.path = name, .bytes = packed};
        remesh::unpack_gzip(file);
        EXPECT_EQ(file.bytes, plain) << name;
    }
    EXPECT_EQ(remesh::read_diagram(at("d.agvd.GZ")).sites, sites_);
}

// Compares all bytes by writing again.
TEST_F(WriteDiagram, AgvdGivesEverythingBack) {
    const std::string text = written("d.agvd");
    const remesh::DiagramFile back = remesh::read_diagram(at("d.agvd"));
    EXPECT_EQ(back.diagram.num_sites, 3u);
    EXPECT_EQ(back.diagram.edge_points, diagram_.edge_points);
    EXPECT_EQ(back.diagram.vertex_offsets, diagram_.vertex_offsets);
    EXPECT_EQ(back.diagram.edges[1].tail, no_index);
    EXPECT_FALSE(back.diagram.edges[2].right.is_valid());
    EXPECT_EQ(back.diagram.vertex_ends[1].edge, 2u);
    EXPECT_FALSE(back.diagram.vertex_ends[1].is_tail);
    remesh::write_diagram(at("again.agvd"), build_surface(back.mesh.view()), back.sites,
                          back.diagram);
    EXPECT_EQ(bytes("again.agvd"), text);
}

TEST_F(WriteDiagram, AgvdKeepsThePointsOfSitesAndTheirStarts) {
    sites_.push_back({FaceId(0), {0.5, 0.25, 0.25}});
    const SitePoints points{.site = {2, 0, 1, 0}, .start = {0, 0.5, 0, 0}};
    remesh::write_diagram(at("d.agvd"), surface_, sites_, diagram_, {}, points);
    const remesh::DiagramFile back = remesh::read_diagram(at("d.agvd"));
    EXPECT_EQ(back.diagram.num_sites, 3u);
    EXPECT_EQ(back.diagram.cell_area, diagram_.cell_area);
    EXPECT_EQ(back.sites, sites_);
    EXPECT_TRUE(back.points == points);
    remesh::write_diagram(at("d.vtp"), surface_, sites_, diagram_, {}, points);
    EXPECT_NE(bytes("d.vtp").find("NumberOfVerts=\"4\""), std::string::npos);
}

// Site 1 has no point: its place is the first end of its line.
TEST_F(WriteDiagram, AgvdKeepsLinesAndRegions) {
    sites_.resize(2);
    const SitePoints points{.site = {0, 2}};
    std::vector<SiteShape> shapes{{.edges = {3, 1}, .site = 1, .start = 0.5},
                                  {.faces = {1}, .site = 2}};
    remesh::write_diagram(at("d.agvd"), surface_, sites_, diagram_, {}, points, shapes);
    const remesh::DiagramFile back = remesh::read_diagram(at("d.agvd"));
    EXPECT_EQ(back.diagram.num_sites, 3u);
    EXPECT_EQ(back.sites, sites_);
    EXPECT_TRUE(back.points == points);
    ASSERT_EQ(back.shapes.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const Index h = surface_.edge_half[shapes[0].edges[i]];
        EXPECT_EQ(back.shapes[0].edges[i], (std::array{surface_.tail(h), surface_.head(h)}));
    }
    EXPECT_EQ(back.shapes[0].site, 1u);
    EXPECT_EQ(back.shapes[0].start, 0.5);
    EXPECT_TRUE(back.shapes[1] == (remesh::GivenShape{.faces = {1}, .site = 2}));
    EXPECT_EQ(back.mesh.triangles, surface_.mesh.triangles);
    shapes[0].site = 2;
    remesh::write_diagram(at("d.agvd"), surface_, sites_, diagram_, {}, points, shapes);
    EXPECT_THROW((void)remesh::read_diagram(at("d.agvd")), InvalidInput) << "site 1 has no place";
}

TEST_F(WriteDiagram, SitesOfAgvdMayAllBeLines) {
    const std::vector<SiteShape> shapes{
        {.edges = {0}, .site = 1}, {.edges = {4}, .site = 0}, {.faces = {0}, .site = 2}};
    remesh::write_diagram(at("d.agvd"), surface_, {}, diagram_, {}, {}, shapes);
    const remesh::DiagramFile back = remesh::read_diagram(at("d.agvd"));
    EXPECT_TRUE(back.sites.empty());
    EXPECT_EQ(back.shapes.size(), 3u);
    EXPECT_EQ(back.diagram.cell_area, diagram_.cell_area);
}

// Edge 0 is a hyperbola in face 0; the closed curve a line, a chord and a line.
class WriteArcs : public WriteDiagram {
protected:
    WriteArcs() {
        const auto arc = [](Index face, ArcKind kind, Index first_point, double x) {
            return BisectorArc{FaceId(face),  kind,        first_point, {Vec2(x, 1), Vec2(2, 3)},
                               {0.25, 0.125}, Vec2(x, -1), Vec2(x, -2)};
        };
        diagram_.arcs = {arc(0, ArcKind::Hyperbola, 0, 1), arc(1, ArcKind::Line, 2, 2),
                         arc(0, ArcKind::Chord, 3, 3), arc(1, ArcKind::Line, 4, 4)};
        diagram_.edge_arcs = {0, 1, 4, 4};
    }
};

TEST_F(WriteArcs, VtpHasAPolylineForEachWithItsFociInSpace) {
    if (!remesh::knows_xml()) GTEST_SKIP() << "built without expat";
    const remesh::VtkData data =
        remesh::read_vtk_xml({.path = "d.vtp", .bytes = written("d.vtp"), .with_attributes = true});
    EXPECT_EQ(data.cells[1].corners.values,
              (std::vector<double>{7, 8, 9, 10, 10, 11, 11, 9, 12, 13}));
    EXPECT_EQ(data.cells[1].ends, (std::vector<std::size_t>{2, 4, 6, 8, 10}));
    std::map<std::string, std::vector<double>> values;
    for (const auto& array : data.of_cells) values[array.name] = array.values;
    EXPECT_EQ(values["site_left"], (std::vector<double>{-1, -1, -1, 0, 1, 1, 1, 0, -1, -1}));
    EXPECT_EQ(values["edge"], (std::vector<double>{-1, -1, -1, 0, 1, 1, 1, 2, -1, -1}));
    EXPECT_EQ(values["kind"], (std::vector<double>{-1, -1, -1, 1, 0, 2, 0, -1, -1, -1}));
    EXPECT_EQ(values["weight_left"], (std::vector<double>{0, 0, 0, .25, .25, .25, .25, 0, 0, 0}));
    // Corner 1 of face 0 lies on the x axis, and corner 2 above it.
    const auto focus = [&](const char* name, std::size_t cell) {
        const std::vector<double>& all = values[name];
        return Vec3(all.at(3 * cell), all.at(3 * cell + 1), all.at(3 * cell + 2));
    };
    EXPECT_EQ(focus("focus_left", 3), Vec3(1, 1, 0));
    EXPECT_EQ(focus("focus_right", 3), Vec3(2, 3, 0));
    EXPECT_EQ(focus("focus_left", 5), Vec3(0, 0, 0));  // A chord has none.
}

TEST_F(WriteArcs, AgvdGivesThemBackAndPlyHasThem) {
    const std::string text = written("d.agvd");
    const remesh::DiagramFile back = remesh::read_diagram(at("d.agvd"));
    EXPECT_TRUE(back.diagram.arcs == diagram_.arcs);
    EXPECT_EQ(back.diagram.edge_arcs, diagram_.edge_arcs);
    EXPECT_NE(written("d.ply").find("element arc 4\nproperty int edge\n"), std::string::npos);
    EXPECT_EQ(remesh::read_mesh(at("d.ply")).mesh.triangles, surface_.mesh.triangles);
}

TEST_F(WriteArcs, InAnotherOrderOrOfUnknownKindAreRefused) {
    const std::vector<BisectorArc> arcs = diagram_.arcs;
    diagram_.arcs[1].first_point = 5;
    EXPECT_THROW((void)remesh::read_diagram(put("d.agvd", written("d.agvd"))), InvalidInput);
    diagram_.arcs = arcs;
    diagram_.arcs[0].kind = static_cast<ArcKind>(3);
    EXPECT_THROW((void)remesh::read_diagram(put("d.agvd", written("d.agvd"))), InvalidInput);
}

TEST_F(WriteDiagram, DamagedDiagramsAreRefused) {
    const std::string text = written("d.agvd");
    for (const std::size_t size : {text.size() - 1, text.size() - 100, text.size() / 2}) {
        EXPECT_THROW((void)remesh::read_diagram(put("cut.agvd", text.substr(0, size))), IoError);
    }
    put("mesh.ply", shapes::grid(1));
    EXPECT_THROW((void)remesh::read_diagram(at("mesh.ply")), IoError);
    EXPECT_THROW((void)remesh::read_diagram(at("missing.ply")), IoError);
    // Any four bytes of the last two elements that hold an index, made absurd.
    const std::size_t body = text.find("end_header\n") + 11;
    int refused = 0;
    for (std::size_t at_byte = body; at_byte + 4 <= text.size(); ++at_byte) {
        std::string damaged = text;
        damaged.replace(at_byte, 4, "\x7f\x7f\x7f\x7f");
        try {
            (void)remesh::read_diagram(put("damaged.agvd", damaged));
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
}

// Of elements without properties a file may announce any number: they have no bytes.
TEST_F(WriteDiagram, ElementsWithoutPropertiesArePassedOver) {
    std::string text = written("d.agvd");
    text.insert(text.find("element vertex"), "element junk 9000000000000000000\n");
    EXPECT_EQ(remesh::read_diagram(put("junk.agvd", text)).sites, sites_);
}

TEST_F(WriteDiagram, ASecondElementOfANameIsPassedOver) {
    std::string text = written("d.agvd");
    text.insert(text.find("end_header"), "element vertex 1\nproperty char v\n");
    const remesh::DiagramFile back = remesh::read_diagram(put("twice.agvd", text + 'x'));
    EXPECT_EQ(back.diagram.nearest_site, diagram_.nearest_site);
}

TEST_F(WriteDiagram, OtherExtensionsAreRefused) {
    EXPECT_THROW((void)written("d.stl"), IoError);
    EXPECT_THROW((void)written("d"), IoError);
    remesh::check_diagram_extension("a.VTP");
    EXPECT_THROW(remesh::check_diagram_extension("vtp"), IoError);
    EXPECT_THROW(remesh::check_diagram_extension("d.gz"), IoError);
}

}  // namespace
