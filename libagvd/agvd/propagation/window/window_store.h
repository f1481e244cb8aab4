//! \file
//! The memory of windows: short arrays that are taken and given back.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <span>
#include <vector>

#include "agvd/core/reused_memory.h"
#include "agvd/propagation/window/window.h"

namespace agvd {

//! Runs of windows, known by number. A run has room for the next power of two and does not move. A
//! run that was given back goes to a free list of its size. It is used again while it is still in
//! the cache.
class WindowStore {
public:
    //! Gives all runs back; keeps the memory.
    void clear() {
        runs_.clear();
        free_runs_.fill(no_index);
        next_block_ = 0;
        room_ = {};
    }
    //! \param count  > 0.
    //! \return the number of a run, whose windows are to be written.
    [[nodiscard]] Index take(Index count) {
        const auto size_class = static_cast<int>(std::bit_width(count - 1));
        Index& free_run = free_runs_[static_cast<std::size_t>(size_class)];
        if (free_run == no_index) {
            const std::size_t size = std::size_t{1} << size_class;
            if (room_.size() < size) open_block(size);
            const Index run = runs_.push({room_.data(), count, no_index, size_class});
            room_ = room_.subspan(size);
            return run;
        }
        const Index run = free_run;
        free_run = runs_[run].next;
        runs_[run].count = count;
        return run;
    }
    void give_back(Index run) {
        Index& free_run = free_runs_[static_cast<std::size_t>(runs_[run].size_class)];
        runs_[run].next = free_run;
        free_run = run;
    }

    [[nodiscard]] Index room(Index run) const { return Index{1} << runs_[run].size_class; }
    //! \param count  of windows that the run has from now on, up to its room.
    void resize(Index run, Index count) { runs_[run].count = count; }

    [[nodiscard]] std::span<Window> operator[](Index run) {
        return {runs_[run].first, runs_[run].count};
    }
    [[nodiscard]] std::span<const Window> operator[](Index run) const {
        return {runs_[run].first, runs_[run].count};
    }
    //! Starts to load the first windows of a run.
    [[gnu::always_inline]] void prefetch(Index run) const {
        const Window* const first = runs_[run].first;
        for (Index i = 0; i < 4; ++i) __builtin_prefetch(first + i);
    }
    //! A link of a run in use, for lists of its owner.
    [[nodiscard]] Index& next(Index run) { return runs_[run].next; }

    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum = runs_.bytes();
        for (const Block& block : blocks_) sum += block.size * sizeof(Window);
        return sum;
    }

private:
    struct Run {
        Window* first;
        Index count;
        Index next;
        int size_class;
    };
    struct Block {
        std::unique_ptr<Window[]> windows;
        std::size_t size;
    };

    // Blocks grow with what is in use, so that little is wasted both by short runs and by long
    // ones.
    [[gnu::noinline]] void open_block(std::size_t size) {
        constexpr std::size_t least = 64, most = 4096;
        while (next_block_ < blocks_.size() && blocks_[next_block_].size < size) ++next_block_;
        if (next_block_ == blocks_.size()) {
            const std::size_t wanted = blocks_.empty() ? least : 2 * blocks_.back().size;
            size = std::max(size, std::min(wanted, most));
            blocks_.push_back({std::make_unique_for_overwrite<Window[]>(size), size});
        }
        const Block& block = blocks_[next_block_++];
        room_ = {block.windows.get(), block.size};
    }

    RunArray<Run> runs_;
    std::array<Index, 33> free_runs_{};  // By size class: list of runs.
    std::vector<Block> blocks_;
    std::size_t next_block_ = 0;
    std::span<Window> room_;  // The free part of the block in use.
};

}  // namespace agvd
