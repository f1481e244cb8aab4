//! \file
//! Memory for many short lists that are replaced from time to time.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "agvd/core/types.h"

namespace agvd {

//! Some consecutive elements of a BlockPool.
struct Block {
    Index begin = 0;
    Index count = 0;

    [[nodiscard]] Index end() const { return begin + count; }
};

//! Blocks of elements. A block does not move until it is released, so that its elements can be
//! named by place. A released block goes to a free list and is used again for the same number of
//! elements.
template <typename T>
class BlockPool {
public:
    //! With released blocks.
    [[nodiscard]] Index size() const { return static_cast<Index>(elements_.size()); }
    void reserve(std::size_t size) { elements_.reserve(size); }

    [[nodiscard]] T& operator[](Index i) { return elements_[i]; }
    [[nodiscard]] const T& operator[](Index i) const { return elements_[i]; }
    [[nodiscard]] std::span<T> operator[](const Block& block) {
        return std::span(elements_).subspan(block.begin, block.count);
    }
    [[nodiscard]] std::span<const T> operator[](const Block& block) const {
        return std::span(elements_).subspan(block.begin, block.count);
    }

    //! All elements, released ones among them.
    [[nodiscard]] auto begin() { return elements_.begin(); }
    [[nodiscard]] auto end() { return elements_.end(); }

    //! \param elements  must not lie in this pool.
    [[nodiscard]] Block add(std::span<const T> elements) {
        const auto count = static_cast<Index>(elements.size());
        if (count == 0) return {};
        if (count < released_.size() && !released_[count].empty()) {
            const Index begin = released_[count].back();
            released_[count].pop_back();
            std::copy(elements.begin(), elements.end(), elements_.begin() + begin);
            return {begin, count};
        }
        const Index begin = size();
        elements_.insert(elements_.end(), elements.begin(), elements.end());
        return {begin, count};
    }

    void release(const Block& block) {
        if (block.count == 0) return;
        if (block.count >= released_.size()) released_.resize(block.count + 1);
        released_[block.count].push_back(block.begin);
    }

private:
    std::vector<T> elements_;
    std::vector<std::vector<Index>> released_;  // By count: where such blocks begin.
};

}  // namespace agvd
