//! \file
//! Buckets of items by number: what the queues of all engines have in place of a heap.
#pragma once

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "agvd/core/run_array.h"
#include "agvd/core/types.h"

namespace agvd {

//! Items of a bucket leave in the order in which they came. Only buckets within a window of
//! ring_size numbers are arrays, used again when emptied; items beyond it wait in one list.
template <typename Item>
class BucketRing {
public:
    static constexpr Index ring_size = 1024;

    BucketRing() : ring_(ring_size) {}

    //! Removes all items and opens bucket 0. Keeps the memory.
    void clear() {
        if (num_waiting_ > 0) {
            for (auto& bucket : ring_) bucket.clear();
            far_.clear();
        } else {
            open_bucket().clear();
        }
        current_ = 0;
        ring_end_ = ring_size;
        nearest_far_ = no_index;
        next_ = 0;
        num_waiting_ = 0;
    }

    [[nodiscard]] bool empty() const { return num_waiting_ == 0; }
    //! The number of the open bucket.
    [[nodiscard]] Index current() const { return current_; }

    //! \param bucket  at least current().
    void push(Index bucket, const Item& item) {
        assert(bucket >= current_);
        ++num_waiting_;
        if (bucket < ring_end_) {
            push_near(bucket, item);
        } else {
            push_far(bucket, item);
        }
    }

    //! Removes the first item. Opens its bucket if another one is open. Not if empty().
    Item pop() {
        assert(num_waiting_ > 0);
        while (next_ == open_bucket().size()) open_next();
        --num_waiting_;
        return open_bucket()[next_++];
    }
    //! The item behind the one that was just popped; null if the bucket ends before.
    [[nodiscard]] const Item* peek() const {
        const RunArray<Item>& bucket = ring_[current_ % ring_size];
        return next_ < bucket.size() ? &bucket[next_] : nullptr;
    }

    //! Bytes held. They never become fewer.
    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum = (ring_.capacity() + spare_.capacity()) * sizeof(ring_[0]) +
                          far_.capacity() * sizeof(far_[0]);
        for (const auto& bucket : ring_) sum += bucket.bytes();
        for (const auto& bucket : spare_) sum += bucket.bytes();
        return sum;
    }

private:
    [[nodiscard]] RunArray<Item>& open_bucket() { return ring_[current_ % ring_size]; }

    void push_near(Index bucket, const Item& item) {
        RunArray<Item>& items = ring_[bucket % ring_size];
        if (items.bytes() == 0) take_spare(items);
        items.push(item);
    }
    // What is rare stays out of the loops that push, so that these can be inlined.
    [[gnu::noinline]] void take_spare(RunArray<Item>& items) {
        if (spare_.empty()) return;
        items = std::move(spare_.back());
        spare_.pop_back();
    }
    [[gnu::noinline]] void push_far(Index bucket, const Item& item) {
        far_.emplace_back(bucket, item);
        nearest_far_ = std::min(nearest_far_, bucket);
    }

    // Closes the open bucket, which is used up.
    [[gnu::noinline]] void open_next() {
        RunArray<Item>& closed = open_bucket();
        closed.clear();
        if (closed.bytes() > 0) spare_.push_back(std::exchange(closed, RunArray<Item>()));
        next_ = 0;
        ++current_;
        if (num_waiting_ == far_.size()) {
            current_ = nearest_far_;
            move_ring();
        } else if (current_ == ring_end_) {
            move_ring();
        }
    }

    // Lets the ring begin at the open bucket, and moves the items that are no longer far.
    [[gnu::noinline]] void move_ring() {
        ring_end_ = current_ + ring_size;
        nearest_far_ = no_index;
        std::size_t kept = 0;
        for (const auto& waiting : far_) {
            if (waiting.first < ring_end_) {
                push_near(waiting.first, waiting.second);
            } else {
                nearest_far_ = std::min(nearest_far_, waiting.first);
                far_[kept++] = waiting;
            }
        }
        far_.erase(far_.begin() + static_cast<std::ptrdiff_t>(kept), far_.end());
    }

    std::vector<RunArray<Item>> ring_;         // Bucket b, if near, is ring_[b % ring_size].
    std::vector<RunArray<Item>> spare_;        // Empty, with memory.
    std::vector<std::pair<Index, Item>> far_;  // Bucket and item, as they came.
    Index nearest_far_ = no_index;             // The first bucket in far_.
    Index current_ = 0;                        // The open bucket.
    Index ring_end_ = ring_size;               // Buckets from here on are far.
    Index next_ = 0;                           // Index in the open bucket.
    std::size_t num_waiting_ = 0;              // In ring_ and far_.
};

}  // namespace agvd
