//! \file
//! The size of a mesh, and scaling to a size where no power of a length overflows or vanishes.
#pragma once

#include "agvd/mesh/mesh_view.h"

namespace agvd {

//! Longest side of the box of the faces' corners, mesh units; 0 without faces. Corners that do not
//! exist or are not finite are left out. Cost: O(#F).
[[nodiscard]] double extent(const MeshView& mesh);

//! Meshes whose extent lies in [2^-max_scale, 2^max_scale] (about 1e-24 to 1e24) are used without
//! scaling: the fourth powers of lengths a billion times shorter are still normal numbers.
inline constexpr int max_scale = 80;

//! Whether an extent is in that range, or 0.
[[nodiscard]] bool is_in_scale(double extent);

//! \throw InvalidInput  the extent is out of scale. Cost: O(#F).
void check_scale(const MeshView& mesh);

//! \throw InvalidInput  the mesh lies so far from the origin that its coordinates have less than 10
//!        of their 53 bits left for its shape. Cost: O(#F).
void check_digits(const MeshView& mesh);

//! The mesh times 2^exponent. Exact, unless a coordinate becomes subnormal. Cost: O(n).
[[nodiscard]] TriangleMesh scaled(const MeshView& mesh, int exponent);

}  // namespace agvd
