//! \file
//! Every stage polls its progress callback inside its loops, on any thread, and stops when that
//! says so. Held by Polls in tests/remesh/pipeline and Poller in tests/agvd/core.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <utility>

#include "agvd/core/error.h"

namespace agvd {

//! Gets the finished fraction in [0, 1] on the thread that called the stage; false stops the stage.
//! It is called every millisecond or so of work (see Ticker) and should take below a microsecond.
using Progress = std::function<bool(double)>;

//! \throw Cancelled if there is a callback and it returns false.
inline void poll(const Progress& progress, double fraction) {
    if (progress && !progress(fraction)) throw Cancelled();
}

//! The callback for a part of the work, from one fraction to another.
[[nodiscard]] inline Progress within(Progress progress, double begin, double end) {
    if (!progress) return {};
    return [progress = std::move(progress), begin, end](double x) {
        return progress(begin + x * (end - begin));
    };
}

//! Shared by the threads of one stage. Only the thread that made it calls the callback. The other
//! threads see whether the callback has said stop. It does not matter which thread throws Cancelled
//! first.
class Poller {
public:
    //! Never stops.
    Poller() = default;
    //! \param progress  outlives this; may be empty.
    explicit Poller(const Progress& progress)
        : progress_(progress ? &progress : nullptr), owner_(std::this_thread::get_id()) {}
    Poller(const Poller&) = delete;
    Poller& operator=(const Poller&) = delete;

    //! May be called on any thread.
    //! \throw Cancelled if the callback said stop, now or before.
    void poll() {
        if (progress_ == nullptr) return;
        if (std::this_thread::get_id() == owner_ && !has_stopped() && !(*progress_)(fraction_)) {
            stopped_.store(true, std::memory_order_relaxed);
        }
        if (has_stopped()) throw Cancelled();
    }
    //! Sets the fraction that the callback gets from now on, and polls. Only on the thread that
    //! made this.
    void tell(double fraction) {
        fraction_ = fraction;
        poll();
    }
    //! A callback for a stage within this one, on any thread: it polls this poller and ignores the
    //! fraction. The poller must outlive it. Empty if there is nothing to poll.
    [[nodiscard]] Progress progress() {
        if (progress_ == nullptr) return {};
        return [this](double) {
            poll();
            return true;
        };
    }

private:
    [[nodiscard]] bool has_stopped() const { return stopped_.load(std::memory_order_relaxed); }

    const Progress* progress_ = nullptr;
    std::thread::id owner_;
    double fraction_ = 0;
    std::atomic<bool> stopped_ = false;
};

//! Polls once in `interval` steps of work. There is one for each loop or thread. A tick costs a
//! subtraction.
class Ticker {
public:
    //! Never polls.
    Ticker() = default;
    //! Polls come about every millisecond. Steps are counted instead of time measured, so that the
    //! number of polls does not depend on the machine.
    static constexpr std::size_t interval = 1 << 14;

    //! \param poller  outlives this.
    explicit Ticker(Poller& poller) : poller_(&poller) {}

    //! After a large allocation, or before a step that has no ticks.
    //! \throw Cancelled
    void poll() {
        if (poller_ != nullptr) poller_->poll();
    }
    //! \param work  steps done since the last call.
    //! \throw Cancelled
    void tick(std::size_t work = 1) {
        if (work < left_) {
            left_ -= work;
        } else {
            left_ = interval;
            poll();
        }
    }

private:
    Poller* poller_ = nullptr;
    std::size_t left_ = interval;
};

//! Calls each(item) for all items of a vector or span, and ticks once for a block of items: a loop
//! whose steps take a few nanoseconds is not slowed down.
template <typename Items, typename Each>
void for_each_ticked(Items&& items, Ticker& ticker, const Each& each) {
    constexpr std::size_t block = 1 << 12;
    for (std::size_t begin = 0; begin < items.size(); begin += block) {
        const std::size_t end = std::min(items.size(), begin + block);
        for (std::size_t i = begin; i < end; ++i) each(items[i]);
        ticker.tick(end - begin);
    }
}

//! std::sort with a tick for each comparison. After Cancelled the items are in any state.
template <typename Items, typename Less>
void sort_ticked(Items&& items, Ticker& ticker, const Less& less) {
    std::sort(items.begin(), items.end(), [&](const auto& a, const auto& b) {
        ticker.tick();
        return less(a, b);
    });
}

}  // namespace agvd
