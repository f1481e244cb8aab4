#include "support/arbiter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agvd/mesh/surface_points.h"
#include "paper/oracle.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

TEST(Arbiter, PlaneHasEuclideanDistances) {
    const Surface s = build_surface(shapes::grid(9).view());
    const auto places = points::scattered(s, 80, 1);
    const auto& mesh = s.mesh;
    for (Index i = 0; i < 12; ++i) {
        const auto found = arbiter::nearest_sites(s, {&places[i], 1}, places);
        for (Index j = 0; j < places.size(); ++j) {
            const Vec3 gap = position(mesh.view(), places[i]) - position(mesh.view(), places[j]);
            EXPECT_NEAR(static_cast<double>(found.distance[j]), gap.norm(), 1e-15);
            EXPECT_EQ(found.site[j], SiteId(0));
        }
    }
}

// Opposite corners of the unit cube; and around a slit, whose tip is a reflex corner.
TEST(Arbiter, PathsTurnOverEdgesAndAroundCorners) {
    const Surface cube = build_surface(shapes::cube().view());
    const auto corner = point_at(cube, 0), opposite = point_at(cube, 7);
    EXPECT_NEAR(
        static_cast<double>(arbiter::nearest_sites(cube, {&corner, 1}, {&opposite, 1}).distance[0]),
        std::sqrt(5.0), 1e-15);

    TriangleMesh slit = shapes::grid(20);
    std::erase_if(slit.triangles, [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](Index v) {
            const Vec3& p = slit.positions[v];
            return p.x() > 0.49 && p.x() < 0.56 && p.y() > 0.04;
        });
    });
    const Surface s = build_surface(slit.view());
    const auto here = point_at(s, 8 * 21 + 16), there = point_at(s, 12 * 21 + 16);
    const double around = std::hypot(0.1, 0.75) + 0.05 + std::hypot(0.05, 0.75);
    EXPECT_NEAR(static_cast<double>(arbiter::nearest_sites(s, {&here, 1}, {&there, 1}).distance[0]),
                around, 1e-15);
}

// Where nothing lies in line, CGAL makes no mistakes.
TEST(Arbiter, AgreesWithTheOracleOnIrregularMeshes) {
    for (const TriangleMesh& mesh :
         {shapes::jitter(shapes::sphere(3), 0.05, 3),
          shapes::jitter(shapes::torus(24, 12), 0.03, 4),
          shapes::jitter(shapes::tube(12, 6), 0.05, 5), shapes::jitter(shapes::grid(12), 0.03, 6),
          shapes::join(shapes::jitter(shapes::sphere(2), 0.1, 7), shapes::cube())}) {
        const Surface s = build_surface(mesh.view());
        const auto sites = points::scattered(s, 7, 2);
        const auto targets = points::scattered(s, 300, 3);
        const NearestSites exact = exact_nearest_sites(s, sites, targets);
        const auto found = arbiter::nearest_sites(s, sites, targets);
        for (Index i = 0; i < targets.size(); ++i) {
            const auto distance = static_cast<double>(found.distance[i]);
            if (std::isinf(exact.distance[i])) {
                EXPECT_TRUE(std::isinf(distance));
                EXPECT_FALSE(found.site[i].is_valid());
                continue;
            }
            EXPECT_NEAR(distance, exact.distance[i], 1e-13);
            EXPECT_EQ(found.site[i], exact.site[i]);
        }
    }
}
