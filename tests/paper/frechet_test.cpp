#include "paper/frechet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace agvd;

namespace {

// `count` points of a circle of this radius around the z axis, counter-clockwise from `turn`.
std::vector<Vec3> circle(Index count, double radius, double turn = 0) {
    std::vector<Vec3> points;
    for (Index i = 0; i < count; ++i) {
        const double angle = turn + 2 * std::numbers::pi * i / count;
        points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    return points;
}

std::vector<Vec3> moved(std::vector<Vec3> points, const Vec3& by) {
    for (Vec3& p : points) p += by;
    return points;
}

TEST(Frechet, OfParallelSegmentsIsTheirDistance) {
    const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    EXPECT_EQ(frechet_distance(p, moved(p, {0, 0.25, 0})), 0.25);
}

TEST(Frechet, WalksForwardOnly) {
    // There and back again against straight on: Hausdorff sees no difference worth 1.
    const std::vector<Vec3> straight{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    const std::vector<Vec3> detour{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0},
                                   {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    EXPECT_EQ(hausdorff_distance(straight, detour), 0);
    EXPECT_EQ(frechet_distance(straight, detour), 1);
    std::vector<Vec3> back = straight;
    std::reverse(back.begin(), back.end());
    EXPECT_EQ(frechet_distance(straight, back), 3);
}

TEST(Frechet, OfOnePointIsItsDistanceFromTheFarthest) {
    const std::vector<Vec3> p{{0, 0, 0}}, q{{1, 0, 0}, {0, 5, 0}, {2, 0, 0}};
    EXPECT_EQ(frechet_distance(p, q), 5);
    EXPECT_NEAR(closed_frechet_distance(p, q), 5, 1e-6);
    EXPECT_NEAR(closed_frechet_distance(q, p), 5, 1e-6);
}

TEST(ClosedFrechet, OfConcentricCirclesIsTheDifferenceOfTheirRadii) {
    EXPECT_NEAR(closed_frechet_distance(circle(500, 1), circle(500, 1.125)), 0.125, 1e-12);
    EXPECT_NEAR(closed_frechet_distance(circle(500, 1), moved(circle(500, 1), {0, 0, 0.5})), 0.5,
                1e-12);
}

TEST(ClosedFrechet, FindsTheBestStartingPoint) {
    const std::vector<Vec3> p = circle(360, 1);
    for (const std::ptrdiff_t start : {1, 90, 180, 359}) {
        std::vector<Vec3> q = p;
        std::rotate(q.begin(), q.begin() + start, q.end());
        EXPECT_EQ(closed_frechet_distance(p, q), 0) << start;
    }
    // Half a step apart at best.
    const double half = 2 * std::sin(std::numbers::pi / 720);
    EXPECT_NEAR(closed_frechet_distance(p, circle(360, 1, 115.5 * std::numbers::pi / 180)), half,
                1e-7);
}

TEST(ClosedFrechet, ReversedLoopsAreFar) {
    std::vector<Vec3> back = circle(360, 1);
    std::reverse(back.begin(), back.end());
    EXPECT_EQ(hausdorff_distance(circle(360, 1), back), 0);
    // Going round against each other, they are opposite at some time.
    EXPECT_NEAR(closed_frechet_distance(circle(360, 1), back), 2, 1e-2);
}

TEST(ClosedFrechet, KnowsASpikeOfOneLoop) {
    std::vector<Vec3> spiked = circle(360, 1);
    spiked[100] *= 1.5;
    EXPECT_NEAR(closed_frechet_distance(circle(360, 1), spiked), 0.5, 1e-12);
    EXPECT_NEAR(closed_frechet_distance(spiked, circle(360, 1, 3)), 0.5, 1e-3);
}

TEST(Resampled, PointsLieAtEqualLengthsFromTheStart) {
    const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(closed_length(square), 4);
    const auto points = resampled(square, 8);
    ASSERT_EQ(points.size(), 8u);
    EXPECT_EQ(points[0], Vec3(0, 0, 0));
    EXPECT_EQ(points[1], Vec3(0.5, 0, 0));
    EXPECT_EQ(points[7], Vec3(0, 0.5, 0));
    const auto later = resampled(square, 4, 3.5);
    EXPECT_EQ(later[0], Vec3(0, 0.5, 0));
    EXPECT_EQ(later[1], Vec3(0.5, 0, 0));
    EXPECT_EQ(later[3], Vec3(0.5, 1, 0));
}

TEST(Resampled, ALoopWithoutLengthStaysWhereItIs) {
    const std::vector<Vec3> point{{1, 2, 3}, {1, 2, 3}};
    EXPECT_EQ(resampled(point, 3), std::vector<Vec3>(3, Vec3(1, 2, 3)));
}

TEST(NearestOnLoop, SeesTheClosingSegmentToo) {
    const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(nearest_on_loop(square, {0.75, -1, 0}), 0.75);
    EXPECT_EQ(nearest_on_loop(square, {-0.5, 0.25, 0}), 3.75);
}

}  // namespace
