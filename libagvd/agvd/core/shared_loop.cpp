// The calling thread takes chunks too, and is the only one that polls for long: TBB's tasks (with
// ThreadSanitizer plain threads) only help. A helper that comes after the last chunk finds the loop
// closed, so that nobody waits for a task that has not started. The first exception ends the loop.
#include "agvd/core/shared_loop.h"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace agvd {
namespace {

// The time between polls when the calling thread has no chunk left.
constexpr std::chrono::milliseconds wait_between_polls{5};

// A loop whose chunks are taken by several threads.
class SharedLoop {
public:
    SharedLoop(Index num, LoopBody<Index> body, Poller& poller)
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
    LoopBody<Index> body_;
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

// What runs a loop besides the calling thread.
#if defined(__SANITIZE_THREAD__)

// ThreadSanitizer sees into threads, but not into TBB, which is not compiled with it: it would take
// all that a loop reads for a race.
class Helpers {
public:
    explicit Helpers(int num_threads)
        : num_threads_(num_threads > 0 ? static_cast<Index>(num_threads)
                                       : std::thread::hardware_concurrency()) {}

    [[nodiscard]] Index most() const { return num_threads_ - 1; }
    void start(Index num, SharedLoop& loop) {
        for (Index i = 0; i < num; ++i) threads_.emplace_back([&loop] { loop.help(); });
    }
    void wait() { threads_.clear(); }

private:
    Index num_threads_;
    std::vector<std::jthread> threads_;
};

#else

class Helpers {
public:
    explicit Helpers(int num_threads)
        : arena_(num_threads == 0 ? tbb::task_arena::automatic : num_threads) {}

    [[nodiscard]] Index most() { return static_cast<Index>(arena_.max_concurrency()) - 1; }
    void start(Index num, SharedLoop& loop) {
        arena_.execute([&] {
            for (Index i = 0; i < num; ++i) tasks_.run([&loop] { loop.help(); });
        });
    }
    // Those that have not begun find the loop closed, and are run here if nobody else does.
    void wait() {
        arena_.execute([&] { tasks_.wait(); });
    }

private:
    tbb::task_arena arena_;
    tbb::task_group tasks_;
};

#endif

}  // namespace

void run_shared(Index num_chunks, int num_threads, LoopBody<Index> run, Poller& poller) {
    // Not tbb::parallel_for, in which the calling thread may wait long without a poll.
    SharedLoop loop(num_chunks, run, poller);
    Helpers helpers(num_threads);
    helpers.start(std::min(helpers.most(), num_chunks - 1), loop);
    loop.run();
    helpers.wait();
    loop.rethrow();
}

}  // namespace agvd
