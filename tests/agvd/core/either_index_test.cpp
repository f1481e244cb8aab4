#include "agvd/core/types.h"

#include <gtest/gtest.h>

#include "agvd/diagram/arcs.h"

using namespace agvd;

TEST(EitherIndex, TellsTheArrayAndTheIndex) {
    for (const Index i : {Index{0}, Index{1}, Index{(1U << 31) - 2}}) {
        EXPECT_FALSE(EitherIndex::first(i).is_second());
        EXPECT_EQ(EitherIndex::first(i).first(), i);
        EXPECT_TRUE(EitherIndex::second(i).is_second());
        EXPECT_EQ(EitherIndex::second(i).second(), i);
    }
}

TEST(EitherIndex, IsNeitherByDefault) {
    EXPECT_FALSE(EitherIndex().is_valid());
    EXPECT_TRUE(EitherIndex::first(0).is_valid());
    EXPECT_TRUE(EitherIndex::second(0).is_valid());
}

TEST(EitherIndex, TheSameIndexOfAnotherArrayDiffers) {
    EXPECT_NE(EitherIndex::first(5), EitherIndex::second(5));
    EXPECT_EQ(EitherIndex::second(5), EitherIndex::second(5));
}

// Loops over lines and nodes read one word each, as they would read a bare index.
TEST(EitherIndex, TakesOneWordUnderEachName) {
    static_assert(sizeof(LineId) == sizeof(Index));
    static_assert(sizeof(NodeId) == sizeof(Index));
    EXPECT_EQ(LineId::of_cut(3).cut(), 3u);
    EXPECT_FALSE(LineId::of_edge(3).is_cut());
    EXPECT_EQ(NodeId::of_voronoi_vertex(3).voronoi_vertex(), 3u);
    EXPECT_FALSE(NodeId::of_crossing(3).is_voronoi_vertex());
}
