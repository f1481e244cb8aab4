#include "remesh/sites/sampling.h"

#include <gtest/gtest.h>

#include "agvd/mesh/surface_points.h"
#include "support/shapes.h"

using agvd::Index;

// Five vertices in a row of needles, and one without faces.
TEST(FarthestVertex, GoesByDistanceAndLeavesOutVerticesWithoutFaces) {
    agvd::TriangleMesh strip{{{9, 9, 9}}, {}};
    for (Index i = 0; i < 5; ++i) {
        strip.positions.emplace_back(i, 0, 0);
        strip.positions.emplace_back(i, 1, 0);
        const Index a = 2 * i - 1;  // Of the column before.
        if (i > 0)
            strip.triangles.insert(strip.triangles.end(), {{a, a + 2, a + 3}, {a, a + 3, a + 1}});
    }
    const agvd::Surface surface = agvd::build_surface(strip.view());
    const agvd::SurfaceLayout layout(surface);
    agvd::BoundsSearch search(surface, layout, 1);
    search.add(agvd::point_at(surface, 1), 0);
    search.run();
    auto farthest = remesh::detail::farthest_vertices(surface, {search});
    EXPECT_EQ(farthest.pop(), 10u);
    EXPECT_EQ(farthest.pop(), 9u);
    // Distances that a new site has lowered count.
    search.add(agvd::point_at(surface, 9), 1);
    search.run();
    EXPECT_EQ(farthest.pop(), 6u);
    Index count = 3;
    for (; !farthest.is_empty(); ++count) EXPECT_NE(farthest.pop(), 0u);
    EXPECT_EQ(count, 10u);
}
