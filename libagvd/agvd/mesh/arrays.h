//! \file
//! Meshes in arrays and matrices of other programs, seen in place as far as their layout allows:
//! three coordinates for each vertex, three corners for each face. Matrices are those of libigl.
//! Held by EigenAdapter and ArrayAdapter in tests/agvd/mesh.
#pragma once

#include <iterator>
#include <ranges>
#include <string>
#include <type_traits>

#include "agvd/core/error.h"
#include "agvd/mesh/mesh.h"

namespace agvd {

//! Numbers of someone else as a matrix of three columns, row by row.
template <typename Scalar>
using RowsOfThree = Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, 3, Eigen::RowMajor>>;

//! What agvd::from_matrices and agvd::from_arrays return. It must not outlive the arrays.
struct AdaptedMesh {
    MeshView seen;        //!< What needed no copy; the rest is empty.
    TriangleMesh copied;  //!< What had to be copied; the rest is empty.

    //! Every function of a MeshView takes an AdaptedMesh. The view must not outlive it.
    operator MeshView() const {
        return {copied.positions.empty() ? seen.positions : copied.positions,
                copied.triangles.empty() ? seen.triangles : copied.triangles};
    }
};

namespace detail {

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(Index));

//! \throw InvalidInput  it cannot be an index.
template <typename Scalar>
[[nodiscard]] Index to_corner(Scalar corner, std::size_t face) {
    if (!(corner >= 0) || !(static_cast<double>(corner) < static_cast<double>(no_index))) {
        throw InvalidInput("face " + std::to_string(face) + " names vertex " +
                           std::to_string(corner) +
                           ", which is not the index of a vertex; vertices are counted from 0");
    }
    return static_cast<Index>(corner);
}

//! The rows of a matrix in place, each an Element; empty if they are not one after the other.
template <typename Element, typename Matrix>
[[nodiscard]] std::span<const Element> rows_in_place(const Matrix& matrix) {
    if constexpr (Matrix::IsRowMajor && (Matrix::Flags & Eigen::DirectAccessBit) != 0) {
        if (matrix.innerStride() == 1 && matrix.outerStride() == 3) {
            return {reinterpret_cast<const Element*>(matrix.derived().data()),
                    static_cast<std::size_t>(matrix.rows())};
        }
    }
    return {};
}

template <typename Matrix>
void check_columns(const Matrix& matrix, const char* name) {
    if (matrix.cols() == 3 || matrix.rows() == 0) return;
    throw InvalidInput("the matrix of " + std::string(name) + " has " +
                       std::to_string(matrix.cols()) +
                       " columns; it must have 3 (transpose it if the rows are 3)");
}

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
//! \throw InvalidInput  the number of numbers is not a multiple of three.
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
                           " numbers, which is not a multiple of 3");
    }
    return RowsOfThree<Number>(reinterpret_cast<const Number*>(std::ranges::data(range)),
                               static_cast<Eigen::Index>(size / step), 3);
}

}  // namespace detail

//! A mesh of two matrices of any kind of number and storage order; also blocks, maps, expressions.
//! Rows of doubles, and rows of 32-bit integers, are not copied if they stand one after the other:
//! row-major matrices, or transposes of 3 x #V and 3 x #F ones in Eigen's usual order.
//! \throw InvalidInput  a matrix has not three columns, or a corner that is copied is no index.
//! Cost: O(1) for what is not copied, else O(n).
template <typename V, typename F>
[[nodiscard]] AdaptedMesh from_matrices(const Eigen::DenseBase<V>& positions,
                                        const Eigen::DenseBase<F>& triangles) {
    detail::check_columns(positions, "positions");
    detail::check_columns(triangles, "corners");
    AdaptedMesh mesh;
    using Corner = typename F::Scalar;
    if constexpr (std::is_same_v<typename V::Scalar, double>) {
        mesh.seen.positions = detail::rows_in_place<Vec3>(positions);
    }
    // A negative corner becomes an index that is too large.
    if constexpr (std::is_integral_v<Corner> && sizeof(Corner) == sizeof(Index)) {
        mesh.seen.triangles = detail::rows_in_place<Triangle>(triangles);
    }
    if (mesh.seen.positions.empty()) {
        const auto& v = positions.eval();
        mesh.copied.positions.reserve(static_cast<std::size_t>(v.rows()));
        for (Eigen::Index i = 0; i < v.rows(); ++i) {
            mesh.copied.positions.emplace_back(static_cast<double>(v(i, 0)),
                                               static_cast<double>(v(i, 1)),
                                               static_cast<double>(v(i, 2)));
        }
    }
    if (mesh.seen.triangles.empty()) {
        const auto& f = triangles.eval();
        mesh.copied.triangles.reserve(static_cast<std::size_t>(f.rows()));
        for (Eigen::Index i = 0; i < f.rows(); ++i) {
            const auto face = static_cast<std::size_t>(i);
            mesh.copied.triangles.push_back({detail::to_corner(f(i, 0), face),
                                             detail::to_corner(f(i, 1), face),
                                             detail::to_corner(f(i, 2), face)});
        }
    }
    return mesh;
}

//! A mesh of two arrays: std::vector, std::span, std::array, ... of numbers (x0 y0 z0 x1 ...), or
//! of structures of three that have [] (std::array, C arrays, most libraries' vectors). Doubles and
//! 32-bit integers are not copied.
//! \throw InvalidInput  a number of numbers is not a multiple of three, or a corner that is copied is
//!        no index.
//! Cost: O(1) for what is not copied, else O(n).
template <std::ranges::contiguous_range Positions, std::ranges::contiguous_range Triangles>
[[nodiscard]] AdaptedMesh from_arrays(const Positions& positions, const Triangles& triangles) {
    return from_matrices(detail::rows_of(positions, "positions"),
                         detail::rows_of(triangles, "corners"));
}

//! Positions or triangles as a matrix of three columns, in place; any matrix can be made of it:
//!     Eigen::MatrixXd V = agvd::matrix_of(mesh.positions);
//!     Eigen::MatrixXi F = agvd::matrix_of(mesh.triangles).cast<int>();
[[nodiscard]] inline RowsOfThree<double> matrix_of(std::span<const Vec3> positions) {
    return {reinterpret_cast<const double*>(positions.data()),
            static_cast<Eigen::Index>(positions.size()), 3};
}
//! The same for triangles.
[[nodiscard]] inline RowsOfThree<Index> matrix_of(std::span<const Triangle> triangles) {
    return {reinterpret_cast<const Index*>(triangles.data()),
            static_cast<Eigen::Index>(triangles.size()), 3};
}

}  // namespace agvd
