#include "remesh/sites/site_dual.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

using namespace agvd;
using remesh::detail::SiteDual;
using remesh::detail::TriangulatedSites;

namespace {

// The corners of a face are the sites 0, 1 and 2.
struct OneTriangle {
    Surface surface = build_surface(shapes::grid(1).view());
    std::vector<SurfacePoint> sites{
        {FaceId(0), {1, 0, 0}}, {FaceId(0), {0, 1, 0}}, {FaceId(0), {0, 0, 1}}};
    SiteDual dual{{{0, 1, 2}},
                  {{0, 1, 2, {FaceId(0), {0.5, 0.5, 0}}},
                   {0, 2, 3, {FaceId(0), {0.5, 0, 0.5}}},
                   {1, 2, 1, {FaceId(0), {0, 0.5, 0.5}}}}};

    [[nodiscard]] TriangulatedSites with(Index count) const {
        return remesh::detail::subdivide(surface, sites, {1, 2, 4}, dual, count).value();
    }
};

TEST(Subdivide, SitesComeBetweenTheFarthestPairsFirst) {
    const OneTriangle scene;
    const TriangulatedSites four = scene.with(4);
    ASSERT_EQ(four.sites.size(), 4u);
    EXPECT_EQ(four.sites[3], scene.dual.middles[1].point);
    EXPECT_EQ(four.weights, (std::vector<double>{1, 2, 4, 2.5}));
    EXPECT_EQ(four.triangles.size(), 2u);
    const TriangulatedSites five = scene.with(5);
    ASSERT_EQ(five.sites.size(), 5u);
    EXPECT_EQ(five.sites[3], scene.dual.middles[0].point);
    EXPECT_EQ(five.sites[4], scene.dual.middles[1].point);
    EXPECT_EQ(five.triangles.size(), 3u);
}

TEST(Subdivide, WithAllMiddlesATriangleGivesFourAndThenTheLargestGetASiteInside) {
    const OneTriangle scene;
    EXPECT_EQ(scene.with(6).triangles,
              (std::vector<Triangle>{{0, 3, 4}, {1, 5, 3}, {2, 4, 5}, {3, 5, 4}}));
    const TriangulatedSites seven = scene.with(7);
    EXPECT_EQ(seven.sites.size(), 7u);
    EXPECT_EQ(seven.triangles.size(), 6u);
    EXPECT_EQ(scene.with(3).triangles, scene.dual.triangles);
    EXPECT_FALSE(remesh::detail::subdivide(scene.surface, scene.sites, {1, 2, 4}, scene.dual, 2));
    EXPECT_FALSE(remesh::detail::subdivide(scene.surface, scene.sites, {1, 2, 4}, scene.dual, 11));
}

}  // namespace
