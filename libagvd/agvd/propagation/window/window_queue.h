//! \file
//! The order in which half-edges are served and pseudo-sources emit windows.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "agvd/core/types.h"
#include "agvd/propagation/window/bucket_queue.h"
#include "agvd/propagation/window/front_item.h"

namespace agvd {

//! Items by distance. Any order gives the same distances up to rounding.
class WindowQueue {
public:
    enum class Order : std::uint8_t {
        Buckets,  //!< Quick, but how often a half-edge is served has no useful bound.
        Nearest,  //!< Nearest window first: slower, and bounded as in [mitchell1987].
    };

    //! \param per_length  buckets for each unit of length, > 0.
    explicit WindowQueue(double per_length) : buckets_(per_length) {}

    //! Removes all items. Keeps the memory.
    void start(Order order) {
        order_ = order;
        buckets_.clear();
        heap_.clear();
    }
    [[nodiscard]] bool empty() const {
        return order_ == Order::Nearest ? heap_.empty() : buckets_.empty();
    }

    //! \param queued_in  as in BucketQueue; of Order::Nearest no_index, which stays.
    void push(FrontItem item, double distance, Index& queued_in) {
        if (order_ == Order::Nearest) {
            heap_.emplace_back(distance, item);
            std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
        } else {
            buckets_.push(item, distance, queued_in);
        }
    }

    //! Removes the next item. Not if empty().
    //!
    //! \param prefetch  prefetch(item) loads what the item after it needs.
    template <typename Prefetch>
    [[nodiscard]] FrontItem pop(const Prefetch& prefetch) {
        if (order_ == Order::Nearest) return pop_nearest();
        const FrontItem item = buckets_.pop();
        if (const FrontItem* const next = buckets_.peek(1)) prefetch(*next);
        return item;
    }
    //! As in BucketQueue; always true for Order::Nearest.
    [[nodiscard]] bool take(Index& queued_in) const {
        return order_ == Order::Nearest || buckets_.take(queued_in);
    }

    [[nodiscard]] Order order() const { return order_; }
    //! The bucket of the last item.
    [[nodiscard]] Index current() const { return buckets_.current(); }
    [[nodiscard]] Index bucket_of(double distance) const { return buckets_.bucket_of(distance); }
    [[nodiscard]] std::size_t bytes() const {
        return heap_.capacity() * sizeof(heap_[0]) + buckets_.bytes();
    }

private:
    [[nodiscard]] FrontItem pop_nearest() {
        std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
        const FrontItem item = heap_.back().second;
        heap_.pop_back();
        return item;
    }

    Order order_ = Order::Buckets;
    BucketQueue<FrontItem> buckets_;
    std::vector<std::pair<double, FrontItem>> heap_;  // Order::Nearest.
};

}  // namespace agvd
