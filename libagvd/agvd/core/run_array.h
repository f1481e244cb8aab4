//! \file
//! Memory that many short runs fill and clear.
#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>

#include "agvd/core/types.h"

namespace agvd {

//! A vector of plain data that never gives memory back and leaves what is new unwritten unless
//! pushed. Its size is one number, which std::vector must work out by a division.
template <typename T>
class RunArray {
    static_assert(std::is_trivially_destructible_v<T>);

public:
    [[nodiscard]] Index size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] T& operator[](Index i) { return data_[i]; }
    [[nodiscard]] const T& operator[](Index i) const { return data_[i]; }
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
        data_[place] = element;
        return place;
    }
    [[nodiscard]] std::size_t bytes() const { return capacity_ * sizeof(T); }

private:
    [[gnu::noinline]] void grow(Index count) {
        constexpr Index least = 64;
        capacity_ = std::max({2 * capacity_, size_ + count, least});
        auto grown = std::make_unique_for_overwrite<T[]>(capacity_);
        std::copy(begin(), end(), grown.get());
        data_ = std::move(grown);
    }

    Index size_ = 0;
    Index capacity_ = 0;
    std::unique_ptr<T[]> data_;
};

}  // namespace agvd
