#include "remesh/dual/delaunay_flips.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

using namespace agvd;
using remesh::FlipCounts;
using remesh::FlippableMesh;

namespace {

// Triangles (0, 1, 2) and (1, 0, 3): the edge from 0 to 1 is long, so that it fails.
struct Quad {
    std::vector<Triangle> triangles{{0, 1, 2}, {1, 0, 3}};
    std::vector<Vec3> positions{{0, 0, 0}, {4, 0, 0}, {2, 1, 0}, {2, -1, 0}};
    double diagonal = 2;  // What the other one is said to measure.
    std::vector<Index> accepted = {};

    FlipCounts flip(FlippableMesh& mesh) {
        std::vector<double> length(mesh.num_edges(), std::sqrt(5.0));
        for (Index e = 0; e < mesh.num_edges(); ++e) {
            const Index h = mesh.sides(e)[0];
            if (mesh.tail(h) + mesh.tail(FlippableMesh::next(h)) == 1) length[e] = 4;
        }
        return flip_to_delaunay(
            mesh, length, positions,
            {[&](Index) { return diagonal; }, [&](Index edge) { accepted.push_back(edge); }});
    }
};

bool has_edge(const FlippableMesh& mesh, Index a, Index b) {
    for (Index e = 0; e < mesh.num_edges(); ++e) {
        const Index h = mesh.sides(e)[0];
        const Index tail = mesh.tail(h), head = mesh.tail(FlippableMesh::next(h));
        if (std::minmax(tail, head) == std::minmax(a, b)) return true;
    }
    return false;
}

}  // namespace

TEST(DelaunayFlips, FlipALongDiagonal) {
    Quad quad;
    FlippableMesh mesh(quad.triangles);
    const FlipCounts counts = quad.flip(mesh);
    EXPECT_EQ(counts.flips, 1u);
    EXPECT_TRUE(counts.is_finished);
    EXPECT_EQ(quad.accepted.size(), 1u);
    EXPECT_TRUE(has_edge(mesh, 2, 3));
    EXPECT_FALSE(has_edge(mesh, 0, 1));
}

TEST(DelaunayFlips, TurnNoTriangleOver) {
    Quad quad;
    quad.positions[0] = {3, 0, 0};  // No longer convex: 0 lies beyond the line from 2 to 3.
    FlippableMesh mesh(quad.triangles);
    EXPECT_EQ(quad.flip(mesh).flips, 0u);
    quad.positions[0] = {1, 0, 0};
    EXPECT_EQ(quad.flip(mesh).flips, 1u);
}

TEST(DelaunayFlips, KeepTheTriangleInequalityAndMakeTheEdgeDelaunay) {
    Quad quad;
    FlippableMesh mesh(quad.triangles);
    quad.diagonal = 4.5;  // Longer than two sides.
    EXPECT_EQ(quad.flip(mesh).flips, 0u);
    quad.diagonal = 3.9;  // Fails as well, as around a sharp cone.
    EXPECT_EQ(quad.flip(mesh).flips, 0u);
    quad.diagonal = 3.1;  // Of a square it would be sqrt(10).
    EXPECT_EQ(quad.flip(mesh).flips, 1u);
}

TEST(DelaunayFlips, RepeatNoEdge) {
    Quad quad;
    // Closed below by two faces that have the edge from 2 to 3 already.
    quad.triangles.insert(quad.triangles.end(), {{0, 2, 3}, {2, 1, 3}});
    FlippableMesh mesh(quad.triangles);
    EXPECT_EQ(quad.flip(mesh).flips, 0u);
    EXPECT_TRUE(has_edge(mesh, 0, 1));
}

TEST(DelaunayFlips, LeaveEdgesAloneThatThreeTrianglesShare) {
    Quad quad;
    quad.positions.push_back({2, 0, 1});
    quad.triangles.push_back({0, 1, 4});
    FlippableMesh mesh(quad.triangles);
    EXPECT_EQ(quad.flip(mesh).flips, 0u);
    EXPECT_EQ(mesh.triangles(), quad.triangles);
}

TEST(FlippableMesh, StaysConsistentUnderFlips) {
    const TriangleMesh sphere = shapes::sphere(2);
    FlippableMesh mesh(sphere.triangles);
    Index flips = 0;
    for (Index step = 0; step < 2000; ++step) {
        const Index edge = step * 7919 % mesh.num_edges();
        if (!mesh.can_flip(edge)) continue;
        mesh.flip(edge);
        ++flips;
    }
    EXPECT_GT(flips, 500u);
    const FlippableMesh fresh(mesh.triangles());
    EXPECT_EQ(fresh.num_edges(), mesh.num_edges());
    for (Index e = 0; e < mesh.num_edges(); ++e) {
        ASSERT_TRUE(fresh.is_inner(e));
        const auto [h, g] = mesh.sides(e);
        EXPECT_EQ(mesh.edge(h), e);
        EXPECT_EQ(mesh.edge(g), e);
        EXPECT_EQ(mesh.tail(h), mesh.tail(FlippableMesh::next(g)));
        EXPECT_EQ(mesh.tail(g), mesh.tail(FlippableMesh::next(h)));
    }
    for (Index e = 0; e < mesh.num_edges(); ++e)
        EXPECT_EQ(fresh.can_flip(fresh.edge(mesh.sides(e)[0])), mesh.can_flip(e));
}
