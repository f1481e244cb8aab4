#include "agvd/mesh/closest_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "agvd/core/error.h"
#include "agvd/core/random.h"
#include "agvd/mesh/scale.h"
#include "support/dirty_shapes.h"
#include "support/shapes.h"

using agvd::ClosestPoint;
using agvd::ClosestPointTree;
using agvd::FaceId;
using agvd::Index;
using agvd::Vec3;

namespace {

const std::array<Vec3, 3> right_triangle{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)};

Vec3 random_point(std::uint64_t i, double size) {
    return size * Vec3(2 * agvd::random_unit(5, 0, i) - 1, 2 * agvd::random_unit(5, 1, i) - 1,
                       2 * agvd::random_unit(5, 2, i) - 1);
}

ClosestPoint try_all_faces(const agvd::TriangleMesh& mesh, const Vec3& query) {
    ClosestPoint best;
    best.distance_sq = std::numeric_limits<double>::infinity();
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const auto& [a, b, c] = mesh.triangles[f];
        const auto found = agvd::closest_point_on_triangle(
            {mesh.positions[a], mesh.positions[b], mesh.positions[c]}, FaceId(f), query);
        if (found.distance_sq < best.distance_sq) best = found;
    }
    return best;
}

}  // namespace

TEST(ClosestPoint, IsInsideOnASideOrAtACorner) {
    const auto closest = [](const Vec3& query) {
        return agvd::closest_point_on_triangle(right_triangle, FaceId(7), query);
    };
    const ClosestPoint inside = closest({0.5, 0.5, 3});
    EXPECT_EQ(inside.point.barycentric, (std::array{0.5, 0.25, 0.25}));
    EXPECT_EQ(inside.distance_sq, 9);
    EXPECT_EQ(inside.point.face, FaceId(7));
    EXPECT_EQ(closest({1, -1, 0}).point.barycentric, (std::array{0.5, 0.5, 0.0}));
    EXPECT_EQ(closest({2, 2, 1}).point.barycentric, (std::array{0.0, 0.5, 0.5}));
    EXPECT_EQ(closest({2, 2, 1}).distance_sq, 3);
    EXPECT_EQ(closest({-1, -1, 0}).point.barycentric, (std::array{1.0, 0.0, 0.0}));
    EXPECT_EQ(closest({9, -2, 0}).position, Vec3(2, 0, 0));
}

TEST(ClosestPoint, WorksOnTrianglesWithoutArea) {
    const auto closest = [](const std::array<Vec3, 3>& corners) {
        return agvd::closest_point_on_triangle(corners, FaceId(0), {1, 2, 0});
    };
    EXPECT_EQ(closest({Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(1.5, 0, 0)}).distance_sq, 4);
    EXPECT_EQ(closest({Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0)}).distance_sq, 4);
}

TEST(ClosestPointTree, AgreesWithTryingAllFaces) {
    const auto meshes = {shapes::jitter(shapes::torus(24, 12), 0.02, 3), shapes::sphere(2),
                         shapes::random_soup(30, 300, 4), shapes::grid(1)};
    for (const agvd::TriangleMesh& mesh : meshes) {
        const ClosestPointTree tree(mesh.view());
        for (std::uint64_t i = 0; i < 500; ++i) {
            const Vec3 query = random_point(i, i % 2 == 0 ? 1.5 : 30);
            const ClosestPoint found = tree.query(query), expected = try_all_faces(mesh, query);
            EXPECT_EQ(found.distance_sq, expected.distance_sq);
            EXPECT_EQ(found.point.face, expected.point.face);
            EXPECT_EQ(found.point.barycentric, expected.point.barycentric);
            EXPECT_NEAR((agvd::position(mesh.view(), found.point) - found.position).norm(), 0,
                        1e-14);
        }
    }
}

// Ties, too, whatever the hint: every other query is at a vertex.
TEST(ClosestPointTree, AHintChangesNothingButItself) {
    const agvd::TriangleMesh mesh = shapes::torus(24, 12);
    const ClosestPointTree tree(mesh.view());
    agvd::Index hint = 0;
    std::set<agvd::Index> hints;
    for (std::uint64_t i = 0; i < 500; ++i) {
        const Vec3 query =
            i % 2 == 0 ? random_point(i, 1.5) : mesh.positions[7 * i % mesh.positions.size()];
        const ClosestPoint expected = tree.query(query), found = tree.query(query, hint);
        EXPECT_EQ(found.distance_sq, expected.distance_sq);
        EXPECT_EQ(found.point.face, expected.point.face);
        EXPECT_EQ(found.point.barycentric, expected.point.barycentric);
        agvd::Index same = hint;
        EXPECT_EQ(tree.query(query, same).point.face, expected.point.face);
        EXPECT_EQ(same, hint);
        hints.insert(hint);
    }
    EXPECT_GT(hints.size(), 200u);
}

