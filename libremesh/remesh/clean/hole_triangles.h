//! \file
//! Triangles for a hole, by CGAL. Private to cleaning.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Triangulates a hole as CGAL's triangulate_hole_polyline does: the largest dihedral angle, then
//! the area, is as small as it can be.
//!
//! \param rim     the corners, in the order of the triangles to make.
//! \param beyond  the third corner of the face at each side of the rim; as many.
//! \return indices into rim; no triangles if none were found; unset in a build without CGAL.
//! Cost: O(n^2) where the Delaunay triangulation of the rim has a solution; otherwise O(n^3).
[[nodiscard]] std::optional<std::vector<Triangle>> triangulate_hole(std::span<const Vec3> rim,
                                                                    std::span<const Vec3> beyond);

}  // namespace remesh::detail
