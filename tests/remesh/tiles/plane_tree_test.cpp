#include <gtest/gtest.h>

#include <map>

#include "agvd/mesh/surface.h"
#include "remesh/tiles/plane_tree.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Ticker;
using agvd::Vec3;
using remesh::PlaneTree;

namespace {

Index cell_of(const PlaneTree& tree, const Vec3& point) {
    PlaneTree::Side side = tree.root();
    while (!side.is_cell) {
        const PlaneTree::Node& node = tree.nodes[side.index];
        side = node.normal.dot(point) < node.offset ? node.below : node.above;
    }
    return side.index;
}

std::map<Index, double> weights_of_cells(const PlaneTree& tree, const std::vector<Vec3>& points,
                                         const std::vector<double>& weights) {
    std::map<Index, double> sums;
    for (std::size_t i = 0; i < points.size(); ++i) sums[cell_of(tree, points[i])] += weights[i];
    return sums;
}

TEST(PlaneTree, CellsHaveEqualWeights) {
    const std::vector<Vec3> points = shapes::jitter(shapes::grid(40), 0.01, 7).positions;
    const std::vector<double> weights(points.size(), 1);
    const auto total = static_cast<double>(points.size());
    for (const Index count : {2u, 3u, 5u, 7u, 8u, 13u}) {
        SCOPED_TRACE(count);
        const PlaneTree tree = remesh::divide_by_planes(points, weights, count, Ticker());
        const std::map<Index, double> cells = weights_of_cells(tree, points, weights);
        EXPECT_EQ(cells.size(), count);
        EXPECT_EQ(tree.num_cells, count);
        for (const auto& [cell, weight] : cells) EXPECT_NEAR(weight, total / count, 2) << cell;
    }
}

TEST(PlaneTree, FollowsTheWeights) {
    const std::vector<Vec3> points = shapes::jitter(shapes::grid(40), 0.01, 7).positions;
    std::vector<double> weights;
    for (const Vec3& p : points) weights.push_back(p.x() < 0.25 ? 10 : 1);
    double total = 0;
    for (const double weight : weights) total += weight;
    const PlaneTree tree = remesh::divide_by_planes(points, weights, 6, Ticker());
    const std::map<Index, double> cells = weights_of_cells(tree, points, weights);
    EXPECT_EQ(cells.size(), 6u);
    for (const auto& [cell, weight] : cells) EXPECT_NEAR(weight, total / 6, 20) << cell;
}

TEST(PlaneTree, HasOneCellWhereThereIsNothingToDivide) {
    const std::vector<Vec3> points(5, Vec3(1, 2, 3));
    const PlaneTree heavy =
        remesh::divide_by_planes(points, std::vector<double>(5, 1), 3, Ticker());
    EXPECT_EQ(heavy.num_cells, 1u);
    EXPECT_TRUE(heavy.root().is_cell);
    const PlaneTree one = remesh::divide_by_planes(shapes::grid(3).positions,
                                                   std::vector<double>(16, 1), 1, Ticker());
    EXPECT_EQ(one.num_cells, 1u);
}

// Faces across an axis are common, and a plane along one would part them along jagged edges.
TEST(PlaneTree, NoPlaneRunsAlongAnAxis) {
    const PlaneTree tree = remesh::divide_by_planes(shapes::sphere(3).positions,
                                                    std::vector<double>(642, 1), 17, Ticker());
    ASSERT_EQ(tree.nodes.size(), 16u);
    for (const PlaneTree::Node& node : tree.nodes) {
        EXPECT_NEAR(node.normal.norm(), 1, 1e-15);
        EXPECT_GT(node.normal.cwiseAbs().minCoeff(), 0.13);
    }
}

}  // namespace
