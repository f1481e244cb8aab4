// Helpers are tasks of oneTBB.
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>

#include "agvd/core/helpers.h"

namespace agvd {

void run_with_helpers(Index most, int num_threads, LoopBody<> help, LoopBody<> work) {
    tbb::task_arena arena(num_threads == 0 ? tbb::task_arena::automatic : num_threads);
    tbb::task_group tasks;
    arena.execute([&] {
        most = std::min(most, static_cast<Index>(arena.max_concurrency()) - 1);
        for (Index i = 0; i < most; ++i) tasks.run([help] { help(); });
    });
    work();
    // Those that have not begun find nothing to do, and run here if nobody else takes them.
    arena.execute([&] { tasks.wait(); });
}

}  // namespace agvd
