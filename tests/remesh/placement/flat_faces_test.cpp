#include "remesh/placement/placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "agvd/mesh/topology.h"
#include "support/shapes.h"

namespace {

using agvd::Index;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec3;

std::size_t num_flat(const TriangleMesh& mesh) {
    return static_cast<std::size_t>(
        std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                      [&](const Triangle& t) { return remesh::is_flat(mesh.positions, t); }));
}

double area_of(const TriangleMesh& mesh) {
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto& p = mesh.positions;
        area += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
    }
    return area;
}

// Triangle a, b, d above the side from a to b; n points on that side, joined by flat triangles
// that fan out from a.
TriangleMesh fan_on_a_side(Index n) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.4, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    for (Index i = 0; i < n; ++i) {
        const Index previous = i == 0 ? 1 : 2 + i;
        mesh.positions.emplace_back(1 - (i + 1.0) / (n + 1), 0, 0);
        mesh.triangles.push_back({0, 3 + i, previous});
    }
    return mesh;
}

void flip_flat_faces(TriangleMesh& mesh, std::vector<remesh::DirectedEdge> hard = {}) {
    remesh::PlacedMesh placed{{}, {}, mesh.triangles, std::move(hard)};
    remesh::flip_flat_faces(mesh.positions, placed);
    mesh.triangles = placed.triangles;
}

}  // namespace

TEST(FlatFaces, AreThoseOnOneLineUpToRounding) {
    const std::vector<Vec3> positions{
        {0, 0, 0}, {3, 3, 3}, {1, 1, 1}, {1, 1, 1 + 1e-15}, {1, 1, 1 + 1e-6}};
    EXPECT_TRUE(remesh::is_flat(positions, {0, 1, 2}));
    EXPECT_TRUE(remesh::is_flat(positions, {0, 1, 3}));
    EXPECT_TRUE(remesh::is_flat(positions, {2, 2, 2}));
    EXPECT_FALSE(remesh::is_flat(positions, {0, 1, 4}));
}

TEST(FlatFaces, GiveTheirCornersToTheNeighbour) {
    for (const Index n : {1U, 2U, 5U}) {
        TriangleMesh mesh = fan_on_a_side(n);
        ASSERT_EQ(num_flat(mesh), n);
        flip_flat_faces(mesh);
        EXPECT_EQ(num_flat(mesh), 0U);
        EXPECT_EQ(mesh.triangles.size(), n + 1);
        EXPECT_NEAR(area_of(mesh), 0.5, 1e-15);
        const remesh::Topology topology = remesh::analyze_topology(mesh.view());
        EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
        ASSERT_EQ(topology.components.size(), 1U);
        EXPECT_EQ(topology.components[0].boundary_loops, 1U);
    }
}

TEST(FlatFaces, StayWhereTheirLongestEdgeIsABoundary) {
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0.5, -1, 0}};
    const TriangleMesh before{positions, {{0, 1, 2}, {0, 2, 3}}};
    TriangleMesh after = before;
    flip_flat_faces(after);
    EXPECT_EQ(after.triangles, before.triangles);
}

TEST(FlatFaces, StayWhereTheirLongestEdgeIsHard) {
    const TriangleMesh before = fan_on_a_side(1);
    TriangleMesh after = before;
    flip_flat_faces(after, {{1, 0}});
    EXPECT_EQ(after.triangles, before.triangles);
}

TEST(FlatFaces, AMeshWithoutThemStays) {
    const TriangleMesh before = shapes::torus(12, 8);
    TriangleMesh after = before;
    flip_flat_faces(after);
    EXPECT_EQ(after.triangles, before.triangles);
}
