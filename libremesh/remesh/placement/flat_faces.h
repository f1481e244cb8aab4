//! \file
//! Triangles without area, whose corners lie on one line.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! Whether the corners lie on one line up to rounding: the triangle is less than 1e-10 times as
//! high as it is long.
[[nodiscard]] bool is_flat(std::span<const Vec3> positions, const Triangle& triangle);

//! Flips the longest edge of each such triangle, so that its third corner divides the neighbour
//! beyond instead. The points of the surface stay where they are. A triangle stays whose longest
//! edge lies on the boundary, whose corners coincide, or whose flip would break the topology.
//!
//! \param positions  #V.
//! \param triangles  an oriented manifold; its boundary stays.
//! Cost: O(#triangles); O(#triangles log #triangles) if there are any.
void flip_flat_faces(std::span<const Vec3> positions, std::vector<Triangle>& triangles);

}  // namespace remesh
