#include "remesh/quality/evaluate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using Pairs = std::vector<std::pair<Index, Index>>;

namespace {

Pairs pairs_of(const TriangleMesh& mesh, int num_threads = 2) {
    return remesh::find_self_intersections(mesh.view(), num_threads).value();
}

TriangleMesh overlapping_spheres() {
    TriangleMesh other = shapes::sphere(3);
    for (agvd::Vec3& p : other.positions) p += agvd::Vec3(0.7, 0.2, 0.1);
    return shapes::join(shapes::sphere(3), other);
}

}  // namespace

TEST(SelfIntersections, EmbeddedSurfacesHaveNone) {
    for (const TriangleMesh& mesh : {shapes::cube(), shapes::grid(6), shapes::torus(12, 9),
                                     shapes::tube(9, 4), shapes::sphere(2)}) {
        EXPECT_EQ(pairs_of(mesh), Pairs{});
    }
}

TEST(SelfIntersections, FacesThatShareNothingMayNotTouch) {
    TriangleMesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {9, 9, 1}},
                      {{0, 1, 2}, {3, 4, 5}}};
    EXPECT_EQ(pairs_of(mesh), (Pairs{{0, 1}}));
    mesh.positions[3].z() = 0;
    EXPECT_EQ(pairs_of(mesh), (Pairs{{0, 1}})) << "a corner touches the other face";
    mesh.positions[3].z() = 1e-300;
    EXPECT_EQ(pairs_of(mesh), Pairs{});
}

TEST(SelfIntersections, FacesThatShareACornerMayMeetThereOnly) {
    TriangleMesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 1, -1}, {1, 1, 1}},
                      {{1, 2, 0}, {3, 0, 4}}};
    EXPECT_EQ(pairs_of(mesh), (Pairs{{0, 1}}));
    std::swap(mesh.triangles[0], mesh.triangles[1]);
    EXPECT_EQ(pairs_of(mesh), (Pairs{{0, 1}})) << "whichever pierces the other";
    mesh.positions[3] = {-2, -1, -1};
    EXPECT_EQ(pairs_of(mesh), Pairs{});
}

TEST(SelfIntersections, FacesThatShareAnEdgeMayNotFoldFlat) {
    TriangleMesh mesh{{{0, 0, 0}, {4, 0, 0}, {1, 2, 0}, {2, 3, 0}}, {{0, 1, 2}, {3, 1, 0}}};
    EXPECT_EQ(pairs_of(mesh), (Pairs{{0, 1}}));
    mesh.positions[3].z() = 1e-300;
    EXPECT_EQ(pairs_of(mesh), Pairs{});
    mesh.positions[3] = {2, -3, 0};
    EXPECT_EQ(pairs_of(mesh), Pairs{});
}

TEST(SelfIntersections, FacesWithTheSameCornersCount) {
    const TriangleMesh mesh{{{0, 0, 0}, {4, 0, 0}, {1, 2, 0}}, {{0, 1, 2}, {2, 1, 0}}};
    EXPECT_EQ(pairs_of(mesh), (Pairs{{0, 1}}));
}

TEST(SelfIntersections, FacesWithoutAreaArePassedOver) {
    TriangleMesh mesh = shapes::cube();
    mesh.triangles.push_back({0, 7, 7});  // Runs through the cube.
    EXPECT_EQ(pairs_of(mesh), Pairs{});
}

TEST(SelfIntersections, OverlappingSpheresMeetInPairsOfBoth) {
    const Pairs pairs = pairs_of(overlapping_spheres());
    EXPECT_GT(pairs.size(), 50u);
    const auto half = static_cast<Index>(shapes::sphere(3).triangles.size());
    for (const auto& [a, b] : pairs) {
        EXPECT_LT(a, half);
        EXPECT_GE(b, half);
    }
    EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
}

// More pairs than are tested at a time.
TEST(SelfIntersections, AHundredThousandPairsAreAllFoundAndInOrder) {
    constexpr Index count = 500;
    TriangleMesh mesh;
    for (Index i = 0; i < count; ++i) {
        const double angle = std::numbers::pi * i / count;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), -1);
        mesh.positions.emplace_back(-std::cos(angle), -std::sin(angle), -1);
        mesh.positions.emplace_back(0, 0, 2);
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const Pairs pairs = pairs_of(mesh);
    EXPECT_EQ(pairs.size(), count * (count - 1) / 2);
    EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
    EXPECT_EQ(std::adjacent_find(pairs.begin(), pairs.end()), pairs.end());
}

TEST(SelfIntersections, ThreadsDoNotMatter) {
    const TriangleMesh mesh = overlapping_spheres();
    const Pairs one = pairs_of(mesh, 1);
    EXPECT_EQ(one, pairs_of(mesh, 2));
    EXPECT_EQ(one, pairs_of(mesh, 8));
}
