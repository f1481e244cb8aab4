//! \file
//! The two ways to run the chunks of a loop. Private.
#pragma once

#include "agvd/core/loop_body.h"
#include "agvd/core/progress.h"
#include "agvd/core/types.h"

namespace agvd {

//! Calls run(chunk) for each chunk in order, and polls between them.
//! \throw as parallel_chunks.
void run_in_order(Index num_chunks, LoopBody<Index> run, Poller& poller);

//! The same on this thread and others, in any order. A build without oneTBB runs them in order.
//! \param num_threads, poller  see parallel_chunks.
//! \throw as parallel_chunks.
void run_shared(Index num_chunks, int num_threads, LoopBody<Index> run, Poller& poller);

}  // namespace agvd
