#include "remesh/clean/space_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "agvd/core/random.h"
#include "agvd/mesh/surface_points.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Vec3;

TEST(SpaceOrder, NeighboursInTheOrderAreNeighboursInSpace) {
    // A square of 64 x 64 points in random order.
    std::vector<Vec3> points;
    for (int i = 0; i < 64 * 64; ++i) points.emplace_back(i % 64, i / 64, 0.5);
    for (std::size_t i = points.size() - 1; i > 0; --i) {
        std::swap(points[i], points[agvd::random_bits(7, 0, i) % (i + 1)]);
    }
    const std::vector<Index> order = remesh::detail::order_in_space(points);
    std::vector<Index> sorted = order;
    std::ranges::sort(sorted);
    std::vector<Index> all(points.size());
    std::iota(all.begin(), all.end(), Index{0});
    EXPECT_EQ(sorted, all);
    double sum = 0;
    for (std::size_t k = 1; k < order.size(); ++k) {
        sum += (points[order[k]] - points[order[k - 1]]).norm();
    }
    EXPECT_LT(sum / static_cast<double>(order.size()), 1.7);  // At random: 33.
}

TEST(SpaceOrder, PointsAtOnePlaceKeepTheirOrder) {
    const std::vector<Vec3> points{{1, 1, 1}, {0, 0, 0}, {1, 1, 1}, {0, 0, 0}};
    EXPECT_EQ(remesh::detail::order_in_space(points), (std::vector<Index>{1, 3, 0, 2}));
    const std::vector<Vec3> same(3, {2, 3, 4});
    EXPECT_EQ(remesh::detail::order_in_space(same), (std::vector<Index>{0, 1, 2}));
    EXPECT_TRUE(remesh::detail::order_in_space({}).empty());
}

namespace {

// An open mesh.
agvd::TriangleMesh shuffled_grid() { return shapes::shuffle(shapes::grid(20)); }

}  // namespace

TEST(SpaceOrder, AMeshKeepsItsFacesAndConnectivity) {
    const agvd::TriangleMesh mesh = shuffled_grid();
    remesh::CleanResult clean = remesh::clean_input(mesh.view());
    ASSERT_FALSE(clean.connectivity.twin.empty());
    ASSERT_TRUE(remesh::detail::order_in_space(clean, {}, 30));
    ASSERT_EQ(clean.mesh.positions.size(), mesh.positions.size());
    ASSERT_EQ(clean.mesh.triangles.size(), mesh.triangles.size());
    double apart = 0;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const agvd::Triangle &now = clean.mesh.triangles[f],
                             &before = mesh.triangles[clean.face_origin[f]];
        for (Index k = 0; k < 3; ++k) {
            EXPECT_EQ(clean.vertex_origin[now[k]], before[k]);
            EXPECT_EQ(clean.mesh.positions[now[k]], mesh.positions[before[k]]);
        }
        apart += std::max({now[0], now[1], now[2]}) - std::min({now[0], now[1], now[2]});
        if (f == 0) continue;
        const agvd::Triangle& last = clean.mesh.triangles[f - 1];
        EXPECT_LE(std::min({last[0], last[1], last[2]}), std::min({now[0], now[1], now[2]}));
    }
    EXPECT_LT(apart / static_cast<double>(mesh.triangles.size()), 60);  // At random: 220.
    const auto found = agvd::find_connectivity(clean.mesh.view());
    ASSERT_TRUE(found);
    EXPECT_EQ(clean.connectivity.twin, found->twin);
    // Of inner vertices any half-edge will do.
    for (Index v = 0; v < clean.mesh.positions.size(); ++v) {
        const Index h = clean.connectivity.outgoing[v];
        EXPECT_EQ(clean.mesh.triangles[h / 3][h % 3], v);
        EXPECT_EQ(found->twin[h] == agvd::no_index,
                  found->twin[found->outgoing[v]] == agvd::no_index);
    }
}

TEST(SpaceOrder, AMeshWhoseFacesAreTogetherStaysAsItIs) {
    const agvd::TriangleMesh mesh = shuffled_grid();
    remesh::CleanResult clean = remesh::clean_input(mesh.view());
    EXPECT_FALSE(remesh::detail::order_in_space(clean, {}, 300));
    EXPECT_FALSE(remesh::detail::order_in_space(clean, {}));
    EXPECT_EQ(clean.mesh.triangles, mesh.triangles);
    EXPECT_EQ(clean.face_origin[5], 5u);
}

// Without connectivity, and with faces dropped: origins stay those of the input.
TEST(SpaceOrder, ARepairedMeshKeepsItsOrigins) {
    agvd::TriangleMesh mesh = shuffled_grid();
    mesh.triangles.insert(mesh.triangles.begin() + 7, mesh.triangles[3]);  // Twice.
    remesh::CleanResult clean = remesh::clean_input(mesh.view());
    ASSERT_TRUE(clean.connectivity.twin.empty());
    ASSERT_TRUE(remesh::detail::order_in_space(clean, {}, 30));
    EXPECT_TRUE(clean.connectivity.twin.empty());
    ASSERT_EQ(clean.mesh.triangles.size(), mesh.triangles.size() - 1);
    for (Index f = 0; f < clean.mesh.triangles.size(); ++f) {
        for (Index k = 0; k < 3; ++k) {
            EXPECT_EQ(clean.vertex_origin[clean.mesh.triangles[f][k]],
                      mesh.triangles[clean.face_origin[f]][k]);
        }
    }
}
