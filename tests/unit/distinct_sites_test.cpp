#include "remesh/repair/distinct_sites.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

using agvd::FaceId;
using agvd::Index;
using agvd::SurfacePoint;

TEST(DistinctSites, KeepsTheFirstOfThoseOnOneSpot) {
    const agvd::Surface surface = agvd::build_surface(shapes::grid(2).view());
    Index inner = 0;  // A half-edge with a face on both sides.
    while (surface.twin[inner] == agvd::no_index) ++inner;
    const auto on_edge = [&](Index h, double ahead) {
        SurfacePoint point{FaceId(agvd::Surface::face(h)), {0, 0, 0}};
        point.barycentric[h % 3] = 1 - ahead;
        point.barycentric[agvd::Surface::next(h) % 3] = ahead;
        return point;
    };
    const Index twin = surface.twin[inner];
    const std::vector<SurfacePoint> sites{
        {FaceId(3), {0.5, 0.25, 0.25}}, on_edge(inner, 0.25), on_edge(inner, 0),
        {FaceId(3), {0.25, 0.5, 0.25}}, on_edge(twin, 0.75),  on_edge(twin, 1),
        {FaceId(2), {0.5, 0.25, 0.25}}, on_edge(twin, 0.25),  {FaceId(3), {0.5, 0.25, 0.25}}};
    const auto left = remesh::distinct_sites(surface, sites);
    const std::vector<std::size_t> expected{0, 1, 2, 3, 6, 7};
    ASSERT_EQ(left.size(), expected.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
        EXPECT_EQ(left[i].face, sites[expected[i]].face) << i;
        EXPECT_EQ(left[i].barycentric, sites[expected[i]].barycentric) << i;
    }
}

TEST(DistinctSites, PartsAtOnePositionStayApart) {
    const agvd::TriangleMesh sheet = shapes::grid(1);
    const agvd::Surface surface = agvd::build_surface(shapes::join(sheet, sheet).view());
    const std::vector<SurfacePoint> sites{{FaceId(0), {1, 0, 0}}, {FaceId(2), {1, 0, 0}}};
    EXPECT_EQ(remesh::distinct_sites(surface, sites).size(), 2u);
    EXPECT_TRUE(remesh::distinct_sites(surface, {}).empty());
}
