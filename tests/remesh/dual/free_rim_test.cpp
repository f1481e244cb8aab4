#include "remesh/dual/reduce_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "agvd/mesh/surface_points.h"
#include "remesh/curves/glue.h"

using agvd::Index;

// Vertex 4 lies on the boundary between 0 and 1. An inner edge joins these, so that 4 cannot go
// before the edge is flipped.
TEST(FreeRim, AnEdgeThatIsInTheWayIsFlipped) {
    const agvd::TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, 0.5, 0}, {1, -0.1, 0}},
                                  {{0, 4, 3}, {4, 1, 3}, {3, 1, 0}, {0, 1, 2}}};
    const agvd::Surface surface = agvd::build_surface(mesh.view());
    std::vector<agvd::SurfacePoint> points;
    for (Index v = 0; v < 4; ++v) points.push_back(agvd::point_at(surface, v));
    agvd::SimplifiedMesh patch{mesh.triangles, {agvd::point_at(surface, 4)}};
    remesh::free_rim(surface, points, patch);
    EXPECT_TRUE(patch.extra.empty());
    const std::vector<remesh::DirectedEdge> rim{{0, 1}, {1, 2}, {2, 0}};
    EXPECT_EQ(remesh::rim_of(patch.triangles), rim);
    EXPECT_EQ(patch.triangles.size(), 3u);
}

// Vertex 2 is inside: it stays, under another number.
TEST(FreeRim, InnerVerticesStay) {
    const agvd::TriangleMesh mesh{{{0, 0, 0}, {4, 0, 0}, {2, 1, 0}, {2, 4, 0}, {2, 0, 0}},
                                  {{0, 4, 2}, {4, 1, 2}, {1, 3, 2}, {3, 0, 2}}};
    const agvd::Surface surface = agvd::build_surface(mesh.view());
    const auto at = [&](Index v) { return agvd::point_at(surface, v); };
    const std::vector<agvd::SurfacePoint> points{at(0), at(1), at(3)};
    // 0, 1 and 3 are points; 4 and 2 are extra.
    agvd::SimplifiedMesh patch{{{0, 3, 4}, {3, 1, 4}, {1, 2, 4}, {2, 0, 4}}, {at(4), at(2)}};
    remesh::free_rim(surface, points, patch);
    ASSERT_EQ(patch.extra.size(), 1u);
    EXPECT_EQ(patch.extra.front(), at(2));
    const std::vector<remesh::DirectedEdge> rim{{0, 1}, {1, 2}, {2, 0}};
    EXPECT_EQ(remesh::rim_of(patch.triangles), rim);
}
