#include "agvd/mesh/uniform_points.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

using namespace agvd;

// One corner of a square is refined a lot; its quarter still gets a quarter of the points, and the
// points' mean is the square's middle.
TEST(UniformPoints, AreSpreadByAreaNotByFaces) {
    TriangleMesh mesh = shapes::grid(8);
    for (Vec3& p : mesh.positions) p = Vec3(p.x() * p.x(), p.y() * p.y(), 0);
    const Surface s = build_surface(mesh.view());
    constexpr Index count = 40000;
    const auto points = uniform_points(s, count, 3);
    ASSERT_EQ(points.size(), count);
    Index in_quarter = 0;
    Vec3 mean(0, 0, 0);
    for (const auto& point : points) {
        const Vec3 p = position(s.mesh.view(), point);
        in_quarter += p.x() < 0.5 && p.y() < 0.5;
        mean += p / count;
        for (const double b : point.barycentric) ASSERT_GE(b, 0);
    }
    EXPECT_NEAR(in_quarter / static_cast<double>(count), 0.25, 0.01);
    EXPECT_NEAR(mean.x(), 0.5, 0.01);
    EXPECT_NEAR(mean.y(), 0.5, 0.01);
}

TEST(UniformPoints, FewerPointsAreTheFirstOfMore) {
    const Surface s = build_surface(shapes::sphere(1).view());
    const auto few = uniform_points(s, 5, 9);
    const auto many = uniform_points(s, 50, 9);
    for (std::size_t i = 0; i < few.size(); ++i) {
        EXPECT_EQ(few[i].face, many[i].face);
        EXPECT_EQ(few[i].barycentric, many[i].barycentric);
    }
    EXPECT_NE(many[0].barycentric, uniform_points(s, 1, 10)[0].barycentric);
}
