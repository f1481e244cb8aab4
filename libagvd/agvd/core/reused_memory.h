//! \file
//! Arrays whose memory is used again: of short lists that are replaced, and of short runs that fill
//! and clear it.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
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

//! A vector of plain data that keeps its memory and does not initialize new elements. Its size is
//! stored, while std::vector computes it by a division. It grows by realloc, which moves pages
//! instead of copying them, and does not touch pages before they are used: the first touch of a
//! page costs as much as 50 windows.
template <typename T>
class RunArray {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    [[nodiscard]] Index size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] T& operator[](Index i) { return data_.get()[i]; }
    [[nodiscard]] const T& operator[](Index i) const { return data_.get()[i]; }
    [[nodiscard]] const T* begin() const { return data_.get(); }
    [[nodiscard]] const T* end() const { return data_.get() + size_; }

    void clear() { size_ = 0; }
    //! \return the place of the first of `count` new elements, which are to be written.
    Index extend(Index count) {
        const Index first = size_;
        if (count > capacity_ - size_) grow(count);
        size_ += count;
        return first;
    }
    //! \return its place.
    Index push(const T& element) {
        const Index place = extend(1);
        data_.get()[place] = element;
        return place;
    }
    [[nodiscard]] std::size_t bytes() const { return capacity_ * sizeof(T); }

private:
    struct Free {
        void operator()(T* data) const { std::free(data); }
    };

    [[gnu::noinline]] void grow(Index count) {
        constexpr Index least = 64;
        const Index capacity = std::max({capacity_ + capacity_ / 2, size_ + count, least});
        void* const grown = std::realloc(data_.get(), capacity * sizeof(T));
        if (grown == nullptr) throw std::bad_alloc();
        (void)data_.release();  // Realloc has freed it.
        data_.reset(static_cast<T*>(grown));
        capacity_ = capacity;
    }

    Index size_ = 0;
    Index capacity_ = 0;
    std::unique_ptr<T, Free> data_;
};

}  // namespace agvd
