#include "remesh/io/write_diagram.h"

#include <gtest/gtest.h>

#include <cmath>

#include "agvd/core/error.h"
#include "remesh/io/read_diagram.h"
#include "remesh/io/read_mesh.h"
#include "remesh/io/vtk_data.h"
#include "remesh/io/xml_reader.h"
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

TEST_F(WriteDiagram, VtpHasALineForEachEdgeWithItsSites) {
    const std::string text = written("d.vtp");
    EXPECT_NE(text.find("NumberOfPoints=\"7\""), std::string::npos);
    EXPECT_NE(text.find("NumberOfLines=\"3\""), std::string::npos);
    if (!remesh::knows_xml()) GTEST_SKIP() << "built without expat";
    const remesh::VtkData data =
        remesh::read_vtk_xml({.path = "d.vtp", .bytes = text, .with_attributes = true});
    ASSERT_EQ(data.cells.size(), 1u);
    EXPECT_EQ(data.cells[0].types, std::vector{remesh::VtkCell::Lines});
    EXPECT_EQ(data.cells[0].corners.values, (std::vector<double>{0, 1, 2, 3, 4, 2, 5, 6}));
    EXPECT_EQ(data.cells[0].ends, (std::vector<std::size_t>{2, 6, 8}));
    ASSERT_EQ(data.of_cells.size(), 2u);
    EXPECT_EQ(data.of_cells[0].name, "site_left");
    EXPECT_EQ(data.of_cells[0].values, (std::vector<double>{0, 1, 0}));
    EXPECT_EQ(data.of_cells[1].values, (std::vector<double>{1, 2, -1}));
    ASSERT_EQ(data.of_points.size(), 1u);
    EXPECT_EQ(data.of_points[0].name, "distance");
    EXPECT_EQ(data.of_points[0].values, diagram_.point_distance);
    EXPECT_EQ(data.points->values[3], 1);
    EXPECT_EQ(data.points->values[4], 0.5);
}

TEST_F(WriteDiagram, PlyReadsBackAsTheMeshAndHoldsLabelsAndDistances) {
    const std::string text = written("d.ply");
    EXPECT_EQ(remesh::read_mesh(at("d.ply")).mesh.positions, surface_.mesh.positions);
    EXPECT_EQ(remesh::read_mesh(at("d.ply")).mesh.triangles, surface_.mesh.triangles);
    const std::size_t body = text.find("end_header\n") + 11;
    constexpr std::size_t stride = 3 * sizeof(double) + sizeof(std::int32_t) + sizeof(double);
    for (Index v = 0; v < 4; ++v) {
        std::int32_t site = 0;
        double distance = 0;
        text.copy(reinterpret_cast<char*>(&site), sizeof site, body + v * stride + 24);
        text.copy(reinterpret_cast<char*>(&distance), sizeof distance, body + v * stride + 28);
        EXPECT_EQ(site, v == 3 ? -1 : static_cast<int>(diagram_.nearest_site[v].value()));
        EXPECT_EQ(distance, diagram_.nearest_distance[v]);
    }
}

// Compares all bytes by writing again.
TEST_F(WriteDiagram, PlyGivesEverythingBack) {
    const std::string text = written("d.ply");
    const remesh::DiagramFile back = remesh::read_diagram(at("d.ply"));
    EXPECT_EQ(back.diagram.num_sites, 3u);
    EXPECT_EQ(back.diagram.edge_points, diagram_.edge_points);
    EXPECT_EQ(back.diagram.vertex_offsets, diagram_.vertex_offsets);
    EXPECT_EQ(back.diagram.edges[1].tail, no_index);
    EXPECT_FALSE(back.diagram.edges[2].right.is_valid());
    EXPECT_EQ(back.diagram.vertex_ends[1].edge, 2u);
    EXPECT_FALSE(back.diagram.vertex_ends[1].is_tail);
    remesh::write_diagram(at("again.ply"), build_surface(back.mesh.view()), back.sites,
                          back.diagram);
    EXPECT_EQ(bytes("again.ply"), text);
}

TEST_F(WriteDiagram, DamagedDiagramsAreRefused) {
    const std::string text = written("d.ply");
    for (const std::size_t size : {text.size() - 1, text.size() - 100, text.size() / 2}) {
        EXPECT_THROW((void)remesh::read_diagram(put("cut.ply", text.substr(0, size))), IoError);
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
            (void)remesh::read_diagram(put("damaged.ply", damaged));
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
}

// Of elements without properties a file may announce any number: they have no bytes.
TEST_F(WriteDiagram, ElementsWithoutPropertiesArePassedOver) {
    std::string text = written("d.ply");
    text.insert(text.find("element vertex"), "element junk 9000000000000000000\n");
    EXPECT_EQ(remesh::read_diagram(put("junk.ply", text)).sites, sites_);
}

TEST_F(WriteDiagram, ASecondElementOfANameIsPassedOver) {
    std::string text = written("d.ply");
    text.insert(text.find("end_header"), "element vertex 1\nproperty char v\n");
    const remesh::DiagramFile back = remesh::read_diagram(put("twice.ply", text + 'x'));
    EXPECT_EQ(back.diagram.nearest_site, diagram_.nearest_site);
}

TEST_F(WriteDiagram, OtherExtensionsAreRefused) {
    EXPECT_THROW((void)written("d.stl"), IoError);
    EXPECT_THROW((void)written("d"), IoError);
    EXPECT_TRUE(remesh::is_known_diagram_extension("a.VTP"));
    EXPECT_FALSE(remesh::is_known_diagram_extension("vtp"));
}

}  // namespace
