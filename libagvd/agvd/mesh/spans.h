//! \file
//! Meshes as arrays: three coordinates for each vertex, three corners for each face.
#pragma once

#include <iterator>
#include <ranges>

#include "agvd/mesh/eigen.h"

namespace agvd {
namespace detail {

//! The numbers of a range: it holds numbers, three to an element, or structures of three.
template <typename Element>
struct NumberIn {
    using Type = std::remove_cvref_t<decltype(std::declval<const Element&>()[0])>;
};
template <typename Element>
requires std::is_arithmetic_v<Element>
struct NumberIn<Element> {
    using Type = Element;
};

//! A range of numbers, or of std::array, C arrays or vectors of three, as a matrix of three
//! columns.
//! \throw InvalidInput  the number of numbers is no multiple of three.
template <std::ranges::contiguous_range Range>
[[nodiscard]] auto rows_of(const Range& range, const char* name) {
    using Element = std::ranges::range_value_t<Range>;
    using Number = typename NumberIn<Element>::Type;
    constexpr std::size_t step = 3 * sizeof(Number) / sizeof(Element);
    static_assert(step * sizeof(Element) == 3 * sizeof(Number) && (step == 1 || step == 3),
                  "an element is a number, or three and nothing else");
    const auto size = static_cast<std::size_t>(std::ranges::size(range));
    if (size % step != 0) {
        throw InvalidInput("the array of " + std::string(name) + " has " + std::to_string(size) +
                           " numbers, which is no multiple of 3");
    }
    return RowsOfThree<Number>(reinterpret_cast<const Number*>(std::ranges::data(range)),
                               static_cast<Eigen::Index>(size / step), 3);
}

}  // namespace detail

//! A mesh of two arrays: std::vector, std::span, std::array, ... of numbers (x0 y0 z0 x1 ...), or
//! of structures of three that have [] (std::array, C arrays, most libraries' vectors). Doubles and
//! 32-bit integers are not copied.
//! \throw InvalidInput  a number of numbers is no multiple of three, or a corner that is copied is
//!        no index.
//! Cost: O(1) for what is not copied, else O(n).
template <std::ranges::contiguous_range Positions, std::ranges::contiguous_range Triangles>
[[nodiscard]] AdaptedMesh from_arrays(const Positions& positions, const Triangles& triangles) {
    return from_matrices(detail::rows_of(positions, "positions"),
                         detail::rows_of(triangles, "corners"));
}

}  // namespace agvd
