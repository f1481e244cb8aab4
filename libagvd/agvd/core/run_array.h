//! \file
//! An array for many short runs that fill and clear it: it keeps its memory.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

#include "agvd/core/types.h"

namespace agvd {

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
    //! \return the index of the first of `count` new elements, which are to be written.
    Index extend(Index count) {
        const Index first = size_;
        if (count > capacity_ - size_) grow(count);
        size_ += count;
        return first;
    }
    //! \return its index.
    Index push(const T& element) {
        const Index index = extend(1);
        data_.get()[index] = element;
        return index;
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
