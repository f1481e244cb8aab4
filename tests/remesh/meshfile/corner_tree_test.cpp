#include "remesh/meshfile/corner_tree.h"

#include <gtest/gtest.h>

#include <set>

#include "support/dice.h"

using agvd::Vec2;
using remesh::CornerTree;

TEST(CornerTree, BoxesHoldTheMarkedPointsThatASearchFinds) {
    Dice dice(3);
    std::vector<Vec2> points;
    for (int i = 0; i < 500; ++i) {  // Many share a coordinate.
        points.emplace_back(dice.count(0, 20), dice.number(0, 20));
    }
    CornerTree tree(points);
    std::vector<bool> is_marked(points.size(), false);
    std::size_t num_found = 0;
    for (int round = 0; round < 400; ++round) {
        const auto i = dice.count(0, 499);
        is_marked[i] = dice.count(0, 2) > 0;
        tree.mark(i, is_marked[i]);
        tree.mark(i, is_marked[i]);
        const Vec2 low(dice.count(0, 20), dice.number(0, 20));
        const Vec2 high = low + Vec2(dice.count(0, 9), dice.number(0, 9));
        std::set<std::size_t> expected, found;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const Vec2& p = points[k];
            if (is_marked[k] && low.x() <= p.x() && p.x() <= high.x() && low.y() <= p.y() &&
                p.y() <= high.y()) {
                expected.insert(k);
            }
        }
        EXPECT_FALSE(tree.any_in(low, high, [&](std::size_t k) {
            EXPECT_TRUE(found.insert(k).second);
            return false;
        }));
        EXPECT_EQ(found, expected);
        num_found += found.size();
        EXPECT_EQ(tree.any_in(low, high, [](std::size_t) { return true; }), !expected.empty());
    }
    EXPECT_GT(num_found, 1000u);
}
