// Helpers are threads of the standard library, for systems without oneTBB, and for ThreadSanitizer,
// which does not see into oneTBB. To start a thread costs as much as a short loop: threads that
// have started once wait for the next loop.
#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

#include "agvd/core/helpers.h"

namespace agvd {
namespace {

// A loop that wants help.
struct Call {
    LoopBody<> help;
    Index num_waiting;      // Helpers that may still begin.
    Index num_running = 0;  // Helpers that have not returned.
};

class Pool {
public:
    void begin(Call& call) {
        const std::scoped_lock lock(mutex_);
        calls_.push_back(&call);
        has_calls_.notify_all();
        try {
            for (; num_threads_ < call.num_waiting; ++num_threads_) {
                std::thread([this] { serve(); }).detach();
            }
        } catch (const std::exception&) {  // The system starts no more of them.
        }
    }

    // Returns when no helper of the call runs, or begins any more.
    void end(Call& call) {
        std::unique_lock lock(mutex_);
        std::erase(calls_, &call);
        has_returned_.wait(lock, [&] { return call.num_running == 0; });
    }

private:
    [[noreturn]] void serve() {
        std::unique_lock lock(mutex_);
        while (true) {
            has_calls_.wait(lock, [&] { return !calls_.empty(); });
            Call& call = *calls_.front();
            ++call.num_running;
            if (--call.num_waiting == 0) calls_.pop_front();
            lock.unlock();
            call.help();
            lock.lock();
            if (--call.num_running == 0) has_returned_.notify_all();
        }
    }

    std::mutex mutex_;
    std::condition_variable has_calls_, has_returned_;
    std::deque<Call*> calls_;
    Index num_threads_ = 0;
};

}  // namespace

void run_with_helpers(Index most, int num_threads, LoopBody<> help, LoopBody<> work) {
    // Never destroyed: its threads wait until the program has ended.
    // NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
    static Pool& pool = *new Pool;
    const auto wanted = num_threads > 0 ? static_cast<Index>(num_threads)
                                        : std::max(std::thread::hardware_concurrency(), 1U);
    Call call{help, std::min(most, wanted - 1)};
    if (call.num_waiting == 0) return work();
    pool.begin(call);
    work();
    pool.end(call);
}

}  // namespace agvd
