#include "agvd/core/parallel.h"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>

namespace agvd {
namespace {

// The time between polls when the calling thread has no chunk left.
constexpr std::chrono::milliseconds wait_between_polls{5};

// A loop whose chunks are taken by several threads. A thread that comes after the loop was closed
// finds no body and does nothing.
class SharedLoop {
public:
    SharedLoop(Index num, const std::function<void(Index)>& body, Poller& poller)
        : num_chunks_(num), body_(body), poller_(poller) {}

    // Called by workers.
    void help() {
        {
            const std::scoped_lock lock(mutex_);
            if (is_closed_) return;
            ++num_helpers_;
        }
        take_chunks();
        const std::scoped_lock lock(mutex_);
        --num_helpers_;
        has_left_.notify_one();
    }

    // Called by the calling thread; returns when no thread is in the body any more.
    void run() {
        take_chunks();
        std::unique_lock lock(mutex_);
        is_closed_ = true;
        while (num_helpers_ > 0) {
            has_left_.wait_for(lock, wait_between_polls);
            if (num_helpers_ == 0) break;
            lock.unlock();
            record_failure([&] { poller_.poll(); });
            lock.lock();
        }
    }

    // The first exception of a body or of the poller.
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    void take_chunks() {
        record_failure([&] {
            while (!has_failed_.load(std::memory_order_relaxed)) {
                const std::size_t chunk = next_.fetch_add(1, std::memory_order_relaxed);
                if (chunk >= num_chunks_) return;
                poller_.poll();
                body_(static_cast<Index>(chunk));
            }
        });
    }

    template <typename Work>
    void record_failure(const Work& work) {
        try {
            work();
        } catch (...) {
            has_failed_.store(true, std::memory_order_relaxed);
            const std::scoped_lock lock(failure_mutex_);
            if (!failure_) failure_ = std::current_exception();
        }
    }

    const std::size_t num_chunks_;
    const std::function<void(Index)>& body_;
    Poller& poller_;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<bool> has_failed_ = false;
    std::mutex failure_mutex_;
    std::exception_ptr failure_;
    std::mutex mutex_;
    std::condition_variable has_left_;
    Index num_helpers_ = 0;
    bool is_closed_ = false;
};

}  // namespace

void parallel_chunks(Index count, Index grain, int num_threads,
                     const std::function<void(Index chunk, Index begin, Index end)>& body,
                     Poller& poller) {
    assert(grain >= 1 && num_threads >= 0);
    const Index chunks = num_chunks(count, grain);
    const std::function<void(Index)> run = [&](Index chunk) {
        const Index begin = chunk * grain;
        body(chunk, begin, begin + std::min(grain, count - begin));
    };
    if (num_threads == 1 || chunks <= 1) {
        for (Index chunk = 0; chunk < chunks; ++chunk) {
            // A loop of one chunk does not poll: it may be one of thousands.
            if (chunk > 0) poller.poll();
            run(chunk);
        }
        return;
    }
    // This is not tbb::parallel_for, in which the calling thread may wait long without a poll.
    tbb::task_arena arena(num_threads == 0 ? tbb::task_arena::automatic : num_threads);
    tbb::task_group helpers;
    SharedLoop loop(chunks, run, poller);
    const auto num_helpers = std::min(static_cast<Index>(arena.max_concurrency()) - 1, chunks - 1);
    arena.execute([&] {
        for (Index i = 0; i < num_helpers; ++i) helpers.run([&loop] { loop.help(); });
    });
    loop.run();
    // Helpers that have not begun find the loop closed. They run here if no worker runs them.
    arena.execute([&] { helpers.wait(); });
    loop.rethrow();
}

void parallel_chunks(Index count, Index grain, int num_threads,
                     const std::function<void(Index chunk, Index begin, Index end)>& body) {
    Poller none;
    parallel_chunks(count, grain, num_threads, body, none);
}

}  // namespace agvd
