//! \file
//! The size of a mesh, and scaling to a size where no power of a length overflows or vanishes.
#pragma once

#include <limits>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"

namespace agvd {

//! Of a mesh, along the axes. Without points: low is above high.
struct MeshBox {
    Vec3 low = Vec3::Constant(infinity);  //!< Least coordinates.
    Vec3 high = -low;                     //!< Largest ones.

    //! Whether no point was added.
    [[nodiscard]] bool is_empty() const { return low.x() > high.x(); }
    //! Mesh units; at most the largest double. 0 if empty.
    [[nodiscard]] double longest_side() const;
    //! Grows to hold the point.
    void add(const Vec3& point) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
    //! Grows to hold the box.
    void add(const MeshBox& other) {
        low = low.cwiseMin(other.low);
        high = high.cwiseMax(other.high);
    }
    //! Whether the boxes have a point in common.
    [[nodiscard]] bool meets(const MeshBox& other) const {
        return (low.array() <= other.high.array()).all() &&
               (other.low.array() <= high.array()).all();
    }
};

//! Of the faces' corners. Those that are not there or not finite are left out.
//!
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
//! Cost: O(#F).
[[nodiscard]] MeshBox box_of(const MeshView& mesh, int num_threads = 1);

//! Meshes whose longest side lies in [2^-max_scale, 2^max_scale] (about 1e-24 to 1e24) are computed
//! on as they are: the fourth powers of lengths a billion times shorter are still normal numbers.
inline constexpr int max_scale = 80;

//! Whether that is the longest side of a mesh that can be computed on, or 0.
[[nodiscard]] bool is_in_scale(double longest_side);

//! \throw InvalidInput  the box's longest side is out of scale.
void check_scale(const MeshBox& box);

//! \throw InvalidInput  the mesh lies so far from the origin that its coordinates have less than 10
//!        of their 53 bits left for its shape.
void check_digits(const MeshBox& box);

//! \param box  box_of(mesh).
//! \throw InvalidInput  a vertex is 10^10 times farther from the middle of the mesh than three
//!        quarters of its vertices: a mistake. The text names the vertex.
//! Cost: O(1), as it looks at up to 1000 vertices; O(#F) if it throws.
void check_spread(const MeshView& mesh, const MeshBox& box);

//! \throw InvalidInput  more than half of the area lies in faces that are narrower than 3e-11 of their
//!        length: nothing about such a surface can be told in double precision. The text names the
//!        longest.
//! \throw Cancelled     the ticker's progress callback returned false.
//! Cost: O(#F).
void check_width(const MeshView& mesh, Ticker& ticker);

//! The mesh times 2^exponent. Exact, unless a coordinate becomes subnormal. Cost: O(n).
[[nodiscard]] TriangleMesh scaled(const MeshView& mesh, int exponent);

}  // namespace agvd
