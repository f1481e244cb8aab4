//! \file
//! The queue of label-correcting searches: nearest bucket first, in order of arrival within a
//! bucket.
#pragma once

#include <algorithm>

#include "agvd/core/types.h"
#include "agvd/propagation/bucket_ring.h"

namespace agvd {

//! For searches that serve an item again when its distance improves. Such a search needs no strict
//! order, so there is no heap, and the items to come are known and can be loaded ahead. (FrontQueue
//! is for searches that serve every node once, and so must pop the nearest.)
//!
//! An item that waits remembers its bucket in `queued_in`; no_index: it does not wait. When its
//! distance improves it is pushed into an earlier bucket, and its old entry stays: take() tells the
//! two apart.
template <typename Item>
class BucketQueue {
public:
    //! Items farther away than this share a bucket.
    static constexpr Index last_bucket = 1 << 24;

    //! \param per_length  buckets for each unit of length, > 0; a matter of speed only.
    explicit BucketQueue(double per_length) : per_length_(per_length) {}

    //! Removes all items. Keeps the memory.
    void clear() { buckets_.clear(); }
    [[nodiscard]] bool empty() const { return buckets_.empty(); }

    void push(const Item& item, double distance, Index& queued_in) {
        const Index bucket = std::max(bucket_of(distance), buckets_.current());
        if (queued_in <= bucket) return;
        queued_in = bucket;
        buckets_.push(bucket, item);
    }
    //! Not if empty().
    Item pop() { return buckets_.pop(); }
    //! True if the item just popped is to be served now; it then waits no longer. False if it has
    //! been served from an earlier bucket.
    [[nodiscard]] bool take(Index& queued_in) const {
        if (queued_in != buckets_.current()) return false;
        queued_in = no_index;
        return true;
    }
    //! The item `ahead` places behind the one that was just popped; null if the bucket ends before.
    [[nodiscard]] const Item* peek(Index ahead) const { return buckets_.peek(ahead); }

    //! The bucket of the item just popped.
    [[nodiscard]] Index current() const { return buckets_.current(); }
    [[nodiscard]] Index bucket_of(double distance) const {
        return static_cast<Index>(std::min(distance * per_length_, double{last_bucket}));
    }
    [[nodiscard]] std::size_t bytes() const { return buckets_.bytes(); }

private:
    double per_length_;
    BucketRing<Item> buckets_;
};

}  // namespace agvd
