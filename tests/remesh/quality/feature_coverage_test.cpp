// How well sharp edges are kept, on shapes where that is known.
#include "remesh/quality/evaluate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/parts.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::FeatureCoverage;

namespace {

FeatureCoverage coverage(const TriangleMesh& original, const TriangleMesh& result) {
    const auto measured = remesh::feature_coverage(original.view(), result.view());
    return measured.value_or(FeatureCoverage{.covered = std::nan("")});
}

// A convex polygon in the plane z = 0, extruded to z = 1.
TriangleMesh prism(const std::vector<Vec3>& polygon) {
    TriangleMesh mesh{polygon, {}};
    const auto n = static_cast<Index>(polygon.size());
    for (const Vec3& p : polygon) mesh.positions.push_back(p + Vec3(0, 0, 1));
    for (Index i = 0; i < n; ++i) {
        const Index j = (i + 1) % n;
        mesh.triangles.push_back({i, j, n + j});
        mesh.triangles.push_back({i, n + j, n + i});
        if (i == 0 || j == 0) continue;
        mesh.triangles.push_back({0, j, i});
        mesh.triangles.push_back({n, n + i, n + j});
    }
    return mesh;
}

// Of a unit cube.
const double diagonal = std::numbers::sqrt3;

}  // namespace

TEST(FeatureCoverage, CubeCoversItself) {
    for (const TriangleMesh& result :
         {shapes::cube(), shapes::subdivide(shapes::subdivide(shapes::cube()))}) {
        const FeatureCoverage c = coverage(shapes::cube(), result);
        EXPECT_NEAR(c.length, 12, 1e-12);
        EXPECT_NEAR(c.result_length, 12, 1e-12);
        EXPECT_EQ(c.covered, 1);
        EXPECT_EQ(c.covered_closely, 1);
        EXPECT_EQ(c.false_share, 0);
        EXPECT_EQ(c.corners, 8u);
        EXPECT_EQ(c.corners_kept, 8u);
        EXPECT_NEAR(c.diagonal, diagonal, 1e-12);
    }
}

