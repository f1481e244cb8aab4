#include "remesh/curves/walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "agvd/core/random.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::SurfacePoint;
using agvd::Vec3;
using remesh::detail::boundary_half_edge;
using remesh::detail::walk_boundary;
using remesh::detail::walk_straight;

namespace {

Vec3 place(const agvd::Surface& surface, const SurfacePoint& point) {
    return agvd::position(surface.mesh.view(), point);
}

}  // namespace

TEST(Walk, InThePlaneItGoesWhereTheStepPoints) {
    const agvd::Surface surface = agvd::build_surface(shapes::grid(17).view());
    const SurfacePoint centre{agvd::FaceId(2 * (17 * 8 + 8)), {0.3, 0.3, 0.4}};
    const Vec3 from = place(surface, centre);
    for (std::uint64_t i = 0; i < 200; ++i) {
        const Vec3 step(agvd::random_unit(1, i, 0) - 0.5, agvd::random_unit(1, i, 1) - 0.5, 0);
        const Vec3 end = place(surface, walk_straight(surface, centre, 0.9 * step).end);
        EXPECT_LT((end - from - 0.9 * step).norm(), 1e-5) << i;
    }
}

TEST(Walk, AroundATubeItComesBack) {
    const Index n = 24;
    const agvd::Surface surface = agvd::build_surface(shapes::tube(n, 7).view());
    const double around = 2 * n * std::sin(std::numbers::pi / n);
    const SurfacePoint start{agvd::FaceId(n * 7), {0.2, 0.5, 0.3}};
    const Vec3 from = place(surface, start);
    const Vec3 along(-from.y(), from.x(), 0);
    const Vec3 end = place(surface, walk_straight(surface, start, around * along.normalized()).end);
    EXPECT_LT((end - from).norm(), 1e-4);
}

TEST(Walk, ItIsCutOffWhereItCirclesWithoutEnd) {
    const agvd::Surface surface = agvd::build_surface(shapes::tube(3, 1).view());
    const SurfacePoint start{agvd::FaceId(0), {0.2, 0.5, 0.3}};
    const Vec3 around = (surface.mesh.positions[2] - surface.mesh.positions[0]).normalized();
    EXPECT_FALSE(walk_straight(surface, start, 1e2 * around).is_cut_off);
    EXPECT_TRUE(walk_straight(surface, start, 1e4 * around).is_cut_off);
}

TEST(Walk, ItCountsTheFacesItEnters) {
    const agvd::Surface surface = agvd::build_surface(shapes::grid(10).view());
    const SurfacePoint start{agvd::FaceId(0), {0.2, 0.5, 0.3}};
    // Along a row each square has two faces.
    for (const int squares : {0, 1, 4, 8}) {
        const auto walk = walk_straight(surface, start, Vec3(0.1 * squares, 0, 0));
        EXPECT_EQ(walk.num_crossings, 2 * squares);
    }
}

TEST(Walk, ItStopsShortOfTheBoundary) {
    const agvd::Surface surface = agvd::build_surface(shapes::grid(5).view());
    const SurfacePoint start{agvd::FaceId(24), {0.3, 0.3, 0.4}};
    for (std::uint64_t i = 0; i < 50; ++i) {
        const double angle = static_cast<double>(i);
        const Vec3 step(5 * std::cos(angle), 5 * std::sin(angle), 0);
        const SurfacePoint end = walk_straight(surface, start, step).end;
        EXPECT_FALSE(boundary_half_edge(surface, end)) << i;
        EXPECT_GT(*std::min_element(end.barycentric.begin(), end.barycentric.end()), 0) << i;
    }
}

TEST(Walk, AStepIntoTheWallGoesNowhere) {
    const agvd::Surface surface = agvd::build_surface(shapes::grid(5).view());
    const SurfacePoint start{agvd::FaceId(24), {0.3, 0.3, 0.4}};
    const SurfacePoint end = walk_straight(surface, start, Vec3(0, 0, 1)).end;
    EXPECT_EQ(end.face, start.face);
    EXPECT_EQ(end.barycentric, start.barycentric);
}

TEST(Walk, OnTheBoundaryItStaysThere) {
    const agvd::Surface surface = agvd::build_surface(shapes::grid(8).view());
    for (Index h = 0; h < surface.twin.size(); ++h) {
        if (surface.twin[h] != agvd::no_index) continue;
        SurfacePoint start{agvd::FaceId(agvd::Surface::face(h)), {0, 0, 0}};
        start.barycentric[h % 3] = 0.25;
        start.barycentric[agvd::Surface::next(h) % 3] = 0.75;
        ASSERT_EQ(boundary_half_edge(surface, start), h);
        const Vec3 axis =
            surface.mesh.positions[surface.head(h)] - surface.mesh.positions[surface.tail(h)];
        for (const double length : {-9.3, -0.3, 0.1, 2.6}) {  // In edges.
            const SurfacePoint end = walk_boundary(surface, start, h, length * axis);
            const auto on = boundary_half_edge(surface, end);
            ASSERT_TRUE(on.has_value());
            // As many edges on as it should be, corners of the square included.
            Index expected = h;
            double along = 0.75 + length;
            for (; along > 1; along -= 1) expected = surface.outgoing[surface.head(expected)];
            for (; along < 0; along += 1) {
                const auto into = [&](Index other) {
                    return surface.twin[other] == agvd::no_index &&
                           surface.head(other) == surface.tail(expected);
                };
                Index before = 0;
                while (!into(before)) ++before;
                expected = before;
            }
            EXPECT_EQ(*on, expected);
            EXPECT_NEAR(end.barycentric[agvd::Surface::next(expected) % 3], along, 1e-9);
        }
    }
}
