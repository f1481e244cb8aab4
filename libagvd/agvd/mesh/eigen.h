//! \file
//! Meshes as matrices of Eigen, as libigl has them: V of #V x 3 positions, F of #F x 3 corners.
#pragma once

#include <string>

#include "agvd/mesh/adapted_mesh.h"

namespace agvd {
namespace detail {

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
    if constexpr (detail::is_coordinate<typename V::Scalar>) {
        mesh.seen.positions = detail::rows_in_place<Vec3>(positions);
    }
    if constexpr (detail::is_corner<typename F::Scalar>) {
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

//! Numbers of someone else as a matrix of three columns, row by row.
template <typename Scalar>
using RowsOfThree = Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, 3, Eigen::RowMajor>>;

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
