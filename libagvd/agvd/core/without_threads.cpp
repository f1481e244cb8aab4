// Loops for a system without threads.
#include "agvd/core/shared_loop.h"

namespace agvd {

void run_shared(Index num_chunks, int, LoopBody<Index> run, Poller& poller) {
    run_in_order(num_chunks, run, poller);
}

}  // namespace agvd
