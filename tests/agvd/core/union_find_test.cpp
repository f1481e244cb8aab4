#include "agvd/core/union_find.h"

#include <gtest/gtest.h>

using agvd::Index;
using agvd::UnionFind;

TEST(UnionFind, TheRootOfASetIsItsLowestElement) {
    UnionFind sets(6);
    EXPECT_TRUE(sets.unite(5, 3));
    EXPECT_TRUE(sets.unite(1, 4));
    EXPECT_TRUE(sets.unite(4, 5));
    EXPECT_FALSE(sets.unite(3, 1));
    const UnionFind& same = sets;
    for (const Index i : {1U, 3U, 4U, 5U}) {
        EXPECT_EQ(same.root(i), 1u);
        EXPECT_EQ(sets.root(i), 1u);
        EXPECT_EQ(sets.is_root(i), i == 1);
    }
    for (const Index i : {0U, 2U}) {
        EXPECT_EQ(sets.root(i), i);
        EXPECT_TRUE(sets.is_root(i));
    }
}
