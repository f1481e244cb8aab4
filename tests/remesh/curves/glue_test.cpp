// Patches that become one mesh, and patches simplified to their sites.
#include "remesh/curves/glue.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/dual/reduce_vertices.h"
#include "support/dice.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Triangle;

namespace {

std::set<std::pair<Index, Index>> edges_of(const std::vector<Triangle>& triangles) {
    std::set<std::pair<Index, Index>> edges;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax({t[k], t[(k + 1) % 3]}));
    }
    return edges;
}

// Vertices of the given number at places of no importance.
remesh::Topology topology_of(const remesh::GluedMesh& mesh) {
    agvd::TriangleMesh result{{}, mesh.triangles};
    for (Index i = 0; i < mesh.first.size(); ++i) {
        result.positions.emplace_back(i, i * i, i * i * i);
    }
    return remesh::analyze_topology(result.view());
}

// Without repeated edges, as far as flips can mend them.
remesh::GluedMesh glue_parted(std::vector<Triangle> patches, const std::vector<Index>& group) {
    remesh::flip_repeated(patches, group);
    return remesh::glue(patches, group);
}

}  // namespace

TEST(Glue, CopiesBecomeTheFirstOfThem) {
    // Two triangles with copies of the edge between them.
    const remesh::GluedMesh mesh = remesh::glue(std::vector<Triangle>{{0, 1, 2}, {4, 3, 5}},
                                                std::vector<Index>{7, 3, 5, 7, 3, 9});
    EXPECT_EQ(mesh.vertex, std::vector<Index>({0, 1, 2, 0, 1, 3}));
    EXPECT_EQ(mesh.first, std::vector<Index>({0, 1, 2, 5}));
    EXPECT_EQ(mesh.triangles, std::vector<Triangle>({{0, 1, 2}, {1, 0, 3}}));
}

TEST(Glue, AnEdgeOfTwoPatchesIsFlippedInOne) {
    // A square and the same from below, both with the diagonal (0, 2).
    const std::vector<Triangle> patches{{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}};
    const std::vector<Index> group{0, 1, 2, 3, 0, 1, 2, 3};
    const remesh::GluedMesh mesh = glue_parted(patches, group);
    EXPECT_EQ(edges_of(mesh.triangles).size(), 6u);
    const remesh::Topology topology = topology_of(mesh);
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_TRUE(topology.is_oriented);
    ASSERT_EQ(topology.components.size(), 1u);
    EXPECT_EQ(topology.components[0].genus, 0);
    EXPECT_EQ(topology.components[0].boundary_loops, 0);
}

TEST(Glue, WhatNoFlipCanMendStays) {
    // As before, but the other diagonal is an edge of a third patch.
    const std::vector<Triangle> patches{{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}, {8, 9, 10}};
    const std::vector<Index> group{0, 1, 2, 3, 0, 1, 2, 3, 1, 3, 4};
    const remesh::GluedMesh mesh = glue_parted(patches, group);
    EXPECT_EQ(mesh.triangles,
              std::vector<Triangle>({{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}, {1, 3, 4}}));
}

// Triangles with two copies of a vertex: the edge between these would join a vertex with itself.
TEST(Glue, AnEdgeBetweenCopiesOfAVertexIsFlipped) {
    // A fan around 0, of whose rim 1 and 2 are copies.
    const std::vector<Triangle> patch{{0, 1, 2}, {2, 1, 3}, {0, 2, 4}, {0, 4, 5}, {0, 5, 1}};
    const std::vector<Index> group{0, 1, 1, 2, 3, 4};
    std::vector<Triangle> parted = patch;
    remesh::flip_repeated(parted, group);
    EXPECT_EQ(parted.size(), patch.size());
    for (const Triangle& t : remesh::glue(parted, group).triangles) {
        EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    }
    EXPECT_LE(remesh::repeated_edges(parted, group).size(), 1u);
}

