#include "agvd/core/parallel.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "agvd/core/error.h"
#include "agvd/core/shared_loop.h"

namespace agvd {

void run_in_order(Index num_chunks, LoopBody<Index> run, Poller& poller) {
    for (Index chunk = 0; chunk < num_chunks; ++chunk) {
        // A loop of one chunk does not poll: it may be one of thousands.
        if (chunk > 0) poller.poll();
        run(chunk);
    }
}

void parallel_chunks(Index count, Index grain, int num_threads, const ChunkBody& body,
                     Poller& poller) {
    assert(grain >= 1 && num_threads >= 0);
    const Index chunks = num_chunks(count, grain);
    const auto run = [&](Index chunk) {
        const Index begin = chunk * grain;
        body(chunk, begin, begin + std::min(grain, count - begin));
    };
    if (num_threads == 1 || chunks <= 1) {
        run_in_order(chunks, run, poller);
    } else {
        run_shared(chunks, num_threads, run, poller);
    }
}

void parallel_chunks(Index count, Index grain, int num_threads, const ChunkBody& body) {
    Poller none;
    parallel_chunks(count, grain, num_threads, body, none);
}

void check_num_threads(int num_threads) {
    if (num_threads >= 0) return;
    throw InvalidOption("num_threads is " + std::to_string(num_threads) +
                        "; use 0 (all cores) or more");
}

}  // namespace agvd
