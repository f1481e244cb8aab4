// Edges of several sheets by their origin, and curves with a side for each face.
#include "remesh/curves/curve_network.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "remesh/clean/clean_input.h"
#include "remesh/curves/curve_sites.h"
#include "remesh/curves/glue.h"
#include "support/junction_shapes.h"

using agvd::Index;
using agvd::Surface;
using agvd::Vec3;
using remesh::Curve;
using remesh::CurveNetwork;
using remesh::JunctionSet;
using shapes::JunctionShape;

namespace {

struct Cleaned {
    explicit Cleaned(const agvd::TriangleMesh& mesh)
        : surface(agvd::build_surface(clean(mesh).view())),
          junctions(remesh::find_junctions(surface, origin)),
          network(remesh::find_network(surface, std::vector<std::uint8_t>(surface.num_edges(), 0),
                                       .3, junctions)) {}

    agvd::TriangleMesh clean(const agvd::TriangleMesh& mesh) {
        remesh::CleanResult result = remesh::clean_input(mesh.view());
        origin = std::move(result.vertex_origin);
        return std::move(result.mesh);
    }
    [[nodiscard]] std::vector<const Curve*> junction_curves() const {
        std::vector<const Curve*> curves;
        for (const Curve& curve : network.curves) {
            if (curve.is_junction()) curves.push_back(&curve);
        }
        return curves;
    }

    std::vector<Index> origin;
    Surface surface;
    JunctionSet junctions;
    CurveNetwork network;
};

// Index of the node at a place; no_index: none.
Index node_at(const Cleaned& mesh, const Vec3& place) {
    for (Index i = 0; i < mesh.network.nodes.size(); ++i) {
        if (mesh.surface.mesh.positions[mesh.network.nodes[i]] == place) return i;
    }
    return agvd::no_index;
}

}  // namespace

TEST(FindJunctions, EdgesOfOneOriginAreOne) {
    for (const JunctionShape& shape : shapes::straight_junctions()) {
        SCOPED_TRACE(shape.name);
        const Cleaned mesh(shape.mesh);
        EXPECT_EQ(mesh.junctions.edges.size(), shape.num_edges);
        EXPECT_TRUE(std::is_sorted(mesh.junctions.edges.begin(), mesh.junctions.edges.end()));
        for (const std::vector<Index>& copies : mesh.junctions.edges) {
            EXPECT_EQ(copies.size(), shape.num_sheets);
            Index num_faces = 0;
            for (const Index e : copies) {
                const Index h = mesh.surface.edge_half[e];
                num_faces += mesh.surface.twin[h] == agvd::no_index ? 1 : 2;
            }
            EXPECT_EQ(num_faces, shape.num_faces);
        }
        for (const std::vector<Index>& copies : mesh.junctions.vertices) {
            EXPECT_GE(copies.size(), 2u);
            for (const Index v : copies) EXPECT_EQ(mesh.origin[v], mesh.origin[copies[0]]);
        }
    }
}

TEST(FindJunctions, ASharedPointIsNone) {
    const Cleaned mesh(shapes::cones_at_a_point(12));
    EXPECT_EQ(mesh.surface.num_vertices(), shapes::cones_at_a_point(12).positions.size() + 1);
    EXPECT_TRUE(mesh.junctions.empty());
    EXPECT_TRUE(mesh.junctions.vertices.empty());
}

TEST(FindJunctions, FirstCopiesAreTheirOwn) {
    JunctionSet junctions;
    junctions.vertices = {{1, 4}, {2, 3, 5}};
    EXPECT_EQ(first_copies(junctions, 7), std::vector<Index>({0, 1, 2, 2, 1, 2, 6}));
}

TEST(JunctionCurves, HaveASideForEachFace) {
    for (const JunctionShape& shape : shapes::straight_junctions()) {
        SCOPED_TRACE(shape.name);
        const Cleaned mesh(shape.mesh);
        const auto curves = mesh.junction_curves();
        EXPECT_EQ(curves.size(), shape.lines.size());
        double length = 0;
        for (const Curve* curve : curves) {
            length += curve->length();
            EXPECT_FALSE(curve->is_crease());
            EXPECT_EQ(curve->num_sheets, shape.num_sheets);
            ASSERT_EQ(curve->sides.size(), shape.num_faces);
            for (std::size_t i = 0; i <= curve->num_edges(); ++i) {
                const Vec3& at = mesh.surface.mesh.positions[curve->vertex(mesh.surface, i)];
                for (std::size_t side = 0; side < curve->sides.size(); ++side) {
                    const Index v = curve->vertex(mesh.surface, i, side);
                    EXPECT_EQ(mesh.surface.mesh.positions[v], at);
                }
            }
            // Sides of one sheet are the two sides of one edge, others are not.
            for (const remesh::CurveSide& a : curve->sides) {
                for (const remesh::CurveSide& b : curve->sides) {
                    EXPECT_EQ(
                        mesh.surface.edge[a.half_edges[0]] == mesh.surface.edge[b.half_edges[0]],
                        a.sheet == b.sheet);
                }
            }
        }
        double wanted = 0;
        for (const auto& [from, to] : shape.lines) wanted += (to - from).norm();
        EXPECT_NEAR(length, wanted, 1e-12);
        for (const auto& [from, to] : shape.lines) {
            EXPECT_NE(node_at(mesh, from), agvd::no_index);
            EXPECT_NE(node_at(mesh, to), agvd::no_index);
        }
    }
}

