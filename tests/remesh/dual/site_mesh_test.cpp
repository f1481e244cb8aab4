#include "remesh/dual/site_mesh.h"

#include <gtest/gtest.h>

#include "remesh/sites/cvt_energy.h"
#include "support/dice.h"

using agvd::Index;
using agvd::Triangle;
using agvd::Vec3;
using remesh::detail::SiteMesh;

namespace {

Vec3 normal_of(const std::array<Vec3, 4>& p, const Triangle& t) {
    return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).normalized();
}

double cotangent_at(const Vec3& corner, const Vec3& a, const Vec3& b) {
    return (a - corner).dot(b - corner) / (a - corner).cross(b - corner).norm();
}

}  // namespace

TEST(SiteMesh, FansCloseOrEndAtTheRimOrAreBroken) {
    using remesh::detail::Fan;
    // A tetrahedron, a square of two triangles, two triangles that meet in 8, two of the same
    // corners, and 16, which has none.
    const std::vector<Triangle> triangles{{0, 2, 1},    {0, 1, 3},   {1, 2, 3},  {2, 0, 3},
                                          {4, 5, 6},    {4, 6, 7},   {8, 9, 10}, {8, 11, 12},
                                          {13, 14, 15}, {13, 15, 14}};
    const std::vector<Fan> fans = find_fans(remesh::detail::build_site_mesh(triangles, 17));
    ASSERT_EQ(fans.size(), 17u);
    for (Index i = 0; i < 17; ++i) {
        const Fan expected = i < 4 ? Fan::Closed : i == 8 || i >= 13 ? Fan::Broken : Fan::Open;
        EXPECT_EQ(fans[i], expected) << i;
    }
}

// Three triangles on one edge: the fans of its ends are broken.
TEST(SiteMesh, FansAreBrokenWhereThreeTrianglesMeet) {
    using remesh::detail::Fan;
    const std::vector<Fan> fans =
        find_fans(remesh::detail::build_site_mesh({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5));
    EXPECT_EQ(fans, (std::vector{Fan::Broken, Fan::Broken, Fan::Open, Fan::Open, Fan::Open}));
}

// Two triangles with a common edge, at any angle. A flip turns no normal by more than the rule
// says, on neither side.
TEST(SiteMesh, FlipsFoldNeitherTriangle) {
    constexpr double least_cosine = 0.2;
    const Triangle first{0, 1, 2}, second{1, 0, 3}, left{2, 3, 1}, right{3, 2, 0};
    Index num_flipped = 0;
    Index num_left = 0, num_right = 0;  // Flips that would fold one side only, which are rare.
    for (std::uint64_t seed = 0; seed < 100000; ++seed) {
        Dice dice(seed);
        const auto near = [&](double y) {
            return Vec3(dice.number(-1, 2), y * dice.number(0.02, 0.5), dice.number(-1, 1));
        };
        const std::array<Vec3, 4> p{Vec3(0, 0, 0), Vec3(1, 0, 0), near(1), near(-1)};
        SiteMesh mesh = remesh::detail::build_site_mesh({first, second}, 4);
        std::vector<double> cotangent;
        for (Index h = 0; h < 6; ++h) {
            cotangent.push_back(cotangent_at(p[mesh.tail(SiteMesh::previous(h))], p[mesh.tail(h)],
                                             p[mesh.head(h)]));
        }
        const Vec3 before = (normal_of(p, first) + normal_of(p, second)).normalized();
        const bool left_folds = !(before.dot(normal_of(p, left)) > least_cosine);
        const bool right_folds = !(before.dot(normal_of(p, right)) > least_cosine);
        const bool is_bad = cotangent[0] + cotangent[3] < -1e-9;
        const Index flips = remesh::detail::flip_towards_delaunay(mesh, p, cotangent);
        EXPECT_EQ(flips, is_bad && !left_folds && !right_folds ? 1u : 0u) << seed;
        num_flipped += flips;
        if (is_bad && left_folds && !right_folds) ++num_left;
        if (is_bad && right_folds && !left_folds) ++num_right;
    }
    EXPECT_GT(num_flipped, 1000u);
    EXPECT_GT(num_left, 2u);
    EXPECT_GT(num_right, 2u);
}
