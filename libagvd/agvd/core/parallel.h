//! \file
//! The parallel loop of the libraries. Chunks have a fixed size, so that results per chunk do not
//! depend on the number of threads.
#pragma once

#include <vector>

#include "agvd/core/loop_body.h"
#include "agvd/core/progress.h"
#include "agvd/core/types.h"

namespace agvd {

//! Called with (chunk, begin, end).
using ChunkBody = LoopBody<Index, Index, Index>;

//! Calls body(chunk, begin, end) for each chunk of `grain` consecutive indices of [0, count).
//!
//! \param grain        chunk size, >= 1; chunk c is [c * grain, min((c + 1) * grain, count)).
//! \param num_threads  >= 0; 0: all cores. With 1, chunks run in order on the calling thread.
//! \param poller       polled between chunks, and by the calling thread while it waits for the
//!                     others. A long body polls it as well.
//! The body may throw only Cancelled (of the poller) and std::bad_alloc. The exception is thrown
//! from here when no thread is in the body any more. Record other failures and throw that of the
//! lowest index after the loop.
void parallel_chunks(Index count, Index grain, int num_threads, const ChunkBody& body,
                     Poller& poller);
//! The same without a poller, for short loops.
void parallel_chunks(Index count, Index grain, int num_threads, const ChunkBody& body);

//! The same with a poller, but calls each(index).
template <typename Each>
void parallel_each(Index count, Index grain, int num_threads, const Each& each, Poller& poller) {
    const auto body = [&](Index, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) each(i);
    };
    parallel_chunks(count, grain, num_threads, body, poller);
}

//! \throw InvalidOption  num_threads < 0.
void check_num_threads(int num_threads);

//! A chunk size for passes that do little for each face, edge or vertex.
inline constexpr Index pass_grain = 1 << 14;

//! The number of chunks of parallel_chunks for `count` indices.
[[nodiscard]] constexpr Index num_chunks(Index count, Index grain) {
    return count / grain + (count % grain != 0 ? 1 : 0);
}

//! Calls collect(index, found) for each index, and joins what is appended to `found`, in the order
//! of the indices.
template <typename Item, typename Collect>
[[nodiscard]] std::vector<Item> parallel_collect(Index count, Index grain, int num_threads,
                                                 const Collect& collect, Poller& poller) {
    std::vector<std::vector<Item>> chunks(num_chunks(count, grain));
    const auto body = [&](Index chunk, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) collect(i, chunks[chunk]);
    };
    parallel_chunks(count, grain, num_threads, body, poller);
    std::vector<Item> all;
    for (const std::vector<Item>& chunk : chunks) {
        poller.poll();
        all.insert(all.end(), chunk.begin(), chunk.end());
    }
    return all;
}

}  // namespace agvd
