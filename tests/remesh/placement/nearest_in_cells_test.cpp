#include "remesh/placement/nearest_in_cells.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "agvd/core/random.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Vec3;
using remesh::detail::NearestInCells;

namespace {

// Cells: the octants. The points are at distances of 0.8 to 1.2 from the middle.
Index octant(const Vec3& p) {
    return (p.x() > 0 ? 1U : 0U) + (p.y() > 0 ? 2U : 0U) + (p.z() > 0 ? 4U : 0U);
}
Vec3 near_sphere(std::uint64_t i) {
    const Vec3 p(agvd::random_unit(3, i, 0) - 0.5, agvd::random_unit(3, i, 1) - 0.5,
                 agvd::random_unit(3, i, 2) - 0.5);
    return (0.8 + 0.4 * agvd::random_unit(3, i, 3)) * p.normalized();
}

}  // namespace

TEST(NearestInCells, ItIsTheNearestPointOfTheSurface) {
    const agvd::Surface sphere = agvd::build_surface(shapes::sphere(4).view());
    std::vector<Index> cell;
    for (const Vec3& p : sphere.mesh.positions) cell.push_back(octant(p));
    const agvd::IntrinsicTriangulation base(sphere);
    const NearestInCells nearest(base, cell, 8);
    const agvd::ClosestPointTree tree(sphere.mesh.view());
    const std::array<Index, 8> all{0, 1, 2, 3, 4, 5, 6, 7};
    for (std::uint64_t i = 0; i < 500; ++i) {
        const Vec3 p = near_sphere(i);
        const double expected = std::sqrt(tree.query(p).distance_sq);
        EXPECT_NEAR(std::sqrt(nearest.query(p, all).distance_sq), expected, 1e-12) << i;
    }
}

TEST(NearestInCells, OtherCellsAreNotLookedAt) {
    const agvd::Surface sphere = agvd::build_surface(shapes::sphere(4).view());
    std::vector<Index> cell;
    for (const Vec3& p : sphere.mesh.positions) {
        cell.push_back(p.z() > 0.1 ? 0 : p.z() < -0.1 ? 1 : agvd::no_index);
    }
    const agvd::IntrinsicTriangulation base(sphere);
    const NearestInCells nearest(base, cell, 3);
    for (std::uint64_t i = 0; i < 100; ++i) {
        const Vec3 p = near_sphere(i);
        const std::array<Index, 1> above{0}, below{1}, empty{2};
        EXPECT_GT(nearest.query(p, above).position.z(), 0) << i;
        EXPECT_LT(nearest.query(p, below).position.z(), 0) << i;
        EXPECT_TRUE(std::isinf(nearest.query(p, empty).distance_sq)) << i;
    }
}