TEST(JunctionCurves, EndWhereTheBoundaryGoesOnAlmostStraight) {
    const Cleaned fan(shapes::fan_on_plate().mesh);
    // Two ends, the fan's upper corners and the plate's four.
    EXPECT_EQ(fan.network.nodes.size(), 8u);
    EXPECT_EQ(fan.network.copies.size(), 2u);
    for (const auto& [vertex, node] : fan.network.copies) {
        EXPECT_EQ(fan.origin[vertex], fan.origin[fan.network.nodes[node]]);
    }
}

TEST(JunctionCurves, ClosedOnesHaveANodeOnlyWhereTheirSidesChangePlaces) {
    const Cleaned round(shapes::round_pipe_on_plate(48));
    ASSERT_EQ(round.junction_curves().size(), 1u);
    EXPECT_TRUE(round.junction_curves()[0]->is_closed());
    const Cleaned twisted(shapes::twisted_pages(60));
    ASSERT_EQ(twisted.junction_curves().size(), 1u);
    const Curve& curve = *twisted.junction_curves()[0];
    EXPECT_FALSE(curve.is_closed());
    EXPECT_EQ(curve.begin, curve.end);
    EXPECT_EQ(curve.num_edges(), 60u);
    EXPECT_EQ(curve.num_sheets, 3u);
}

TEST(JunctionCurves, EndWhereSheetsAreJoinedOtherwise) {
    const Cleaned mesh(shapes::pages_that_change_partners(4));
    const auto curves = mesh.junction_curves();
    ASSERT_EQ(curves.size(), 2u);
    for (const Curve* curve : curves) {
        EXPECT_EQ(curve->num_edges(), 4u);
        EXPECT_EQ(curve->sides.size(), 4u);
        EXPECT_EQ(curve->num_sheets, 2u);
    }
    EXPECT_NE(node_at(mesh, {0, 0, 0}), agvd::no_index);
}

TEST(JunctionCurves, SitesHaveACopyOnEachSideAndAVertexOnEachSheet) {
    for (const auto in_result : {remesh::Junctions::Apart, remesh::Junctions::Keep}) {
        Cleaned mesh(shapes::tee().mesh);
        mesh.network.junctions = in_result;
        std::vector<std::uint8_t> is_cut(mesh.surface.num_edges(), 0);
        for (const auto& copies : mesh.junctions.edges) {
            for (const Index e : copies) is_cut[e] = 1;
        }
        const remesh::CutSurface cut = remesh::cut_surface(mesh.surface, is_cut);
        const auto intervals = remesh::curve_intervals(mesh.surface, mesh.network, .3);
        const auto sites = remesh::curve_sites_at(
            mesh.network, cut, remesh::even_positions(cut.surface(), mesh.network, .3, intervals));
        EXPECT_EQ(num_result_vertices(mesh.network, sites),
                  num_curve_vertices(mesh.network, intervals));
        Index num_there = 0, num_groups = 0;
        for (Index g = 0; g < sites.num_groups(); ++g) {
            const Index first = sites.first_copy[g], last = sites.first_copy[g + 1];
            const Vec3 at = position(cut.surface().mesh.view(), sites.sites[first]);
            for (Index i = first; i < last; ++i) {
                const Vec3 other = position(cut.surface().mesh.view(), sites.sites[i]);
                EXPECT_LT((other - at).norm(), 1e-12);
            }
            if (at.x() != 0 || at.z() != 0) continue;
            ++num_groups;
            EXPECT_EQ(last - first, 3u);
            std::vector<Index> vertices(sites.vertex.begin() + first, sites.vertex.begin() + last);
            std::sort(vertices.begin(), vertices.end());
            vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
            EXPECT_EQ(vertices.size(), 2u);
            num_there += in_result == remesh::Junctions::Keep ? 1 : 2;
        }
        EXPECT_EQ(num_groups, 8u);  // 7 intervals.
        EXPECT_EQ(num_junction_vertices(mesh.network, sites), num_there);
    }
}

TEST(NumBranchedEdges, CountsThoseOfThreeFaces) {
    std::vector<agvd::Triangle> triangles{{0, 1, 2}, {1, 0, 3}};
    EXPECT_EQ(remesh::num_branched_edges(triangles), 0u);
    triangles.push_back({0, 1, 4});
    EXPECT_EQ(remesh::num_branched_edges(triangles), 1u);
}
