#include "remesh/dual/reduce_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agvd/mesh/topology.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using remesh::reduce_vertices;

namespace {

// The vertices that triangles use, ascending.
std::vector<Index> used(const TriangleMesh& mesh) {
    std::vector<Index> all;
    for (const agvd::Triangle& t : mesh.triangles) all.insert(all.end(), t.begin(), t.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

void expect_topology_of(const TriangleMesh& before, const TriangleMesh& after) {
    const remesh::Topology topology = remesh::analyze_topology(after.view());
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_TRUE(topology.is_oriented);
    EXPECT_TRUE(same_topology(topology, remesh::analyze_topology(before.view())));
}

TEST(ReduceVertices, ReachesTheTargetAndKeepsTheTopology) {
    for (const TriangleMesh& mesh :
         {shapes::sphere(2), shapes::torus(12, 8), shapes::tube(9, 4), shapes::grid(6)}) {
        TriangleMesh reduced = mesh;
        const auto target = static_cast<Index>(mesh.positions.size() / 2);
        const auto gone = reduce_vertices(mesh.positions, reduced.triangles, target);
        EXPECT_EQ(gone.size(), mesh.positions.size() - target);
        EXPECT_EQ(used(reduced).size(), target);
        for (const Index v : gone) {
            EXPECT_FALSE(std::ranges::binary_search(used(reduced), v)) << v;
        }
        expect_topology_of(mesh, reduced);
    }
}

// Collapses of short edges alone would turn faces over and leave needles.
TEST(ReduceVertices, KeepsTheShapeAsLongAsThatLeadsToTheTarget) {
    const TriangleMesh mesh = shapes::jitter(shapes::sphere(3), 0.03, 1);
    TriangleMesh reduced = mesh;
    EXPECT_EQ(reduce_vertices(mesh.positions, reduced.triangles, 321).size(), 321u);
    for (const auto& [a, b, c] : reduced.triangles) {
        const auto& p = mesh.positions;
        const agvd::Vec3 normal = (p[b] - p[a]).cross(p[c] - p[a]);
        EXPECT_GT(normal.dot(p[a] + p[b] + p[c]), 0);
        const double longest =
            std::max({(p[a] - p[b]).norm(), (p[b] - p[c]).norm(), (p[c] - p[a]).norm()});
        EXPECT_GT(2 / std::sqrt(3) * normal.norm() / (longest * longest), 0.3);
    }
}

TEST(ReduceVertices, LeavesAMeshWithFewEnoughAlone) {
    const TriangleMesh mesh = shapes::icosahedron();
    TriangleMesh reduced = mesh;
    EXPECT_TRUE(reduce_vertices(mesh.positions, reduced.triangles, 12).empty());
    EXPECT_EQ(reduced.triangles, mesh.triangles);
}

TEST(ReduceVertices, StopsAtTheSmallestMeshOfTheTopology) {
    TriangleMesh sphere = shapes::icosahedron();
    EXPECT_EQ(reduce_vertices(sphere.positions, sphere.triangles, 1).size(), 8u);
    EXPECT_EQ(used(sphere).size(), 4u);
    expect_topology_of(shapes::icosahedron(), sphere);

    TriangleMesh disc = shapes::grid(4);
    (void)reduce_vertices(disc.positions, disc.triangles, 1);
    EXPECT_EQ(used(disc).size(), 3u);
    EXPECT_EQ(disc.triangles.size(), 1u);

    // A torus can do with 7, but no sequence of collapses need reach them: 26 g - 4 at most.
    TriangleMesh torus = shapes::torus(12, 8);
    (void)reduce_vertices(torus.positions, torus.triangles, 1);
    EXPECT_GE(used(torus).size(), 7u);
    EXPECT_LE(used(torus).size(), 22u);
    expect_topology_of(shapes::torus(12, 8), torus);
}

TEST(ReduceVertices, TakesTheShortestEdgeFirst) {
    TriangleMesh mesh = shapes::grid(4);
    mesh.positions[12] = mesh.positions[13] + agvd::Vec3(-0.01, 0, 0);  // Inner neighbours.
    const auto gone = reduce_vertices(mesh.positions, mesh.triangles, 24);
    ASSERT_EQ(gone.size(), 1u);
    EXPECT_TRUE(gone[0] == 12 || gone[0] == 13) << gone[0];
}

// A needle with a vertex M in the middle of its longest side AB and an inner vertex Y near A. The
// shortest collapse, Y into A, would leave the face AMB, whose corners lie on one line.
TEST(ReduceVertices, NeedlesGetNoFaceWithoutArea) {
    enum : agvd::Index { a, m, b, c, y };
    const std::vector<agvd::Vec3> positions{
        {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {-1, 0.04, 0}, {0.1, 0.01, 0}};
    std::vector<agvd::Triangle> triangles{{a, m, y}, {m, b, y}, {b, c, y}, {c, a, y}};
    const std::vector<std::uint8_t> keep{1, 1, 1, 1, 0};
    EXPECT_EQ(reduce_vertices(positions, triangles, 4, keep), (std::vector<agvd::Index>{y}));
    EXPECT_EQ(triangles, (std::vector<agvd::Triangle>{{b, c, m}, {c, a, m}}));
}

TEST(ReduceVertices, KeepsTheVerticesToBeKeptAsLongAsOthersCanGo) {
    const TriangleMesh mesh = shapes::sphere(2);
    std::vector<std::uint8_t> keep(mesh.positions.size(), 0);
    for (Index v = 0; v < 40; ++v) keep[v] = 1;
    TriangleMesh reduced = mesh;
    (void)reduce_vertices(mesh.positions, reduced.triangles, 50, keep);
    const std::vector<Index> left = used(reduced);
    EXPECT_EQ(left.size(), 50u);
    for (Index v = 0; v < 40; ++v) EXPECT_TRUE(std::ranges::binary_search(left, v)) << v;

    // Fewer than are to be kept: these go last.
    TriangleMesh fewer = mesh;
    (void)reduce_vertices(mesh.positions, fewer.triangles, 30, keep);
    EXPECT_EQ(used(fewer).size(), 30u);
    for (const Index v : used(fewer)) EXPECT_LT(v, 40u);
}

TEST(ReduceVertices, BoundaryVerticesGoOnlyAlongTheBoundary) {
    const TriangleMesh mesh = shapes::grid(6);
    TriangleMesh reduced = mesh;
    (void)reduce_vertices(mesh.positions, reduced.triangles, 20);
    // No boundary edge leaves the square's sides: the area stays 1.
    double area = 0;
    for (const auto& [a, b, c] : reduced.triangles) {
        const auto& p = mesh.positions;
        const double twice = (p[b] - p[a]).cross(p[c] - p[a]).z();
        EXPECT_GT(twice, 0);
        area += twice / 2;
    }
    EXPECT_LE(area, 1 + 1e-12);
    std::vector<std::uint8_t> keep(mesh.positions.size(), 0);
    for (const Index corner : {0u, 6u, 42u, 48u}) keep[corner] = 1;
    reduced = mesh;
    (void)reduce_vertices(mesh.positions, reduced.triangles, 20, keep);
    area = 0;
    for (const auto& [a, b, c] : reduced.triangles) {
        const auto& p = mesh.positions;
        area += (p[b] - p[a]).cross(p[c] - p[a]).z() / 2;
    }
    EXPECT_NEAR(area, 1, 1e-12);
}

}  // namespace
