//! \file
//! A loop over tiles on several threads. Private to the jobs on tiles.
#pragma once

#include <exception>
#include <mutex>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"

namespace remesh {

//! Calls each(i) for i < count, side by side. An error does not stop the others; that of the lowest
//! i is thrown at the end. Cancelled stops all.
template <typename Each>
void for_each_tile(Index count, int num_threads, const Each& each, Poller& poller) {
    std::mutex mutex;
    Index lowest = no_index;
    std::exception_ptr thrown;
    parallel_each(
        count, 1, num_threads,
        [&](Index i) {
            try {
                each(i);
            } catch (const Cancelled&) {
                throw;
            } catch (const Error&) {
                const std::lock_guard lock(mutex);
                if (i >= lowest) return;
                lowest = i;
                thrown = std::current_exception();
            }
        },
        poller);
    if (thrown) std::rethrow_exception(thrown);
}

}  // namespace remesh
