#include "agvd/core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>

namespace agvd {

void parallel_chunks(Index count, Index grain, int num_threads,
                     const std::function<void(Index chunk, Index begin, Index end)>& body) {
    assert(grain >= 1 && num_threads >= 0);
    const Index chunks = num_chunks(count, grain);
    const auto run = [&](Index chunk) {
        const Index begin = chunk * grain;
        body(chunk, begin, begin + std::min(grain, count - begin));
    };
    if (num_threads == 1 || chunks <= 1) {
        for (Index chunk = 0; chunk < chunks; ++chunk) run(chunk);
        return;
    }
    tbb::task_arena arena(num_threads == 0 ? tbb::task_arena::automatic : num_threads);
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<Index>(0, chunks, 1),
                          [&](const tbb::blocked_range<Index>& range) {
                              for (Index chunk = range.begin(); chunk != range.end(); ++chunk) {
                                  run(chunk);
                              }
                          });
    });
}

}  // namespace agvd
