// What moves onto the boundary, on strips with few sites.
#include "remesh/dual/closed_ball.h"

#include <gtest/gtest.h>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;

namespace {

// The vertices of the unit square's 8 x 8 grid, by column and row.
constexpr Index vertex(Index x, Index y) { return 9 * x + y; }

struct Square {
    Surface surface = agvd::build_surface(shapes::grid(8).view());
    std::vector<Index> corners{vertex(0, 0), vertex(0, 8), vertex(8, 0), vertex(8, 8)};

    [[nodiscard]] remesh::BoundaryFixes fixes(const std::vector<Index>& at) const {
        std::vector<SurfacePoint> sites;
        for (const Index v : at) sites.push_back(agvd::point_at(surface, v));
        const agvd::Diagram diagram =
            build_diagram(surface, sites, propagate(surface, sites, {.max_error = 0}));
        return remesh::find_boundary_fixes(surface, diagram, sites, corners);
    }
    [[nodiscard]] Vec3 place(const SurfacePoint& point) const {
        return position(surface.mesh.view(), point);
    }
};

TEST(BoundaryCells, OfSeveralCornersInACellOneGetsItsSiteAndTheOthersNewOnes) {
    const Square square;
    const remesh::BoundaryFixes fixes = square.fixes({vertex(4, 4)});
    ASSERT_EQ(fixes.moved.size(), 1u);
    EXPECT_EQ(fixes.moved[0].first, 0u);
    EXPECT_EQ(square.place(fixes.moved[0].second), Vec3(0, 0, 0));
    ASSERT_EQ(fixes.added.size(), 3u);
    EXPECT_EQ(square.place(fixes.added[0]), Vec3(0, 1, 0));
    EXPECT_EQ(square.place(fixes.added[1]), Vec3(1, 0, 0));
    EXPECT_EQ(square.place(fixes.added[2]), Vec3(1, 1, 0));
}

TEST(BoundaryCells, ASiteAtACornerStaysThereAndTheOtherCornersOfItsCellGetNewOnes) {
    const Square square;
    const remesh::BoundaryFixes fixes = square.fixes({vertex(8, 0)});
    EXPECT_TRUE(fixes.moved.empty());
    ASSERT_EQ(fixes.added.size(), 3u);
    EXPECT_EQ(square.place(fixes.added[0]), Vec3(0, 0, 0));
}

TEST(BoundaryCells, AnInnerSiteMovesToTheMiddleOfItsLongestArc) {
    // The cell of the site in the middle is a band from y = 0 to y = 1; the lower part of it is
    // wider, since the others stand nearer to its upper end.
    Square square;
    square.corners.clear();
    const remesh::BoundaryFixes fixes = square.fixes({vertex(0, 8), vertex(4, 4), vertex(8, 8)});
    ASSERT_EQ(fixes.moved.size(), 1u);
    EXPECT_EQ(fixes.moved[0].first, 1u);
    EXPECT_NEAR((square.place(fixes.moved[0].second) - Vec3(0.5, 0, 0)).norm(), 0, 1e-9);
    EXPECT_TRUE(fixes.added.empty());
}

}  // namespace
