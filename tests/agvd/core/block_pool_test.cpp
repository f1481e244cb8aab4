#include "agvd/core/reused_memory.h"

#include <gtest/gtest.h>

using namespace agvd;

namespace {

Block add(BlockPool<int>& pool, const std::vector<int>& elements) { return pool.add(elements); }

std::vector<int> contents(const BlockPool<int>& pool, const Block& block) {
    return {pool[block].begin(), pool[block].end()};
}

}  // namespace

TEST(BlockPool, BlocksKeepTheirPlaceWhileOthersComeAndGo) {
    BlockPool<int> pool;
    const Block a = add(pool, {1, 2});
    const Block b = add(pool, {3, 4, 5});
    const Block c = add(pool, {6});
    pool.release(b);
    add(pool, {7, 8, 9, 10});
    EXPECT_EQ(contents(pool, a), (std::vector{1, 2}));
    EXPECT_EQ(contents(pool, c), (std::vector{6}));
}

TEST(BlockPool, ReleasedPlacesServeAsManyElementsAgain) {
    BlockPool<int> pool;
    const Block a = add(pool, {1, 2, 3});
    add(pool, {4});
    pool.release(a);
    const Block fewer = add(pool, {5, 6});
    EXPECT_NE(fewer.begin, a.begin);
    const Block as_many = add(pool, {7, 8, 9});
    EXPECT_EQ(as_many.begin, a.begin);
    EXPECT_EQ(pool.size(), 6u);
    EXPECT_EQ(contents(pool, fewer), (std::vector{5, 6}));
    EXPECT_EQ(contents(pool, as_many), (std::vector{7, 8, 9}));
}

TEST(BlockPool, BlocksOfNothingTakeNoPlace) {
    BlockPool<int> pool;
    const Block none = add(pool, {});
    pool.release(none);
    EXPECT_EQ(pool.size(), 0u);
    EXPECT_EQ(pool[none].size(), 0u);
}
