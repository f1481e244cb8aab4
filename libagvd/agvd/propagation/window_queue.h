//! \file
//! The order in which half-edges are served and pseudo-sources emit.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "agvd/core/types.h"

namespace agvd {

//! Items by distance. Any order gives the same distances up to rounding.
class WindowQueue {
public:
    enum class Order : std::uint8_t {
        Buckets,  //!< Quick, but how often a half-edge is served has no useful bound.
        Nearest,  //!< Nearest window first: slower, and bounded as in [mitchell1987].
    };
    //! Items farther away than this share a bucket.
    static constexpr Index last_bucket = 1 << 20;

    //! \param per_bucket  1 / width, > 0.
    explicit WindowQueue(double per_bucket) : per_bucket_(per_bucket) {}

    //! Empties it; keeps the memory.
    void start(Order order) {
        order_ = order;
        if (num_waiting_ > 0) {  // The last run was broken off.
            for (auto& bucket : buckets_) bucket.clear();
        } else if (current_ < buckets_.size()) {
            buckets_[current_].clear();
        }
        heap_.clear();
        current_ = 0;
        next_ = 0;
        num_waiting_ = 0;
    }

    //! \param queued_in  the item's own memory of the bucket it waits in; no_index: in none.
    void push(Index item, double distance, Index& queued_in) {
        if (order_ == Order::Nearest) {
            heap_.emplace_back(distance, item);
            std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
            return;
        }
        const Index bucket = std::max(bucket_of(distance), current_);
        if (queued_in <= bucket) return;
        queued_in = bucket;
        if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
        if (buckets_[bucket].capacity() == 0 && !spare_.empty()) {
            buckets_[bucket] = std::move(spare_.back());
            spare_.pop_back();
        }
        buckets_[bucket].push_back(item);
        ++num_waiting_;
    }

    //! The next item, no_index when none is left. It is stale if it waits in another bucket by now.
    //!
    //! \param prefetch  prefetch(item) loads what the one after it needs.
    template <typename Prefetch>
    [[nodiscard]] Index pop(const Prefetch& prefetch) {
        if (order_ == Order::Nearest) return pop_nearest();
        if (num_waiting_ == 0) return no_index;
        while (next_ == buckets_[current_].size()) close_bucket();
        const std::vector<Index>& bucket = buckets_[current_];
        const Index item = bucket[next_++];
        --num_waiting_;
        if (next_ < bucket.size()) prefetch(bucket[next_]);
        return item;
    }

    [[nodiscard]] Order order() const { return order_; }
    //! The bucket of the last item.
    [[nodiscard]] Index current() const { return current_; }
    [[nodiscard]] Index bucket_of(double distance) const {
        return static_cast<Index>(std::min(distance * per_bucket_, double{last_bucket}));
    }
    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum = heap_.capacity() * sizeof(heap_[0]) +
                          (buckets_.capacity() + spare_.capacity()) * sizeof(buckets_[0]);
        for (const auto& bucket : buckets_) sum += bucket.capacity() * sizeof(Index);
        for (const auto& bucket : spare_) sum += bucket.capacity() * sizeof(Index);
        return sum;
    }

private:
    // Its memory serves a later one.
    void close_bucket() {
        std::vector<Index>& bucket = buckets_[current_];
        bucket.clear();
        if (bucket.capacity() > 0) spare_.push_back(std::move(bucket));
        next_ = 0;
        ++current_;
    }

    [[nodiscard]] Index pop_nearest() {
        if (heap_.empty()) return no_index;
        std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
        const Index item = heap_.back().second;
        heap_.pop_back();
        return item;
    }

    double per_bucket_;
    Order order_ = Order::Buckets;
    std::vector<std::vector<Index>> buckets_, spare_;
    std::vector<std::pair<double, Index>> heap_;  // Order::Nearest.
    Index current_ = 0;                           // Bucket,
    std::size_t next_ = 0;                        // and place in it.
    std::size_t num_waiting_ = 0;                 // In all buckets.
};

}  // namespace agvd
