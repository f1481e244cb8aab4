//! \file
//! The threads that help with a loop: those of oneTBB, or our own. Private.
#pragma once

#include "agvd/core/loop_body.h"
#include "agvd/core/types.h"

namespace agvd {

//! Calls work() here, and meanwhile help() on other threads. Returns when all calls have returned.
//! \param most         of the calls of help(); there are fewer where the system has no more threads.
//! \param num_threads  with this one; 0: all cores.
//! \param help, work   throw nothing.
//! \throw std::bad_alloc
void run_with_helpers(Index most, int num_threads, LoopBody<> help, LoopBody<> work);

}  // namespace agvd
