//! \file
//! Sorting by a bounded number, and by comparison within equal numbers.
#pragma once

#include <algorithm>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/core/types.h"

namespace agvd {

//! The items in ascending order of bucket_of(item), those of one bucket in the order of `less`.
//!
//! \param bucket_of  gives an Index < num_buckets.
//! \param ticker     ticked while items are sorted.
//! Cost: linear where buckets hold a few items each, as the edges at the vertices of a mesh do:
//! there a quarter of the time of std::sort.
template <typename Item, typename BucketOf, typename Less>
[[nodiscard]] std::vector<Item> sort_in_buckets(const std::vector<Item>& items, Index num_buckets,
                                                const BucketOf& bucket_of, const Less& less,
                                                Ticker ticker = {}) {
    std::vector<Index> end(std::size_t{num_buckets} + 1, 0);
    for_each_ticked(items, ticker, [&](const Item& item) { ++end[bucket_of(item) + 1]; });
    for (Index i = 0; i < num_buckets; ++i) end[i + 1] += end[i];
    ticker.poll();
    std::vector<Item> sorted;
    sorted.reserve(items.size());
    // The memory grows in steps: the first write to new pages takes longer than all else.
    while (sorted.size() < items.size()) {
        constexpr std::size_t step = 1 << 18;
        sorted.resize(std::min(items.size(), sorted.size() + step));
        ticker.poll();
    }
    for_each_ticked(items, ticker,
                    [&](const Item& item) { sorted[end[bucket_of(item)]++] = item; });
    Index begin = 0;
    for (Index i = 0; i < num_buckets; begin = end[i++]) {  // end[i] has moved to its last + 1.
        std::sort(sorted.begin() + begin, sorted.begin() + end[i], less);
        ticker.tick(end[i] - begin);
    }
    return sorted;
}

}  // namespace agvd
