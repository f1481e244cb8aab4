// Triangles that are proved to be near a surface, or not.
#include "remesh/placement/far_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/shapes.h"

using namespace agvd;
using remesh::detail::FarPoint;
using remesh::detail::find_far;
using remesh::detail::find_far_faces;

namespace {

std::optional<FarPoint> far_of(const std::array<Vec3, 3>& triangle, const TriangleMesh& mesh,
                               double limit) {
    const Progress none;
    Poller poller(none);
    Ticker ticker(poller);
    const ClosestPointTree tree(mesh.view());
    return find_far(triangle, {mesh.view(), tree}, limit, ticker);
}

// A roof over the unit square: its ridge, at y = 1/2, is 1/2 high.
TriangleMesh roof() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 0.5, 0.5}, {1, 0.5, 0.5}, {0, 1, 0}, {1, 1, 0}},
            {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}}};
}

}  // namespace

TEST(FarPoints, TheLargestDistanceDecidesWhereverItIs) {
    // Below the ridge the base is .5 / sqrt(2) from the slopes, and nowhere farther.
    const std::array<Vec3, 3> base{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1, 0)};
    const double largest = 0.5 / std::sqrt(2.0);
    EXPECT_FALSE(far_of(base, roof(), 1.03 * largest));
    const auto far = far_of(base, roof(), 0.99 * largest);
    ASSERT_TRUE(far);
    EXPECT_GT(std::sqrt(far->nearest.distance_sq), 0.98 * 0.99 * largest);
    EXPECT_NEAR((far->at - far->nearest.position).norm(), std::sqrt(far->nearest.distance_sq),
                1e-12);
    EXPECT_NEAR(far->at.y(), 0.5, 0.1);
}

TEST(FarPoints, EqualPlanesAreProvedForAnyLimit) {
    const std::array<Vec3, 3> triangle{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    for (const double limit : {1e-1, 1e-4, 1e-7}) {
        EXPECT_FALSE(far_of(triangle, shapes::grid(7), limit)) << limit;
    }
}

TEST(FarPoints, APartBeyondTheEndOfTheSurfaceIsFar) {
    const std::array<Vec3, 3> triangle{Vec3(0.2, 0.2, 0), Vec3(1.5, 0.4, 0), Vec3(0.2, 0.6, 0)};
    EXPECT_TRUE(far_of(triangle, shapes::grid(3), 0.49));
    EXPECT_FALSE(far_of(triangle, shapes::grid(3), 0.51));
}

TEST(FarPoints, OfAMeshThoseFacesAreTold) {
    TriangleMesh bent = shapes::grid(4);
    bent.positions[5].z() = 0.3;
    const TriangleMesh flat = shapes::grid(4);
    const ClosestPointTree tree(flat.view());
    const Progress none;
    Poller poller(none);
    for (const int threads : {1, 3}) {
        const auto far = find_far_faces(bent.view(), {flat.view(), tree}, 0.2, threads, poller);
        std::size_t count = 0;
        for (const Triangle& t : bent.triangles) count += t[0] == 5 || t[1] == 5 || t[2] == 5;
        ASSERT_EQ(far.size(), count);
        for (const auto& [face, point] : far) {
            const Triangle& t = bent.triangles[face];
            EXPECT_TRUE(t[0] == 5 || t[1] == 5 || t[2] == 5);
            EXPECT_GT(point.at.z(), 0.98 * 0.2);
        }
    }
}
