#include "agvd/propagation/bucket_queue.h"

#include <gtest/gtest.h>

using namespace agvd;

namespace {

struct Node {
    double distance;
    Index queued_in = no_index;
};

// Serves all nodes; returns them in order.
std::vector<Index> drain(BucketQueue& queue, std::vector<Node>& nodes) {
    std::vector<Index> order;
    for (Index v = queue.pop(); v != no_index; v = queue.pop()) {
        if (queue.take(v, nodes[v].distance, nodes[v].queued_in)) order.push_back(v);
    }
    return order;
}

}  // namespace

TEST(BucketQueue, ServesBucketsInOrderAndNodesAsTheyCame) {
    std::vector<Node> nodes{{3.5}, {0.2}, {3.1}, {0.9}};
    BucketQueue queue(1);
    for (Index v = 0; v < 4; ++v) queue.push(v, nodes[v].distance, nodes[v].queued_in);
    EXPECT_EQ(drain(queue, nodes), (std::vector<Index>{1, 3, 0, 2}));
}

TEST(BucketQueue, ANodeThatMovedIsServedOnce) {
    std::vector<Node> nodes{{5.5}, {2.5}};
    BucketQueue queue(1);
    for (Index v = 0; v < 2; ++v) queue.push(v, nodes[v].distance, nodes[v].queued_in);
    nodes[0].distance = 1.5;
    queue.push(0, 1.5, nodes[0].queued_in);
    EXPECT_EQ(drain(queue, nodes), (std::vector<Index>{0, 1}));
}

TEST(BucketQueue, ANodeServedMayComeAgain) {
    std::vector<Node> nodes{{2.5}};
    BucketQueue queue(1);
    queue.push(0, 2.5, nodes[0].queued_in);
    ASSERT_EQ(queue.pop(), 0u);
    ASSERT_TRUE(queue.take(0, 2.5, nodes[0].queued_in));
    nodes[0].distance = 2.1;
    queue.push(0, 2.1, nodes[0].queued_in);
    EXPECT_EQ(drain(queue, nodes), std::vector<Index>{0});
    EXPECT_EQ(queue.pop(), no_index);
}

TEST(BucketQueue, FarNodesWaitForTheirTime) {
    std::vector<Node> nodes{{123456.5}, {5000.5}, {0.5}, {5001.5}};
    BucketQueue queue(1);
    for (Index v = 0; v < 4; ++v) queue.push(v, nodes[v].distance, nodes[v].queued_in);
    EXPECT_EQ(drain(queue, nodes), (std::vector<Index>{2, 1, 3, 0}));
}

TEST(BucketQueue, PeekEndsWithTheBucket) {
    std::vector<Node> nodes{{0.1}, {0.2}, {1.5}};
    BucketQueue queue(1);
    for (Index v = 0; v < 3; ++v) queue.push(v, nodes[v].distance, nodes[v].queued_in);
    ASSERT_EQ(queue.pop(), 0u);
    EXPECT_EQ(queue.peek(1), 1u);
    EXPECT_EQ(queue.peek(2), no_index);
}
