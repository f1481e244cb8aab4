#include "agvd/diagram/bisectors.h"

#include <gtest/gtest.h>

#include <array>
#include <span>

using namespace agvd;

namespace {

// Three sites in a row; that in the middle has a detour of 0.5. Two points are 1.25 away from all:
// (0, 0.75) and (0, -0.75).
class SitesInARow : public testing::Test {
protected:
    std::array<PlanarRelay, 3> relays_{point_relay({-1, 0}, 0, 0), point_relay({0, 0}, 0.5, 1),
                                       point_relay({1, 0}, 0, 2)};
    TriangleSites triangle_{.corners = {Vec2(-5, -3), Vec2(5, -3), Vec2(0, 5)},
                            .size = 10,
                            .groups = {{0, std::span(relays_).subspan(0, 1)},
                                       {1, std::span(relays_).subspan(1, 1)},
                                       {2, std::span(relays_).subspan(2, 1)}}};
};

// The centroid of the intervals leads to the upper point, the middle of the last two to the lower.
TEST_F(SitesInARow, OfTwoPointsThatWithTheSitesCounterClockwiseCounts) {
    const Vec2 above(0, 3.2), below(0, -1);
    for (const bool is_thorough : {false, true}) {
        const VertexCandidate lower = find_voronoi_vertex(
            triangle_, {IntervalStart{above, 2}, {below, 1}, {below, 0}}, is_thorough);
        EXPECT_NEAR((lower.position - Vec2(0, -0.75)).norm(), 0, 1e-9);
        EXPECT_NEAR(lower.distance, 1.25, 1e-9);
        EXPECT_EQ(lower.violation, 0);
        const VertexCandidate upper = find_voronoi_vertex(
            triangle_, {IntervalStart{above, 0}, {below, 1}, {below, 2}}, is_thorough);
        EXPECT_NEAR((upper.position - Vec2(0, 0.75)).norm(), 0, 1e-9);
        EXPECT_NEAR(upper.distance, 1.25, 1e-9);
    }
}

TEST_F(SitesInARow, ANearerSiteIsAViolation) {
    const std::array nearer{point_relay({0, 1}, 0, 3)};
    triangle_.groups.push_back({3, nearer});
    const VertexCandidate place =
        find_voronoi_vertex(triangle_, {IntervalStart{{-1, 1}, 0}, {{0, 1}, 1}, {{1, 1}, 2}}, true);
    EXPECT_NEAR((place.position - Vec2(0, 0.75)).norm(), 0, 1e-9);
    EXPECT_NEAR(place.violation, 1, 1e-9);  // 1.25 away from three sites, 0.25 from the fourth.
}

}  // namespace
