//! \file
//! A rough min-queue: the nearest bucket first, in order of arrival within a bucket.
#pragma once

#include <algorithm>
#include <vector>

#include "agvd/core/types.h"

namespace agvd {

//! For label-correcting searches, which serve a node again when it improves: there is no heap to
//! keep, and the nodes to come can be looked up ahead.
class BucketQueue {
public:
    //! \param bucket_width > 0, in mesh units; a matter of speed only, but no distance may exceed
    //!                     2^31 widths.
    explicit BucketQueue(double bucket_width) : per_width_(1 / bucket_width), ring_(ring_size) {}

    //! \param queued_in  the node's own memory of the bucket it waits in; no_index: in none.
    void push(Index node, double distance, Index& queued_in) {
        // What lies beyond the ring waits in its last bucket and is pushed again from there.
        const Index bucket = std::clamp(bucket_of(distance), current_, current_ + (ring_size - 1));
        if (queued_in == bucket) return;
        queued_in = bucket;
        ring_[bucket % ring_size].push_back(node);
        ++waiting_;
    }

    //! The next node; no_index when none is left. A node is handed out once for each bucket that it
    //! waited in: take() tells whether its time has come.
    [[nodiscard]] Index pop() {
        if (waiting_ == 0) return no_index;
        while (next_ == ring_[current_ % ring_size].size()) {
            ring_[current_ % ring_size].clear();
            next_ = 0;
            ++current_;
        }
        --waiting_;
        return ring_[current_ % ring_size][next_++];
    }

    //! True if the node just popped is to be served now; it then waits in no bucket.
    [[nodiscard]] bool take(Index node, double distance, Index& queued_in) {
        if (queued_in != current_) return false;
        queued_in = no_index;
        if (bucket_of(distance) <= current_) return true;
        push(node, distance, queued_in);
        return false;
    }

    //! The node `ahead` places after the one just popped; no_index if the bucket ends before.
    [[nodiscard]] Index peek(std::size_t ahead) const {
        const std::vector<Index>& bucket = ring_[current_ % ring_size];
        const std::size_t place = next_ + ahead - 1;
        return place < bucket.size() ? bucket[place] : no_index;
    }

    //! Bytes held; buckets keep what they once needed.
    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum = ring_.capacity() * sizeof(ring_[0]);
        for (const auto& bucket : ring_) sum += bucket.capacity() * sizeof(Index);
        return sum;
    }

private:
    static constexpr Index ring_size = 1024;

    [[nodiscard]] Index bucket_of(double distance) const {
        return static_cast<Index>(distance * per_width_);
    }

    double per_width_;
    std::vector<std::vector<Index>> ring_;
    Index current_ = 0;
    std::size_t next_ = 0;     // In the current bucket.
    std::size_t waiting_ = 0;  // In all buckets.
};

}  // namespace agvd