TEST(Glue, RepeatedInnerEdgesAreTold) {
    // The two diagonals (0, 2) of WhatNoFlipCanMendStays: one of the two is told.
    const std::vector<Triangle> patches{{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}, {8, 9, 10}};
    const std::vector<Index> group{0, 1, 2, 3, 0, 1, 2, 3, 1, 3, 4};
    const auto repeated = remesh::repeated_edges(patches, group);
    ASSERT_EQ(repeated.size(), 1u);
    const auto ends = [&](Index h) {
        return std::pair(patches[h / 3][h % 3], patches[h / 3][(h + 1) % 3]);
    };
    const auto [a, b] = ends(repeated[0].half_edge);
    EXPECT_EQ(ends(repeated[0].other), std::pair(b, a));
    EXPECT_EQ(group[a] + group[b], 2u);
    // Where the rims of two patches meet, every inner edge there is.
    const std::vector<Triangle> rims{{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {7, 8, 9}, {7, 9, 10}};
    const std::vector<Index> names{0, 1, 2, 3, 0, 4, 2, 0, 1, 2, 3};
    EXPECT_EQ(remesh::repeated_edges(rims, names).size(), 2u);
    // An edge from a vertex to itself.
    const std::vector<Triangle> loop{{0, 1, 2}, {1, 0, 3}};
    EXPECT_EQ(remesh::repeated_edges(loop, std::vector<Index>{0, 0, 1, 2}).size(), 1u);
}

TEST(ThinPatch, HasTheVerticesOfItsSitesOnly) {
    const agvd::Surface surface = agvd::build_surface(shapes::grid(8).view());
    std::vector<Index> faces(surface.num_faces());
    std::iota(faces.begin(), faces.end(), 0u);
    // The corners, all vertices of one side, and two inside.
    std::vector<agvd::SurfacePoint> points;
    const auto& p = surface.mesh.positions;
    std::set<Index> seen;
    for (Index h = 0; h < surface.twin.size(); ++h) {
        const agvd::Vec3& at = p[surface.tail(h)];
        const bool is_corner = (at.x() == 0 || at.x() == 1) && (at.y() == 0 || at.y() == 1);
        const bool is_inside = at == agvd::Vec3(.5, .25, 0) || at == agvd::Vec3(.25, .625, 0);
        if ((!is_corner && !is_inside && at.y() != 0) || !seen.insert(surface.tail(h)).second) {
            continue;
        }
        points.push_back(agvd::point_at(surface, surface.tail(h)));
    }
    ASSERT_EQ(points.size(), 13u);
    const agvd::SimplifiedMesh mesh = remesh::simplify_patch(surface, faces, points);
    EXPECT_TRUE(mesh.extra.empty());
    agvd::TriangleMesh result{{}, mesh.triangles};
    for (const auto& point : points) {
        result.positions.push_back(position(surface.mesh.view(), point));
    }
    const remesh::Topology topology = remesh::analyze_topology(result.view());
    EXPECT_TRUE(topology.is_manifold);
    ASSERT_EQ(topology.components.size(), 1u);
    EXPECT_EQ(topology.components[0].boundary_loops, 1);
    // Two inside, eleven on the rim.
    EXPECT_EQ(mesh.triangles.size(), 2 * 13 - 11 - 2u);
}

TEST(SimplifyPatch, VerticesThatSimplifyingLeavesGoByCollapses) {
    const agvd::Surface surface = agvd::build_surface(shapes::torus(12, 8).view());
    std::vector<Index> faces(surface.num_faces());
    std::iota(faces.begin(), faces.end(), 0u);
    std::vector<agvd::SurfacePoint> points;
    for (const Index v : {8u, 12u, 19u, 44u, 58u, 60u, 72u, 79u}) {
        points.push_back(agvd::point_at(surface, v));
    }
    ASSERT_EQ(agvd::simplify(surface, faces, points).extra.size(), 1u);
    const agvd::SimplifiedMesh mesh = remesh::simplify_patch(surface, faces, points);
    EXPECT_TRUE(mesh.extra.empty());
    EXPECT_EQ(mesh.triangles.size(), 16u);  // Twice the vertices.
    agvd::TriangleMesh result{{}, mesh.triangles};
    for (const auto& point : points) {
        result.positions.push_back(position(surface.mesh.view(), point));
    }
    const remesh::Topology topology = remesh::analyze_topology(result.view());
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_EQ(topology.genus(), 1);
}

// Where an edge is in the way of each collapse, it is flipped. Without flips 39 of these 60 keep a
// vertex.
TEST(SimplifyPatch, EdgesInTheWayOfCollapsesAreFlipped) {
    const agvd::Surface surface = agvd::build_surface(shapes::torus(12, 8).view());
    std::vector<Index> faces(surface.num_faces());
    std::iota(faces.begin(), faces.end(), 0u);
    int num_simplified = 0, num_left = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Dice dice(seed);
        std::set<Index> vertices;
        while (vertices.size() < 8) vertices.insert(dice.count(0, surface.num_vertices() - 1));
        std::vector<agvd::SurfacePoint> points;
        for (const Index v : vertices) points.push_back(agvd::point_at(surface, v));
        num_simplified += agvd::simplify(surface, faces, points).extra.empty() ? 0 : 1;
        const agvd::SimplifiedMesh mesh = remesh::simplify_patch(surface, faces, points);
        num_left += mesh.extra.empty() ? 0 : 1;
        const remesh::Topology topology = remesh::analyze_topology(
            agvd::TriangleMesh{std::vector<agvd::Vec3>(8 + mesh.extra.size()), mesh.triangles}
                .view());
        EXPECT_TRUE(topology.is_manifold) << seed;
        EXPECT_EQ(topology.genus(), 1) << seed;
    }
    EXPECT_GT(num_simplified, 20);
    EXPECT_LE(num_left, 2);
}
