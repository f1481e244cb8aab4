#include "agvd/core/progress.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>

#include "agvd/core/bucket_sort.h"
#include "agvd/core/parallel.h"

namespace {

using agvd::Cancelled;
using agvd::Index;
using agvd::Poller;
using agvd::Progress;
using agvd::Ticker;

TEST(Ticker, PollsOncePerIntervalOfWork) {
    int polls = 0;
    const Progress progress = [&](double) { return ++polls < 100; };
    Poller poller(progress);
    Ticker ticker(poller);
    for (std::size_t i = 0; i < 5 * Ticker::interval; ++i) ticker.tick();
    EXPECT_EQ(polls, 5);
    for (int i = 0; i < 3; ++i) ticker.tick(2 * Ticker::interval);
    EXPECT_EQ(polls, 8);
}

TEST(Ticker, WithoutACallbackNeverThrows) {
    Ticker none;
    none.tick(10 * Ticker::interval);
    const Progress empty;
    Poller poller(empty);
    Ticker ticker(poller);
    ticker.tick(10 * Ticker::interval);
    ticker.poll();
    EXPECT_FALSE(poller.progress());
}

TEST(Poller, TellsTheLastFractionAndThrowsFromThenOn) {
    std::vector<double> told;
    const Progress progress = [&](double fraction) {
        told.push_back(fraction);
        return told.size() < 3;
    };
    Poller poller(progress);
    poller.poll();
    poller.tell(0.5);
    EXPECT_THROW(poller.poll(), Cancelled);
    EXPECT_THROW(poller.poll(), Cancelled);  // Without another call.
    EXPECT_THROW(poller.progress()(1), Cancelled);
    EXPECT_EQ(told, (std::vector<double>{0, 0.5, 0.5}));
}

TEST(Poller, WithinMapsFractions) {
    double told = -1;
    const Progress progress = [&](double fraction) {
        told = fraction;
        return true;
    };
    EXPECT_TRUE(agvd::within(progress, 0.2, 0.6)(0.5));
    EXPECT_DOUBLE_EQ(told, 0.4);
    EXPECT_FALSE(agvd::within(Progress(), 0, 1));
}

TEST(ParallelChunks, CallsBackOnTheCallingThreadOnly) {
    const auto caller = std::this_thread::get_id();
    std::atomic<int> elsewhere = 0;
    int polls = 0;
    const Progress progress = [&](double) {
        ++polls;
        if (std::this_thread::get_id() != caller) ++elsewhere;
        return true;
    };
    for (const int num_threads : {1, 2, 8}) {
        Poller poller(progress);
        std::vector<std::atomic<int>> seen(1000);
        const auto body = [&](Index, Index begin, Index end) {
            Ticker ticker(poller);
            ticker.tick(2 * Ticker::interval);
            for (Index i = begin; i < end; ++i) ++seen[i];
        };
        agvd::parallel_chunks(1000, 10, num_threads, body, poller);
        for (const auto& count : seen) EXPECT_EQ(count, 1);
    }
    EXPECT_GE(polls, 200);  // One thread: every chunk.
    EXPECT_EQ(elsewhere, 0);
}

// The calling thread has nothing to do but wait, and no other one may call back.
TEST(ParallelChunks, StopsALongChunkOfAnotherThread) {
    const auto caller = std::this_thread::get_id();
    std::atomic<bool> has_begun = false;
    bool is_waiting = false;  // The calling thread has no chunk left.
    const Progress progress = [&](double) { return !is_waiting; };
    Poller poller(progress);
    const auto body = [&](Index, Index, Index) {
        if (std::this_thread::get_id() == caller) {
            while (!has_begun) std::this_thread::yield();
            is_waiting = true;
            return;
        }
        has_begun = true;
        Ticker ticker(poller);
        while (true) ticker.tick();
    };
    EXPECT_THROW(agvd::parallel_chunks(2, 1, 2, body, poller), Cancelled);
}

TEST(ParallelChunks, TakesNoFurtherChunkOnceItIsStopped) {
    int polls = 0;
    const Progress progress = [&](double) { return ++polls < 5; };
    Poller poller(progress);
    int chunks = 0;
    const auto body = [&](Index, Index, Index) { ++chunks; };
    EXPECT_THROW(agvd::parallel_chunks(100, 1, 1, body, poller), Cancelled);
    EXPECT_EQ(chunks, 5);
}

TEST(ParallelChunks, HandsOverWhatABodyThrows) {
    const auto body = [&](Index chunk, Index, Index) {
        if (chunk == 7) throw std::bad_alloc();
    };
    for (const int num_threads : {1, 4}) {
        EXPECT_THROW(agvd::parallel_chunks(100, 1, num_threads, body), std::bad_alloc);
    }
}

TEST(SortTicked, SortsAsStdSortAndStops) {
    std::vector<Index> items(100'000);
    for (Index i = 0; i < items.size(); ++i) items[i] = i * 7919 % 100'003;
    std::vector<Index> sorted = items, in_buckets = items;
    std::sort(sorted.begin(), sorted.end());
    int polls = 0;
    Progress progress = [&](double) { return ++polls > 0; };
    Poller poller(progress);
    Ticker ticker(poller);
    in_buckets = agvd::sort_in_buckets(
        items, 1001, [](Index i) { return i / 100; }, std::less<>(), ticker);
    EXPECT_EQ(in_buckets, sorted);
    EXPECT_GE(polls, 10);
    std::vector<Index> again = items;
    agvd::sort_ticked(again, ticker, std::less<>());
    EXPECT_EQ(again, sorted);
    progress = [](double) { return false; };
    again = items;
    EXPECT_THROW(agvd::sort_ticked(again, ticker, std::less<>()), Cancelled);
}

}  // namespace
