#include "agvd/propagation/window/bucket_queue.h"

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <map>

#include "agvd/core/random.h"
#include "agvd/propagation/window/front_item.h"

using namespace agvd;

namespace {

struct Node {
    double distance;
    Index queued_in = no_index;
};

// Serves all nodes; returns them in order.
std::vector<Index> drain(BucketQueue<Index>& queue, std::vector<Node>& nodes) {
    std::vector<Index> order;
    while (!queue.empty()) {
        const Index v = queue.pop();
        if (queue.take(nodes[v].queued_in)) order.push_back(v);
    }
    return order;
}

}  // namespace

TEST(BucketQueue, ServesBucketsInOrderAndNodesAsTheyCame) {
    std::vector<Node> nodes{{3.5}, {0.2}, {3.1}, {0.9}};
    BucketQueue<Index> queue(1);
    for (Index v = 0; v < 4; ++v) queue.push(v, nodes[v].distance, nodes[v].queued_in);
    EXPECT_EQ(drain(queue, nodes), (std::vector<Index>{1, 3, 0, 2}));
}

TEST(BucketQueue, ANodeThatMovedIsServedOnce) {
    std::vector<Node> nodes{{5.5}, {2.5}};
    BucketQueue<Index> queue(1);
    for (Index v = 0; v < 2; ++v) queue.push(v, nodes[v].distance, nodes[v].queued_in);
    nodes[0].distance = 1.5;
    queue.push(0, 1.5, nodes[0].queued_in);
    EXPECT_EQ(drain(queue, nodes), (std::vector<Index>{0, 1}));
}

TEST(BucketQueue, ANodeServedMayComeAgain) {
    std::vector<Node> nodes{{2.5}};
    BucketQueue<Index> queue(1);
    queue.push(0, 2.5, nodes[0].queued_in);
    ASSERT_EQ(queue.pop(), 0u);
    ASSERT_TRUE(queue.take(nodes[0].queued_in));
    nodes[0].distance = 2.1;
    queue.push(0, 2.1, nodes[0].queued_in);
    EXPECT_EQ(drain(queue, nodes), std::vector<Index>{0});
    EXPECT_TRUE(queue.empty());
}

TEST(BucketQueue, FarNodesWaitForTheirTime) {
    std::vector<Node> nodes{{123456.5}, {5000.5}, {0.5}, {5001.5}};
    BucketQueue<Index> queue(1);
    for (Index v = 0; v < 4; ++v) queue.push(v, nodes[v].distance, nodes[v].queued_in);
    EXPECT_EQ(drain(queue, nodes), (std::vector<Index>{2, 1, 3, 0}));
}

TEST(BucketQueue, NodesBeyondTheLastBucketShareIt) {
    std::vector<Node> nodes{{1e300}, {BucketQueue<Index>::last_bucket + 9.0}};
    BucketQueue<Index> queue(1);
    for (Index v = 0; v < 2; ++v) queue.push(v, nodes[v].distance, nodes[v].queued_in);
    EXPECT_EQ(drain(queue, nodes), (std::vector<Index>{0, 1}));
}

TEST(BucketQueue, PeekEndsWithTheBucket) {
    std::vector<Node> nodes{{0.1}, {0.2}, {1.5}};
    BucketQueue<Index> queue(1);
    for (Index v = 0; v < 3; ++v) queue.push(v, nodes[v].distance, nodes[v].queued_in);
    ASSERT_EQ(queue.pop(), 0u);
    ASSERT_NE(queue.peek(1), nullptr);
    EXPECT_EQ(*queue.peek(1), 1u);
    EXPECT_EQ(queue.peek(2), nullptr);
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
    for (const Index record : {0U, 1U, 77U, (1U << 31) - 1}) {
        EXPECT_FALSE(FrontItem::half_edge(record).is_pseudo_source());
        EXPECT_TRUE(FrontItem::pseudo_source(record).is_pseudo_source());
        EXPECT_EQ(FrontItem::half_edge(record).record(), record);
        EXPECT_EQ(FrontItem::pseudo_source(record).record(), record);
    }
}
