#include "remesh/tiles/join_parts.h"

#include <gtest/gtest.h>

using agvd::Index;
using remesh::join_parts;

namespace {

using Parts = std::vector<Index>;

TEST(JoinParts, LargePartsStay) {
    EXPECT_EQ(join_parts({3, 2}, std::vector<remesh::PartBorder>{{0, 1, 5}}, 2), (Parts{0, 1}));
}

TEST(JoinParts, ASmallPartJoinsTheLargerPartWithTheLongestBorder) {
    // Two pieces of the border to part 2 are longer together than the one to part 1.
    const std::vector<remesh::PartBorder> borders{{0, 1, 3}, {0, 2, 2}, {2, 0, 2}};
    EXPECT_EQ(join_parts({1, 9, 9}, borders, 2), (Parts{2, 1, 2}));
    // A smaller neighbour does not count, and joins itself.
    EXPECT_EQ(join_parts({2, 1, 9}, std::vector<remesh::PartBorder>{{0, 1, 9}, {0, 2, 1}}, 3),
              (Parts{2, 2, 2}));
}

TEST(JoinParts, OfEqualPartsTheFirstCountsAsLarger) {
    EXPECT_EQ(join_parts({1, 1}, std::vector<remesh::PartBorder>{{1, 0, 1}}, 2), (Parts{0, 0}));
}

TEST(JoinParts, SmallPartsJoinUntilTheyAreLarge) {
    // A chain: all are small, and there is nothing else.
    const std::vector<remesh::PartBorder> chain{{0, 1, 1}, {1, 2, 1}, {2, 3, 1}};
    const Parts joined = join_parts({1, 1, 1, 1}, chain, 10);
    EXPECT_EQ(joined, Parts(4, joined[0]));
    // Two small ones are large enough together.
    EXPECT_EQ(join_parts({1, 1.5, 9}, std::vector<remesh::PartBorder>{{0, 1, 2}, {1, 2, 1}}, 2),
              (Parts{2, 2, 2}));
}

TEST(JoinParts, PartsWithoutNeighboursStay) { EXPECT_EQ(join_parts({1, 1}, {}, 2), (Parts{0, 1})); }

}  // namespace
