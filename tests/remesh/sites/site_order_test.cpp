#include "remesh/sites/site_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "agvd/core/random.h"

using agvd::Index;
using agvd::Vec3;

TEST(SiteOrder, NeighboursInTheOrderAreNeighboursInSpace) {
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

TEST(SiteOrder, PointsAtOnePlaceKeepTheirOrder) {
    const std::vector<Vec3> points{{1, 1, 1}, {0, 0, 0}, {1, 1, 1}, {0, 0, 0}};
    EXPECT_EQ(remesh::detail::order_in_space(points), (std::vector<Index>{1, 3, 0, 2}));
    const std::vector<Vec3> same(3, {2, 3, 4});
    EXPECT_EQ(remesh::detail::order_in_space(same), (std::vector<Index>{0, 1, 2}));
    EXPECT_TRUE(remesh::detail::order_in_space({}).empty());
}
