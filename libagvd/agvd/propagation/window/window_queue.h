//! \file
//! The order in which half-edges and beams are served and pseudo-sources emit windows.
#pragma once

#include <algorithm>
#include <compare>
#include <functional>
#include <utility>
#include <vector>

#include "agvd/propagation/bucket_ring.h"

namespace agvd {

//! The record of a half-edge, a pseudo-source or a beam, in one word: bit 0 tells whether it is a
//! half-edge, and the highest bit a beam from a pseudo-source.
struct FrontItem {
    Index word;

    [[nodiscard]] static constexpr FrontItem half_edge(Index record) { return {2 * record}; }
    [[nodiscard]] static constexpr FrontItem pseudo_source(Index record) {
        return {2 * record + 1};
    }
    [[nodiscard]] static constexpr FrontItem beam(Index record) {
        return {beam_bit | (2 * record + 1)};
    }
    [[nodiscard]] constexpr bool is_half_edge() const { return word % 2 == 0; }
    //! Of an item that is no half-edge.
    [[nodiscard]] constexpr bool is_beam() const { return (word & beam_bit) != 0; }
    [[nodiscard]] constexpr Index record() const { return (word & ~beam_bit) / 2; }
    //! By the word, so that the order is the same in every run.
    constexpr auto operator<=>(const FrontItem&) const = default;

private:
    static constexpr Index beam_bit = Index{1} << 31;
};

//! Items by distance. Any order gives the same distances up to rounding.
//!
//! An item that waits in a bucket remembers it in `queued_in`; no_index: it does not wait. When its
//! distance improves it is pushed into an earlier bucket; take() tells its old entry apart.
class WindowQueue {
public:
    enum class Order : std::uint8_t {
        Buckets,  //!< Quick, but how often a half-edge is served has no useful bound.
        Nearest,  //!< Nearest window first: slower, and bounded as in [mitchell1987].
    };
    //! Items farther away than this share a bucket.
    static constexpr Index last_bucket = 1 << 24;

    //! \param per_length  buckets for each unit of length, > 0.
    explicit WindowQueue(double per_length) : per_length_(per_length) {}

    //! Removes all items. Keeps the memory.
    //! \param least  no item is nearer; buckets are counted from there.
    void start(Order order, double least = 0) {
        order_ = order;
        least_ = least;
        buckets_.clear();
        heap_.clear();
    }
    [[nodiscard]] bool empty() const {
        return order_ == Order::Nearest ? heap_.empty() : buckets_.empty();
    }

    //! \param queued_in  of the item; of Order::Nearest no_index, which stays.
    void push(FrontItem item, double distance, Index& queued_in) {
        if (order_ == Order::Nearest) {
            heap_.emplace_back(distance, item);
            std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
            return;
        }
        const Index bucket = std::max(bucket_of(distance), buckets_.current());
        if (queued_in <= bucket) return;
        queued_in = bucket;
        buckets_.push(bucket, item);
    }

    //! Removes the next item. Not if empty().
    //!
    //! \param prefetch  prefetch(item) loads what the item after it needs.
    template <typename Prefetch>
    [[nodiscard]] FrontItem pop(const Prefetch& prefetch) {
        if (order_ == Order::Nearest) {
            std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
            const FrontItem item = heap_.back().second;
            heap_.pop_back();
            return item;
        }
        const FrontItem item = buckets_.pop();
        if (const FrontItem* const next = buckets_.peek()) prefetch(*next);
        return item;
    }
    //! True if the item just popped is to be served now; it then waits no longer. False if it has
    //! been served from an earlier bucket. Always true for Order::Nearest.
    [[nodiscard]] bool take(Index& queued_in) const {
        if (order_ == Order::Nearest) return true;
        if (queued_in != buckets_.current()) return false;
        queued_in = no_index;
        return true;
    }

    [[nodiscard]] Order order() const { return order_; }
    //! The bucket of the last item.
    [[nodiscard]] Index current() const { return buckets_.current(); }
    [[nodiscard]] Index bucket_of(double distance) const {
        const double buckets = (distance - least_) * per_length_;
        return static_cast<Index>(std::clamp(buckets, 0.0, double{last_bucket}));
    }
    [[nodiscard]] std::size_t bytes() const {
        return heap_.capacity() * sizeof(heap_[0]) + buckets_.bytes();
    }

private:
    Order order_ = Order::Buckets;
    double per_length_;
    double least_ = 0;
    BucketRing<FrontItem> buckets_;
    std::vector<std::pair<double, FrontItem>> heap_;  // Order::Nearest.
};

}  // namespace agvd
