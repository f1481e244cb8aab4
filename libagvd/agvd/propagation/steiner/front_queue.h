//! \file
//! The wavefront: a monotone min-queue without ties.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "agvd/core/types.h"
#include "agvd/propagation/bucket_ring.h"

namespace agvd {

struct FrontEntry {
    double distance;
    Index site;
    Index node;

    [[nodiscard]] bool operator<(const FrontEntry& other) const {
        if (distance != other.distance) return distance < other.distance;
        return site != other.site ? site < other.site : node < other.node;
    }
};

//! The queue of searches that serve every node once: it pops in the order (distance, site, node).
//! (BucketQueue is for searches that may serve a node again, and needs no heap.) Nodes wait
//! unsorted in buckets of equal distance range. Only the open bucket is a heap, small enough for
//! the first cache levels, and a node that improves within its bucket is not pushed again. (One
//! heap over the whole front took 70 % of the propagation's time on 70k faces.) The caller skips
//! the stale entries on pop. Nothing may be pushed below the last pop.
class FrontQueue {
public:
    //! \param bucket_width > 0, in mesh units; a matter of speed only, but no distance may exceed
    //!                     2^31 widths.
    explicit FrontQueue(double bucket_width) : per_width_(1 / bucket_width) {}

    //! \param queued_in  the node's own memory of the bucket it waits in; no_index at first.
    void push(const FrontEntry& entry, Index& queued_in) {
        const auto bucket = static_cast<Index>(entry.distance * per_width_) + 1;
        if (bucket <= buckets_.current()) {
            sift_up(entry);
        } else if (queued_in != bucket) {
            queued_in = bucket;
            buckets_.push(bucket, entry.node);
        }
    }

    //! Makes top() and pop() possible; false when nothing is left.
    //! \param load  load(node, bucket) returns the node's entry if it still waits in that bucket.
    template <typename Load>
    [[nodiscard]] bool refill(const Load& load) {
        while (heap_.empty()) {
            if (buckets_.empty()) return false;
            const std::span<const Index> nodes = buckets_.pop_bucket();
            const Index bucket = buckets_.current();
            for (const Index node : nodes) {
                if (const std::optional<FrontEntry> entry = load(node, bucket)) sift_up(*entry);
            }
        }
        return true;
    }

    [[nodiscard]] const FrontEntry& top() const { return heap_.front(); }

    FrontEntry pop() {
        const FrontEntry result = heap_.front();
        const FrontEntry last = heap_.back();
        heap_.pop_back();
        if (!heap_.empty()) sift_down(last);
        return result;
    }

    //! Bytes held. They never become fewer.
    [[nodiscard]] std::size_t bytes() const {
        return heap_.capacity() * sizeof(FrontEntry) + buckets_.bytes();
    }

private:
    // 4-ary: four children of 16 bytes share a cache line.
    void sift_up(const FrontEntry& entry) {
        std::size_t i = heap_.size();
        heap_.push_back(entry);
        while (i > 0) {
            const std::size_t parent = (i - 1) / 4;
            if (!(entry < heap_[parent])) break;
            heap_[i] = heap_[parent];
            i = parent;
        }
        heap_[i] = entry;
    }

    void sift_down(const FrontEntry& entry) {
        const std::size_t size = heap_.size();
        std::size_t i = 0;
        while (4 * i + 1 < size) {
            const std::size_t first = 4 * i + 1;
            const std::size_t end = std::min(first + 4, size);
            std::size_t least = first;
            for (std::size_t child = first + 1; child < end; ++child) {
                if (heap_[child] < heap_[least]) least = child;
            }
            if (!(heap_[least] < entry)) break;
            heap_[i] = heap_[least];
            i = least;
        }
        heap_[i] = entry;
    }

    double per_width_;
    std::vector<FrontEntry> heap_;  // Of the open bucket.
    BucketRing<Index> buckets_;     // Numbered from 1.
};

}  // namespace agvd
