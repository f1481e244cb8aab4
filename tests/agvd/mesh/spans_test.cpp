#include "agvd/mesh/spans.h"

#include <gtest/gtest.h>

#include <array>

using agvd::AdaptedMesh;
using agvd::MeshView;
using agvd::Triangle;
using agvd::Vec3;

namespace {

// Four points and two triangles, however they are given.
void expect_square(const AdaptedMesh& adapted) {
    const MeshView view = adapted;
    const std::vector<Vec3> positions{{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
    EXPECT_TRUE(std::ranges::equal(view.positions, positions));
    EXPECT_TRUE(std::ranges::equal(view.triangles, triangles));
}

TEST(SpanAdapter, NumbersInARowAreAMesh) {
    const std::vector<double> positions{0, 0, 5, 1, 0, 5, 1, 1, 5, 0, 1, 5};
    const std::array<int, 6> corners{0, 1, 2, 0, 2, 3};
    const AdaptedMesh mesh = agvd::from_arrays(positions, corners);
    expect_square(mesh);
    EXPECT_EQ(mesh.seen.positions.data()->data(), positions.data());
    EXPECT_EQ(static_cast<const void*>(mesh.seen.triangles.data()), corners.data());

    const std::vector<float> floats(positions.begin(), positions.end());
    const std::vector<std::int64_t> wide(corners.begin(), corners.end());
    const AdaptedMesh copied = agvd::from_arrays(std::span(floats), std::span(wide));
    expect_square(copied);
    EXPECT_TRUE(copied.seen.positions.empty() && copied.seen.triangles.empty());
}

TEST(SpanAdapter, StructuresOfThreeAreAMesh) {
    const std::vector<std::array<float, 3>> floats{{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}};
    const unsigned short corners[2][3] = {{0, 1, 2}, {0, 2, 3}};
    expect_square(agvd::from_arrays(floats, corners));
    const std::vector<Vec3> positions{{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
    const AdaptedMesh mesh = agvd::from_arrays(positions, triangles);
    expect_square(mesh);
    EXPECT_EQ(mesh.seen.positions.data(), positions.data());
    EXPECT_EQ(mesh.seen.triangles.data(), triangles.data());
}

TEST(SpanAdapter, NumbersThatAreLeftOverAreRefused) {
    const std::vector<double> positions(10);
    const std::vector<int> corners{0, 1, 2};
    EXPECT_THROW(static_cast<void>(agvd::from_arrays(positions, corners)), agvd::InvalidInput);
    EXPECT_THROW(static_cast<void>(agvd::from_arrays(corners, positions)), agvd::InvalidInput);
}

}  // namespace
