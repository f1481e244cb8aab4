#include "remesh/sites/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agvd/mesh/surface.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;
using remesh::detail::eliminate;

namespace {

struct Scene {
    Surface surface = build_surface(shapes::grid(1).view());
    std::vector<SurfacePoint> points;

    // At (x, y) of the unit square, inside the face below or above the diagonal.
    void add(double x, double y) {
        for (Index f = 0; f < 2; ++f) {
            const agvd::Triangle& t = surface.mesh.triangles[f];
            const auto& p = surface.mesh.positions;
            const Vec3 at(x, y, 0), u = p[t[1]] - p[t[0]], v = p[t[2]] - p[t[0]], d = at - p[t[0]];
            const double area = u.cross(v).z();
            const double b = d.cross(v).z() / area, c = u.cross(d).z() / area;
            if (b < 0 || c < 0 || b + c > 1) continue;
            points.push_back({agvd::FaceId(f), {1 - b - c, b, c}});
            return;
        }
        FAIL() << "(" << x << ", " << y << ") is not in the square";
    }
    [[nodiscard]] std::vector<Vec3> keep(Index count, Index num_fixed, double spacing,
                                         int num_threads = 1) const {
        std::vector<Vec3> kept;
        for (const SurfacePoint& point :
             eliminate(surface, points, num_fixed, count, spacing, num_threads)) {
            kept.push_back(position(surface.mesh.view(), point));
        }
        return kept;
    }
};

double nearest_pair(const std::vector<Vec3>& points) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            least = std::min(least, (points[i] - points[j]).norm());
        }
    }
    return least;
}

TEST(Eliminate, TakesTheMostCrowdedPointFirst) {
    Scene scene;
    for (const double x : {0.1, 0.5, 0.52, 0.54, 0.9}) scene.add(x, 0.5 * x);
    const std::vector<Vec3> kept = scene.keep(4, 0, 0.2);
    ASSERT_EQ(kept.size(), 4u);
    const std::array<double, 4> wanted{0.1, 0.5, 0.54, 0.9};  // In their old order.
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(kept[i].x(), wanted[i], 1e-12);
}

TEST(Eliminate, OfEqualPointsTheLaterOneGoes) {
    Scene scene;
    for (const double x : {0.1, 0.2, 0.8, 0.9}) scene.add(x, 0.05);
    std::vector<Vec3> kept = scene.keep(3, 0, 0.3);
    ASSERT_EQ(kept.size(), 3u);
    EXPECT_NEAR(kept[2].x(), 0.8, 1e-12);
    kept = scene.keep(2, 0, 0.3);
    ASSERT_EQ(kept.size(), 2u);
    EXPECT_NEAR(kept[0].x(), 0.1, 1e-12);
    EXPECT_NEAR(kept[1].x(), 0.8, 1e-12);
}

TEST(Eliminate, FixedPointsCrowdOthersAndAreNotReturned) {
    Scene scene;
    scene.add(0.5, 0.3);
    scene.add(0.9, 0.3);
    scene.add(0.52, 0.3);  // Fixed.
    const std::vector<Vec3> kept = scene.keep(1, 1, 0.3);
    ASSERT_EQ(kept.size(), 1u);
    EXPECT_NEAR(kept[0].x(), 0.9, 1e-12);
}

// A thin plate: the back looks the other way.
TEST(Eliminate, PointsOnOppositeWallsDoNotCrowdEachOther) {
    agvd::TriangleMesh back = shapes::grid(1);
    for (agvd::Triangle& t : back.triangles) std::swap(t[1], t[2]);
    Scene scene;
    for (const double x : {0.3, 0.34, 0.32}) scene.add(x, 0.05);
    scene.surface = build_surface(shapes::join(shapes::grid(1), back).view());
    scene.points[2].face = agvd::FaceId(scene.points[2].face.value() + 2);
    std::swap(scene.points[2].barycentric[1], scene.points[2].barycentric[2]);
    const std::vector<Vec3> kept = scene.keep(2, 0, 0.2);
    ASSERT_EQ(kept.size(), 2u);
    EXPECT_NEAR(kept[0].x(), 0.3, 1e-12);
    EXPECT_NEAR(kept[1].x(), 0.32, 1e-12);  // On the back.
}

TEST(Eliminate, KeepsAllWhereThatIsAskedFor) {
    Scene scene;
    for (const double x : {0.1, 0.11, 0.12}) scene.add(x, 0.05);
    EXPECT_EQ(scene.keep(3, 0, 0.5).size(), 3u);
}

TEST(Eliminate, SpreadsRandomPointsWhateverTheThreads) {
    Scene scene;
    std::uint64_t state = 1;
    const auto random = [&] {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state >> 40) / (1 << 24);
    };
    for (int i = 0; i < 1000; ++i) {
        const double x = random();
        scene.add(x, random());
    }
    // 200 points packed as densely as can be stand so far apart.
    const double spacing = std::sqrt(2 / std::sqrt(3.0) / 200);
    const std::vector<Vec3> kept = scene.keep(200, 0, spacing);
    ASSERT_EQ(kept.size(), 200u);
    EXPECT_GT(nearest_pair(kept), 0.5 * spacing);
    EXPECT_LE(nearest_pair(kept), spacing);
    EXPECT_EQ(scene.keep(200, 0, spacing, 4), kept);
}

}  // namespace