TEST(FeatureCoverage, BevelLosesAnEdgeAndMakesTwo) {
    const TriangleMesh cube = prism({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const double d = 0.1;
    const TriangleMesh bevelled =
        prism({{0, 0, 0}, {1, 0, 0}, {1, 1 - d, 0}, {1 - d, 1, 0}, {0, 1, 0}});
    const FeatureCoverage c = coverage(cube, bevelled);
    // The edge itself and what is cut off the four edges beside it, up to where they end.
    const double near = 1e-3 * diagonal, very_near = 2e-4 * diagonal;
    EXPECT_NEAR(c.length, 12, 1e-12);
    EXPECT_NEAR(c.covered, 1 - (1 + 4 * (d - near)) / 12, 3e-4);
    EXPECT_NEAR(c.covered_closely, 1 - (1 + 4 * (d - very_near)) / 12, 3e-4);
    const double slant = d * std::numbers::sqrt2;
    EXPECT_NEAR(c.result_length, 11 - 4 * d + 2 + 2 * slant, 1e-12);
    // Both edges of the bevel but their ends, and its short sides but for where they start.
    const double beside = near * std::numbers::sqrt2;
    EXPECT_NEAR(c.false_share * c.result_length, 2 * (1 - 2 * near) + 2 * (slant - 2 * beside),
                3e-3);
    EXPECT_EQ(c.corners, 8u);
    EXPECT_EQ(c.corners_kept, 6u);
}

TEST(FeatureCoverage, MovedByLittleIsCoveredButNotClosely) {
    for (const double percent : {0.01, 0.04, 0.2}) {
        const Vec3 by = Vec3(1, 1, 1) * percent / 100;  // In diagonals.
        const FeatureCoverage c = coverage(shapes::cube(), shapes::moved(shapes::cube(), by));
        EXPECT_EQ(c.covered_closely, percent < 0.02 ? 1 : 0);
        // Nearest is the same edge, sqrt(2/3) of the way.
        EXPECT_NEAR(c.covered, percent < 0.1 ? 1 : 0, 0.01);
        EXPECT_NEAR(c.false_share, percent < 0.1 ? 0 : 1, 0.01);
        EXPECT_EQ(c.corners_kept, percent < 0.05 ? 8u : 0u);
    }
}

TEST(FeatureCoverage, BluntEdgesCoverSharpOnesAndAreNotFalse) {
    const auto fold = [](double degrees) {
        return parts::folded_plate(16, 2, 1, [=](double) { return degrees; });
    };
    EXPECT_EQ(coverage(fold(50), fold(30)).covered, 1);
    EXPECT_EQ(coverage(fold(50), fold(30)).result_length, 0);
    EXPECT_EQ(coverage(fold(50), fold(20)).covered, 0);
    EXPECT_EQ(coverage(fold(30), fold(50)).length, 0);
    EXPECT_EQ(coverage(fold(30), fold(50)).false_share, 0);
    // But where the fold ends on the original's boundary.
    EXPECT_NEAR(coverage(fold(20), fold(50)).false_share, 1, 0.003);
}

TEST(FeatureCoverage, BoundaryIsNoSharpEdgeButHasCorners) {
    const FeatureCoverage c = coverage(shapes::grid(4), shapes::grid(2));
    EXPECT_EQ(c.length, 0);
    EXPECT_EQ(c.covered, 1);
    EXPECT_EQ(c.corners, 4u);
    EXPECT_EQ(c.corners_kept, 4u);
}

TEST(FeatureCoverage, SmoothSurfacesHaveNothingToCover) {
    EXPECT_FALSE(
        remesh::feature_coverage(shapes::sphere(3).view(), shapes::cube().view()).has_value());
}

TEST(FeatureCoverage, WindingAndCopiesDoNotMatter) {
    TriangleMesh cube = shapes::subdivide(shapes::cube());
    for (Index f = 0; f < cube.triangles.size(); f += 2) {
        std::swap(cube.triangles[f][0], cube.triangles[f][1]);
    }
    TriangleMesh soup;
    for (const Triangle& t : cube.triangles) {
        const auto first = static_cast<Index>(soup.positions.size());
        for (const Index v : t) soup.positions.push_back(cube.positions[v]);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    soup.triangles.push_back(soup.triangles[0]);
    for (const TriangleMesh& original : {cube, soup}) {
        const FeatureCoverage c = coverage(original, shapes::cube());
        EXPECT_NEAR(c.length, 12, 1e-12);
        EXPECT_EQ(c.covered_closely, 1);
        EXPECT_EQ(c.corners, 8u);
        const FeatureCoverage r = coverage(shapes::cube(), original);
        EXPECT_NEAR(r.result_length, 12, 1e-12);
        EXPECT_EQ(r.false_share, 0);
    }
}

TEST(FeatureCoverage, SliversMakeNoSharpEdges) {
    // A square whose diagonal has a cap beside it, so low that its normal is off by 63 degrees.
    const TriangleMesh square{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5 - 1e-9, 0.5 + 1e-9, 3e-9}},
        {{0, 1, 2}, {0, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
    EXPECT_EQ(coverage(square, square).length, 0);
    TriangleMesh turned = square;
    std::swap(turned.triangles[1][0], turned.triangles[1][1]);
    EXPECT_EQ(coverage(turned, turned).length, 0);
    TriangleMesh high = square;
    high.positions[4] += Vec3(-1e-4, 1e-4, 3e-4);
    EXPECT_GT(coverage(high, high).length, 1);
}

TEST(FeatureCoverage, EdgesOfThreeSheetsAreSharp) {
    const TriangleMesh fan{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}},
                           {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
    const FeatureCoverage c = coverage(fan, fan);
    EXPECT_NEAR(c.length, 1, 1e-12);
    EXPECT_EQ(c.covered_closely, 1);
    EXPECT_EQ(c.false_share, 0);
}

TEST(FeatureCoverage, EdgesThatReachFarBeyondTheOriginalCoverIt) {
    const TriangleMesh fold = parts::folded_plate(16, 2, 1, [](double) { return 90; });
    const double far = 1e9;
    const TriangleMesh large{{{-far, 0, 0}, {far, 0, 0}, {0, far, far}, {0, -far, far}},
                             {{0, 1, 2}, {1, 0, 3}}};
    EXPECT_EQ(coverage(fold, large).covered_closely, 1);
    EXPECT_EQ(coverage(fold, shapes::moved(large, {0, 0, 1})).covered, 0);
}

TEST(FeatureCoverage, ResultFarAwayCoversNothing) {
    TriangleMesh large = shapes::cube();
    for (Vec3& p : large.positions) p = 1e12 * (p - Vec3(0.5, 0.4, 0.3));
    const FeatureCoverage c = coverage(shapes::cube(), large);
    EXPECT_EQ(c.covered, 0);
    EXPECT_EQ(c.false_share, 1);
    EXPECT_EQ(c.corners_kept, 0u);
}

TEST(FeatureCoverage, AcuteCornersAreLeftOutOfTheSmallestAngle) {
    // A wedge of 20 degrees; its other corners have 80.
    const double tip = std::numbers::pi / 9;
    const TriangleMesh wedge = prism({{0, 0, 0}, {1, 0, 0}, {std::cos(tip), std::sin(tip), 0}});
    const FeatureCoverage c = coverage(wedge, wedge);
    EXPECT_EQ(c.corners, 6u);
    EXPECT_EQ(c.acute_corners, 2u);
    // Only halves of the side across from the tip have no corner there: 1 high, 2 sin(tip / 2)
    // wide.
    EXPECT_NEAR(c.min_angle_elsewhere, std::atan(2 * std::sin(tip / 2)), 1e-12);
    const FeatureCoverage cube = coverage(shapes::cube(), shapes::cube());
    EXPECT_EQ(cube.acute_corners, 0u);
    EXPECT_NEAR(cube.min_angle_elsewhere, std::numbers::pi / 4, 1e-12);
}