TEST(ClosestPointTree, TellsWhetherAPointIsWithinADistance) {
    const agvd::TriangleMesh mesh = shapes::sphere(2);
    const ClosestPointTree tree(mesh.view());
    int num_within = 0;
    for (std::uint64_t i = 0; i < 200; ++i) {
        const Vec3 query = random_point(i, 1.5);
        const double distance = std::sqrt(tree.query(query).distance_sq);
        EXPECT_TRUE(tree.is_within(query, distance * (1 + 1e-12)));
        EXPECT_FALSE(tree.is_within(query, distance * (1 - 1e-12)));
        if (tree.is_within(query, 0.3)) ++num_within;
        EXPECT_EQ(tree.is_within(query, 0.3), distance <= 0.3);
    }
    EXPECT_GT(num_within, 40);
    EXPECT_LT(num_within, 160);
    EXPECT_TRUE(tree.is_within(mesh.positions[0], 0));
    EXPECT_TRUE(tree.is_within(random_point(0, 9), 100));
}

TEST(ClosestPointTree, FindsATriangleThatATestHoldsFor) {
    const agvd::TriangleMesh mesh = shapes::jitter(shapes::torus(24, 12), 0.02, 3);
    const ClosestPointTree tree(mesh.view());
    std::size_t num_tried = 0;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const std::array<Vec3, 3> wanted = agvd::corners_of(mesh, f);
        const Vec3 middle = (wanted[0] + wanted[1] + wanted[2]) / 3;
        const auto reaches = [&](const Vec3& low, const Vec3& high) {
            return (low.array() <= middle.array()).all() && (middle.array() <= high.array()).all();
        };
        const auto is_wanted = [&](const std::array<Vec3, 3>& corners) {
            ++num_tried;
            return corners == wanted;
        };
        EXPECT_TRUE(tree.any_triangle(reaches, is_wanted));
    }
    EXPECT_LT(num_tried, 10 * mesh.triangles.size());
    EXPECT_FALSE(tree.any_triangle([](const Vec3&, const Vec3&) { return true; },
                                   [](const std::array<Vec3, 3>&) { return false; }));
    const agvd::MeshBox box = agvd::box_of(mesh, 1);
    EXPECT_NEAR((tree.low() - box.low).norm() + (tree.high() - box.high).norm(), 0, 1e-14);
}

TEST(ClosestPointTree, GivesTiesOnEdgesAndVerticesToTheLowestFace) {
    const agvd::TriangleMesh mesh = shapes::jitter(shapes::sphere(2), 0.03, 1);
    const ClosestPointTree tree(mesh.view());
    std::vector<Index> lowest(mesh.positions.size(), agvd::no_index);
    for (auto f = static_cast<Index>(mesh.triangles.size()); f-- > 0;) {
        for (const Index v : mesh.triangles[f]) lowest[v] = f;
    }
    for (Index v = 0; v < mesh.positions.size(); ++v) {
        EXPECT_EQ(tree.query(mesh.positions[v]).point.face, FaceId(lowest[v]));
        EXPECT_EQ(tree.query(mesh.positions[v]).distance_sq, 0);
    }
    // The same triangle many times over, its corners in another order each time.
    agvd::TriangleMesh pile{{{0, 0, 0}, {1, 0.3, 0.1}, {0.2, 1, 0.7}}, {}};
    for (Index i = 0; i < 30; ++i) pile.triangles.push_back({i % 3, (i + 1) % 3, (i + 2) % 3});
    for (std::uint64_t i = 0; i < 100; ++i) {
        const ClosestPoint found = ClosestPointTree(pile.view()).query(random_point(i, 3));
        const auto& b = found.point.barycentric;
        if (*std::min_element(b.begin(), b.end()) == 0) {
            EXPECT_EQ(found.point.face, FaceId(0));
        }
    }
}

TEST(ClosestPointTree, NeedsAFace) {
    EXPECT_THROW(ClosestPointTree{agvd::MeshView{}}, agvd::InvalidInput);
}
