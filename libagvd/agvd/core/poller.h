//! \file
//! How a loop, on whatever thread, lets the progress callback of its stage stop it.
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>

#include "agvd/core/progress.h"
#include "agvd/core/types.h"

namespace agvd {

//! What the threads of one stage share. Only the thread that made it calls the callback; the
//! others see that it said stop. All Cancelled are alike, so that it does not matter which thread
//! throws first.
class Poller {
public:
    //! Never stops.
    Poller() = default;
    //! \param progress  outlives this; may be empty.
    explicit Poller(const Progress& progress)
        : progress_(progress ? &progress : nullptr), owner_(std::this_thread::get_id()) {}
    Poller(const Poller&) = delete;
    Poller& operator=(const Poller&) = delete;

    //! Any thread.
    //! \throw Cancelled if the callback said stop, now or before.
    void poll() {
        if (progress_ == nullptr) return;
        if (std::this_thread::get_id() == owner_ && !has_stopped() && !(*progress_)(fraction_)) {
            stopped_.store(true, std::memory_order_relaxed);
        }
        if (has_stopped()) throw Cancelled();
    }
    //! As poll(), and what is told from now on. On the thread that made this.
    void tell(double fraction) {
        fraction_ = fraction;
        poll();
    }
    //! For a stage within this one, on any thread: polls this, and tells no fraction of its own.
    //! This must outlive it. Empty if there is nothing to poll.
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

//! Polls once every so much work. One for each loop or thread; it costs a subtraction.
class Ticker {
public:
    //! Never polls.
    Ticker() = default;
    //! Of steps of 20 to 100 ns: polls come every .3 to 2 ms. Counted, so that how often a stage
    //! polls does not depend on the machine.
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

//! Calls each(item) for all of a vector or span, with a tick in between now and then: what takes a
//! few nanoseconds is not slowed down by it.
template <typename Items, typename Each>
void for_each_ticked(Items&& items, Ticker& ticker, const Each& each) {
    constexpr std::size_t block = 1 << 12;
    for (std::size_t begin = 0; begin < items.size(); begin += block) {
        const std::size_t end = std::min(items.size(), begin + block);
        for (std::size_t i = begin; i < end; ++i) each(items[i]);
        ticker.tick(end - begin);
    }
}

//! std::sort with a tick for each comparison. What it throws leaves the items in any state.
template <typename Items, typename Less>
void sort_ticked(Items&& items, Ticker& ticker, const Less& less) {
    std::sort(items.begin(), items.end(), [&](const auto& a, const auto& b) {
        ticker.tick();
        return less(a, b);
    });
}

}  // namespace agvd
