// The limit of work is a few usual runs, and no less than a small mesh may take.
#include "remesh/pipeline/work_limit.h"

#include <gtest/gtest.h>

using remesh::detail::WorkLimit;

TEST(WorkLimit, ASmallMeshHasTheLeastLimit) {
    WorkLimit limit(100, 1000);
    EXPECT_FALSE(limit.is_spent());
    EXPECT_EQ(limit.num_left(300'000), 2);
    limit.add(300'000);
    EXPECT_EQ(limit.num_left(300'000), 1);
    limit.add(499'999);
    EXPECT_FALSE(limit.is_spent());
    EXPECT_EQ(limit.num_left(300'000), 0);
    limit.add(1);
    EXPECT_TRUE(limit.is_spent());
    limit.add(1);
    EXPECT_EQ(limit.num_left(1), 0);
}

TEST(WorkLimit, ALargeOneHasFourUsualRuns) {
    // Four times a million faces and eight for each sample: 19 204 million, more than 32 bits hold.
    WorkLimit limit(1'000'000, 600'000'000);
    EXPECT_EQ(limit.num_left(1'000'000), 1000);
    for (int i = 0; i < 19'203; ++i) limit.add(1'000'000);
    EXPECT_FALSE(limit.is_spent());
    limit.add(1'000'000);
    EXPECT_TRUE(limit.is_spent());
}

TEST(WorkLimit, AnAttemptThatFailsCountsTwice) {
    WorkLimit limit(100, 1000);
    limit.add(200'000);
    const std::size_t done = limit.done();
    EXPECT_EQ(done, 200'000U);
    limit.add(100'000);
    limit.add(50'000);
    limit.add_again(done);
    EXPECT_EQ(limit.done(), 500'000U);
}

TEST(WorkLimit, NothingIsLeftOfASpentOne) {
    const WorkLimit limit = WorkLimit::spent();
    EXPECT_TRUE(limit.is_spent());
    EXPECT_EQ(limit.num_left(1), 0);
}
