//! \file
//! What the libraries use of C++20 and libc++ 13, that of emscripten 3.1.6, does not have. The
//! compiler includes it before each source, so that no source knows of it.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <compare>
#include <concepts>
#include <cstring>
#include <functional>
#include <iterator>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

static_assert(_LIBCPP_VERSION < 14000, "look which of these libc++ has now");

//! Of the page: writes the shortest digits that read back as the number, which is finite and above
//! 0, without leading zeros.
//! \return 32 times the power of ten of the first digit, plus the number of digits.
extern "C" __attribute__((import_module("env"), import_name("shortest_digits"))) int
remesh_shortest_digits(double value, int is_float, char* digits);

namespace std {  // NOLINT(cert-dcl58-cpp)

template <typename To, typename From>
requires(sizeof(To) == sizeof(From)) constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

template <typename Array>
requires is_unbounded_array_v<Array> unique_ptr<Array> make_unique_for_overwrite(size_t count) {
    return unique_ptr<Array>(new remove_extent_t<Array>[count]);
}

//! There are no threads.
template <typename Value>
class atomic_ref {
public:
    explicit atomic_ref(Value& value) : value_(value) {}
    Value load(memory_order = memory_order_seq_cst) const noexcept { return value_; }
    void store(Value value, memory_order = memory_order_seq_cst) const noexcept { value_ = value; }
    Value fetch_add(Value more, memory_order = memory_order_seq_cst) const noexcept {
        return exchange(value_, value_ + more);
    }
    bool compare_exchange_weak(Value& expected, Value desired, memory_order = memory_order_seq_cst,
                               memory_order = memory_order_seq_cst) const noexcept {
        if (value_ != expected) {
            expected = value_;
            return false;
        }
        value_ = desired;
        return true;
    }

private:
    Value& value_;
};
template <typename Value>
atomic_ref(Value&) -> atomic_ref<Value>;

template <typename Value, size_t size>
requires requires(const Value& value) { value <=> value; }
constexpr auto operator<=>(const array<Value, size>& a, const array<Value, size>& b) {
    using Order = decltype(a[0] <=> b[0]);
    for (size_t i = 0; i < size; ++i) {
        if (const Order order = a[i] <=> b[i]; order != 0) return order;
    }
    return Order::equivalent;
}

template <typename Iterator, typename Less>
void sort_by_insertion(Iterator first, Iterator last, Less& less) {
    for (Iterator i = first; i < last; ++i) {
        auto value = std::move(*i);
        Iterator to = i;
        for (; to != first && less(value, to[-1]); --to) *to = std::move(to[-1]);
        *to = std::move(value);
    }
}

//! A sixth of the code of libc++'s for each type that is sorted, which were a tenth of the module.
//! Chosen instead, as it is constrained. Pivots from places without a pattern: O(n log n) expected.
template <typename Iterator, typename Less>
requires requires(Iterator at) { at[0]; }
void sort(Iterator first, Iterator last, Less less) {
    constexpr ptrdiff_t few = 12;
    unsigned place = 1;
    while (last - first > few) {
        place = place * 1664525U + 1013904223U;
        const auto pivot =
            first[static_cast<ptrdiff_t>((place >> 8U) % static_cast<unsigned>(last - first))];
        Iterator i = first, j = last - 1;
        while (i <= j) {
            while (less(*i, pivot)) ++i;
            while (less(pivot, *j)) --j;
            if (i > j) break;
            iter_swap(i, j);
            ++i;
            --j;
        }
        // The smaller part by recursion, so that the stack stays low.
        const bool is_low_smaller = j + 1 - first < last - i;
        if (is_low_smaller) {
            std::sort(first, j + 1, less);
            first = i;
        } else {
            std::sort(i, last, less);
            last = j + 1;
        }
    }
    sort_by_insertion(first, last, less);
}
template <typename Iterator>
requires requires(Iterator at) { at[0]; }
void sort(Iterator first, Iterator last) { std::sort(first, last, std::less<>{}); }

//! As std::inplace_merge. Moves the first part away and back.
template <typename Iterator, typename Less>
requires requires(Iterator at) { at[0]; }
void inplace_merge(Iterator first, Iterator middle, Iterator last, Less less) {
    vector<iter_value_t<Iterator>> moved(make_move_iterator(first), make_move_iterator(middle));
    auto from = moved.begin();
    for (; from != moved.end() && middle != last; ++first) {
        *first = less(*middle, *from) ? std::move(*middle++) : std::move(*from++);
    }
    std::move(from, moved.end(), first);
}

//! As std::stable_sort: O(n log n).
template <typename Iterator, typename Less>
requires requires(Iterator at) { at[0]; }
void stable_sort(Iterator first, Iterator last, Less less) {
    constexpr ptrdiff_t few = 12;
    const auto behind = [&](Iterator at, ptrdiff_t count) {
        return last - at > count ? at + count : last;
    };
    for (Iterator at = first; at != last; at = behind(at, few)) {
        sort_by_insertion(at, behind(at, few), less);
    }
    for (ptrdiff_t width = few; width < last - first; width *= 2) {
        for (Iterator at = first; last - at > width; at = behind(at, 2 * width)) {
            std::inplace_merge(at, at + width, behind(at, 2 * width), less);
        }
    }
}

namespace ranges {

namespace detail {
// Of an element of the range, as the projection shows it.
template <typename Test, typename Projection>
auto projected(Test& test, Projection& projection) {
    return [&](auto&&... elements) -> decltype(auto) {
        return std::invoke(test,
                           std::invoke(projection, std::forward<decltype(elements)>(elements))...);
    };
}
}  // namespace detail

template <typename Range, typename Test, typename Projection = identity>
constexpr bool all_of(Range&& range, Test test, Projection projection = {}) {
    return std::all_of(std::begin(range), std::end(range), detail::projected(test, projection));
}
template <typename Range, typename Test, typename Projection = identity>
constexpr bool any_of(Range&& range, Test test, Projection projection = {}) {
    return std::any_of(std::begin(range), std::end(range), detail::projected(test, projection));
}
template <typename Range, typename Test, typename Projection = identity>
constexpr bool none_of(Range&& range, Test test, Projection projection = {}) {
    return std::none_of(std::begin(range), std::end(range), detail::projected(test, projection));
}
template <typename Range, typename Test, typename Projection = identity>
constexpr auto find_if(Range&& range, Test test, Projection projection = {}) {
    return std::find_if(std::begin(range), std::end(range), detail::projected(test, projection));
}
template <typename Range, typename Test, typename Projection = identity>
constexpr auto find_if_not(Range&& range, Test test, Projection projection = {}) {
    return std::find_if_not(std::begin(range), std::end(range),
                            detail::projected(test, projection));
}
template <typename Range, typename Value, typename Projection = identity>
constexpr auto find(Range&& range, const Value& value, Projection projection = {}) {
    return std::find_if(std::begin(range), std::end(range), [&](const auto& element) {
        return std::invoke(projection, element) == value;
    });
}
template <typename Range, typename Test, typename Projection = identity>
constexpr auto count_if(Range&& range, Test test, Projection projection = {}) {
    return std::count_if(std::begin(range), std::end(range), detail::projected(test, projection));
}
template <typename Range, typename Value>
constexpr auto count(const Range& range, const Value& value) {
    return std::count(std::begin(range), std::end(range), value);
}
template <typename Range, typename Test>
constexpr auto adjacent_find(Range&& range, Test test) {
    return std::adjacent_find(std::begin(range), std::end(range), test);
}
template <typename Range, typename Each>
constexpr void for_each(Range&& range, Each each) {
    std::for_each(std::begin(range), std::end(range), each);
}
template <typename Range, typename Order = less, typename Projection = identity>
constexpr void sort(Range&& range, Order order = {}, Projection projection = {}) {
    std::sort(std::begin(range), std::end(range), detail::projected(order, projection));
}
template <typename Range, typename Order = less, typename Projection = identity>
void stable_sort(Range&& range, Order order = {}, Projection projection = {}) {
    std::stable_sort(std::begin(range), std::end(range), detail::projected(order, projection));
}
template <typename Range, typename Old, typename New>
constexpr void replace(Range&& range, const Old& before, const New& after) {
    std::replace_if(
        std::begin(range), std::end(range), [&](const auto& element) { return element == before; },
        after);
}
template <typename Range, typename Value, typename Order = less, typename Projection = identity>
constexpr auto lower_bound(Range&& range, const Value& value, Order order = {},
                           Projection projection = {}) {
    return std::lower_bound(std::begin(range), std::end(range), value,
                            [&](const auto& element, const Value& wanted) {
                                return order(std::invoke(projection, element), wanted);
                            });
}
template <typename Range, typename Value, typename Order = less, typename Projection = identity>
constexpr bool binary_search(const Range& range, const Value& value, Order order = {},
                             Projection projection = {}) {
    const auto found = ranges::lower_bound(range, value, order, projection);
    return found != std::end(range) && !order(value, std::invoke(projection, *found));
}
template <typename Range, typename Order = less, typename Projection = identity>
constexpr auto min_element(Range&& range, Order order = {}, Projection projection = {}) {
    return std::min_element(std::begin(range), std::end(range),
                            detail::projected(order, projection));
}
template <typename Range>
constexpr auto max_element(Range&& range) {
    return std::max_element(std::begin(range), std::end(range));
}
template <typename Range>
constexpr auto max(const Range& range) {
    return *ranges::max_element(range);
}
template <typename Range, typename Order = less, typename Projection = identity>
constexpr auto min(const Range& range, Order order = {}, Projection projection = {}) {
    return *ranges::min_element(range, order, projection);
}
template <typename Range>
constexpr auto minmax(const Range& range) {
    const auto [least, most] = std::minmax_element(std::begin(range), std::end(range));
    return std::pair(*least, *most);
}
template <typename Range, typename Out, typename Test>
constexpr void copy_if(const Range& range, Out out, Test test) {
    std::copy_if(std::begin(range), std::end(range), out, test);
}
template <typename Range, typename Out>
constexpr void set_difference(const Range& a, const Range& b, Out out) {
    std::set_difference(std::begin(a), std::end(a), std::begin(b), std::end(b), out);
}

}  // namespace ranges

//! The shortest text that reads back as the number: of fixed and scientific notation the shorter
//! one. `last` is 32 or more behind `first`.
to_chars_result to_chars(char* first, char* last, double value);
to_chars_result to_chars(char* first, char* last, float value);
//! As printf; not chars_format::hex.
to_chars_result to_chars(char* first, char* last, double value, chars_format format, int precision);

//! All NaN of one sign are equivalent.
template <>
weak_ordering weak_order(const double& a, const double& b);

}  // namespace std
