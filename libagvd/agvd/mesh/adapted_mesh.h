//! \file
//! A mesh in the arrays of another program, seen in place as far as their layout allows.
#pragma once

#include <type_traits>

#include "agvd/core/error.h"
#include "agvd/mesh/mesh_view.h"

namespace agvd {

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

//! Whether positions of such numbers need no copy if they stand in a row.
template <typename Scalar>
inline constexpr bool is_coordinate = std::is_same_v<Scalar, double>;
//! Whether corners of such numbers need no copy. A negative one becomes an index that is too large.
template <typename Scalar>
inline constexpr bool is_corner = std::is_integral_v<Scalar> && sizeof(Scalar) == sizeof(Index);

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(Index));

//! \throw InvalidInput  it cannot be an index.
template <typename Scalar>
[[nodiscard]] Index to_corner(Scalar corner, std::size_t face) {
    if (!(corner >= 0) || !(static_cast<double>(corner) < static_cast<double>(no_index))) {
        throw InvalidInput("face " + std::to_string(face) + " names vertex " +
                           std::to_string(corner) +
                           ", which is no index; vertices are counted from 0");
    }
    return static_cast<Index>(corner);
}

}  // namespace detail
}  // namespace agvd
