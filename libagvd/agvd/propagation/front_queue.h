//! \file
//! The wavefront: a min-queue without ties.
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "agvd/core/types.h"

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

//! 4-ary heap ordered by (distance, site, node): four children of 16 bytes share a cache line.
//! Improved nodes are pushed again; the caller skips the stale entries on pop.
class FrontQueue {
public:
    [[nodiscard]] bool empty() const { return heap_.empty(); }
    [[nodiscard]] const FrontEntry& top() const { return heap_.front(); }
    [[nodiscard]] std::size_t peak_bytes() const { return heap_.capacity() * sizeof(FrontEntry); }

    void push(const FrontEntry& entry) {
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

    FrontEntry pop() {
        const FrontEntry result = heap_.front();
        const FrontEntry last = heap_.back();
        heap_.pop_back();
        const std::size_t size = heap_.size();
        if (size == 0) return result;
        std::size_t i = 0;
        while (4 * i + 1 < size) {
            const std::size_t first = 4 * i + 1;
            const std::size_t end = std::min(first + 4, size);
            std::size_t least = first;
            for (std::size_t child = first + 1; child < end; ++child) {
                if (heap_[child] < heap_[least]) least = child;
            }
            if (!(heap_[least] < last)) break;
            heap_[i] = heap_[least];
            i = least;
        }
        heap_[i] = last;
        return result;
    }

private:
    std::vector<FrontEntry> heap_;
};

}  // namespace agvd
