#include "agvd/propagation/window/window_queue.h"

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <map>

#include "agvd/core/random.h"

using namespace agvd;

namespace {

struct Node {
    double distance = 0;
    Index queued_in = no_index;
};

class BucketQueue : public testing::Test {
protected:
    void push(Index v, double distance) {
        nodes[v].distance = distance;
        queue.push(FrontItem::half_edge(v), distance, nodes[v].queued_in);
    }
    Index pop() {
        return queue.pop([&](FrontItem next) { ahead = next.record(); }).record();
    }
    // Serves all nodes; returns them in order.
    std::vector<Index> drain() {
        std::vector<Index> order;
        while (!queue.empty()) {
            const Index v = pop();
            if (queue.take(nodes[v].queued_in)) order.push_back(v);
        }
        return order;
    }
    std::vector<Index> order_of(std::initializer_list<double> distances) {
        Index v = 0;
        for (const double distance : distances) push(v++, distance);
        return drain();
    }

    std::vector<Node> nodes = std::vector<Node>(4);
    WindowQueue queue{1};
    Index ahead = no_index;  // The item that was to be loaded.
};

}  // namespace

TEST_F(BucketQueue, ServesBucketsInOrderAndNodesAsTheyCame) {
    EXPECT_EQ(order_of({3.5, 0.2, 3.1, 0.9}), (std::vector<Index>{1, 3, 0, 2}));
}

TEST_F(BucketQueue, TheNearestComesFirstInTheOtherOrder) {
    queue.start(WindowQueue::Order::Nearest);
    EXPECT_EQ(order_of({3.5, 0.9, 3.1, 0.2}), (std::vector<Index>{3, 1, 2, 0}));
}

TEST_F(BucketQueue, ANodeThatMovedIsServedOnce) {
    push(0, 5.5);
    push(1, 2.5);
    push(0, 1.5);
    EXPECT_EQ(drain(), (std::vector<Index>{0, 1}));
}

TEST_F(BucketQueue, ANodeServedMayComeAgain) {
    push(0, 2.5);
    ASSERT_EQ(pop(), 0u);
    ASSERT_TRUE(queue.take(nodes[0].queued_in));
    push(0, 2.1);
    EXPECT_EQ(drain(), std::vector<Index>{0});
    EXPECT_TRUE(queue.empty());
}

TEST_F(BucketQueue, FarNodesWaitForTheirTime) {
    EXPECT_EQ(order_of({123456.5, 5000.5, 0.5, 5001.5}), (std::vector<Index>{2, 1, 3, 0}));
}

TEST_F(BucketQueue, NodesBeyondTheLastBucketShareIt) {
    EXPECT_EQ(order_of({1e300, WindowQueue::last_bucket + 9.0}), (std::vector<Index>{0, 1}));
}

TEST_F(BucketQueue, TheNextItemOfTheBucketIsLoaded) {
    push(0, 0.1);
    push(1, 0.2);
    push(2, 1.5);
    ASSERT_EQ(pop(), 0u);
    EXPECT_EQ(ahead, 1u);
    ahead = no_index;
    ASSERT_EQ(pop(), 1u);
    EXPECT_EQ(ahead, no_index);
}

// Against one queue for each bucket. Steps are short, long, and longer than the ring.
TEST(BucketRing, ItemsOfABucketLeaveInTheOrderInWhichTheyCame) {
    BucketRing<Index> ring;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        ring.clear();
        std::map<Index, std::deque<Index>> expected;
        constexpr std::array<double, 4> steps{4, 40, 1100, 9000};
        std::uint64_t draw = 0;
        Index num_pushed = 0;
        const auto push = [&] {
            const double step = steps[static_cast<std::size_t>(4 * random_unit(seed, 0, draw))];
            const Index ahead = static_cast<Index>(step * random_unit(seed, 1, draw++));
            ring.push(ring.current() + ahead, num_pushed);
            expected[ring.current() + ahead].push_back(num_pushed++);
        };
        for (int i = 0; i < 5; ++i) push();
        while (!ring.empty()) {
            auto& [bucket, items] = *expected.begin();
            ASSERT_EQ(ring.pop(), items.front());
            ASSERT_EQ(ring.current(), bucket);
            items.pop_front();
            if (items.empty()) expected.erase(expected.begin());
            if (num_pushed < 2000) push();
            if (num_pushed < 1000) push();
            if (seed % 2 == 0 && draw > 500) break;  // The next run finds items that still wait.
        }
    }
}

TEST(BucketRing, MemoryOfEmptyBucketsIsUsedAgain) {
    BucketRing<Index> ring;
    ring.push(0, 0);
    const std::size_t few_arrays = ring.bytes() + 1000;
    for (Index bucket = 1; bucket < 5000; ++bucket) {
        ring.push(bucket, bucket);
        ASSERT_EQ(ring.pop(), bucket - 1);
    }
    EXPECT_LT(ring.bytes(), few_arrays);
}

TEST(FrontItem, KnowsItsKindAndRecord) {
    for (const Index record : {0U, 1U, 77U, (1U << 30) - 1}) {
        EXPECT_TRUE(FrontItem::half_edge(record).is_half_edge());
        EXPECT_FALSE(FrontItem::pseudo_source(record).is_half_edge());
        EXPECT_FALSE(FrontItem::beam(record).is_half_edge());
        EXPECT_FALSE(FrontItem::pseudo_source(record).is_beam());
        EXPECT_TRUE(FrontItem::beam(record).is_beam());
        EXPECT_EQ(FrontItem::half_edge(record).record(), record);
        EXPECT_EQ(FrontItem::pseudo_source(record).record(), record);
        EXPECT_EQ(FrontItem::beam(record).record(), record);
    }
}
