#include "remesh/dual/simplify_narrow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "agvd/core/types.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "support/shapes.h"
#include "support/triangle_set.h"

using namespace agvd;
using remesh::detail::simplify_narrow;

namespace {

// The mesh with the vertices that stay first.
TriangleMesh reordered(const TriangleMesh& mesh, const std::set<Index>& gone) {
    std::vector<Index> order, number(mesh.positions.size());
    for (const bool stays : {true, false}) {
        for (Index v = 0; v < mesh.positions.size(); ++v) {
            if (gone.contains(v) != stays) order.push_back(v);
        }
    }
    for (Index i = 0; i < order.size(); ++i) number[order[i]] = i;
    return {take(mesh.positions, order), rename_vertices(mesh.triangles, number)};
}

}  // namespace

TEST(SimplifyNarrow, TrianglesFartherOffStay) {
    const TriangleMesh mesh = reordered(shapes::grid(12), {5 * 13 + 5, 5 * 13 + 6});
    const Index num_sites = 13 * 13 - 2;
    std::vector<Triangle> after = mesh.triangles;
    EXPECT_EQ(simplify_narrow(mesh.positions, num_sites, after, {}), 1u);
    EXPECT_EQ(after.size(), mesh.triangles.size() - 4);
    for (const Triangle& t : after) EXPECT_LT(*std::ranges::max_element(t), num_sites);
    const Topology topology = analyze_topology(MeshView{mesh.positions, after});
    EXPECT_EQ(topology.components.size(), 1u);
    Index num_far = 0;
    const std::set<Triangle> now = triangle_set(after);
    for (const Triangle& t : triangle_set(mesh.triangles)) {
        const bool is_far = std::ranges::all_of(t, [&](Index v) {
            const Vec3 way = mesh.positions[v] - Vec3(5.0 / 12, 5.5 / 12, 0);
            return way.norm() > 1.9 / 12;
        });
        if (!is_far) continue;
        ++num_far;
        EXPECT_TRUE(now.contains(t));
    }
    EXPECT_GT(num_far, 200u);
}

TEST(SimplifyNarrow, PartsFarFromEachOtherAreSimplifiedByThemselves) {
    const TriangleMesh mesh = reordered(shapes::grid(20), {21 * 4 + 4, 21 * 16 + 16, 21 * 16 + 4});
    std::vector<Triangle> after = mesh.triangles;
    EXPECT_EQ(simplify_narrow(mesh.positions, 21 * 21 - 3, after, {}), 3u);
    EXPECT_EQ(after.size(), mesh.triangles.size() - 6);
}

// Of the vertices of a thin torus four rings of three are left.
TEST(SimplifyNarrow, MoreThanTheTrianglesAroundChangeWhereThatIsNeeded) {
    const TriangleMesh torus = shapes::torus(120, 6, 0.05);
    std::set<Index> gone;
    for (Index v = 0; v < torus.positions.size(); ++v) {
        if (v / 6 % 30 != 0 || v % 2 != 0) gone.insert(v);
    }
    const TriangleMesh mesh = reordered(torus, gone);
    std::vector<Triangle> after = mesh.triangles;
    EXPECT_GE(simplify_narrow(mesh.positions, 12, after, {}), 1u);
    EXPECT_EQ(after.size(), 24u);
    const Topology topology =
        analyze_topology(MeshView{std::span(mesh.positions).first(12), after});
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    EXPECT_EQ(topology.genus(), 1);
}

// A torus needs seven vertices.
TEST(SimplifyNarrow, WhatCannotGoStays) {
    const TriangleMesh torus = shapes::torus(12, 8);
    std::set<Index> gone;
    for (Index v = 5; v < torus.positions.size(); ++v) gone.insert(v);
    const TriangleMesh mesh = reordered(torus, gone);
    std::vector<Triangle> after = mesh.triangles;
    EXPECT_EQ(simplify_narrow(mesh.positions, 5, after, {}), 1u);
    const Topology topology = analyze_topology(MeshView{mesh.positions, after});
    EXPECT_EQ(topology.genus(), 1);
    EXPECT_LT(after.size(), mesh.triangles.size());
}

TEST(SimplifyNarrow, WhatIsNoMeshStays) {
    std::vector<Triangle> triangles{{0, 1, 3}, {0, 1, 4}, {0, 1, 2}};
    const std::vector<Triangle> before = triangles;
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}};
    EXPECT_EQ(simplify_narrow(positions, 3, triangles, {}), 0u);
    EXPECT_EQ(triangles, before);
}
