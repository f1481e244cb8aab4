// The sides of faces by edge.
#include "agvd/mesh/any_mesh.h"

#include <gtest/gtest.h>

#include "agvd/core/types.h"

using agvd::EdgeSide;
using agvd::Index;
using agvd::Triangle;

namespace {

// Three faces on the edge from 1 to 2, the second in the other direction.
const std::vector<Triangle> three_on_an_edge{{1, 2, 0}, {2, 1, 3}, {4, 1, 2}};

}  // namespace

TEST(EdgeSides, StandByEdgeAndThenByHalfEdge) {
    const std::vector<EdgeSide> sides = agvd::sorted_edge_sides(three_on_an_edge);
    std::vector<std::pair<std::uint64_t, Index>> order;
    for (const EdgeSide& side : sides) order.emplace_back(side.ends, side.half_edge);
    const auto key = agvd::edge_key;
    EXPECT_EQ(order, (std::vector<std::pair<std::uint64_t, Index>>{{key(0, 1), 2},
                                                                   {key(0, 2), 1},
                                                                   {key(1, 2), 0},
                                                                   {key(1, 2), 3},
                                                                   {key(1, 2), 7},
                                                                   {key(1, 3), 4},
                                                                   {key(1, 4), 6},
                                                                   {key(2, 3), 5},
                                                                   {key(2, 4), 8}}));
}

TEST(EdgeSides, AreVisitedOnceForEachEdge) {
    std::vector<std::size_t> sizes;
    agvd::for_each_edge(agvd::sorted_edge_sides(three_on_an_edge),
                        [&](std::span<const EdgeSide> edge) {
                            sizes.push_back(edge.size());
                            if (edge.size() < 3) return;
                            EXPECT_EQ(edge[0].low(), 1u);
                            EXPECT_EQ(edge[0].high(), 2u);
                            EXPECT_TRUE(edge[0].forward && !edge[1].forward && edge[2].forward);
                        });
    EXPECT_EQ(sizes, std::vector<std::size_t>({1, 1, 3, 1, 1, 1, 1}));
}

TEST(EdgeSides, KeysAreThoseOfUnorderedPairs) {
    EXPECT_EQ(agvd::edge_key(7, 3), agvd::edge_key(3, 7));
    EXPECT_LT(agvd::edge_key(3, 7), agvd::edge_key(3, 8));
    EXPECT_LT(agvd::edge_key(3, 8), agvd::edge_key(4, 0xfffffffe));
}

TEST(DropUnused, NumbersTheVerticesThatAreLeftInTheirOrder) {
    std::vector<agvd::Triangle> triangles{{5, 1, 3}, {3, 1, 6}};
    EXPECT_EQ(agvd::drop_unused(8, triangles), (std::vector<Index>{1, 3, 5, 6}));
    EXPECT_EQ(triangles, (std::vector<agvd::Triangle>{{2, 0, 1}, {1, 0, 3}}));
}
