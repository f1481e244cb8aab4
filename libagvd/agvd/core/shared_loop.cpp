// The calling thread takes chunks too, and is the only one that polls for long: others only help. A
// helper that comes after the last chunk finds the loop closed, so that nobody waits for one that
// has not started. The first exception ends the loop.
#include "agvd/core/shared_loop.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>

#include "agvd/core/helpers.h"

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

}  // namespace

void run_shared(Index num_chunks, int num_threads, LoopBody<Index> run, Poller& poller) {
    // Not tbb::parallel_for, in which the calling thread may wait long without a poll.
    SharedLoop loop(num_chunks, run, poller);
    const auto help = [&] { loop.help(); };
    const auto work = [&] { loop.run(); };
    run_with_helpers(num_chunks - 1, num_threads, help, work);
    loop.rethrow();
}

}  // namespace agvd
