//! \file
//! Whether a result keeps ShapeBounds.
#pragma once

#include "remesh/pipeline/remesh.h"
#include "remesh/placement/placement.h"

namespace remesh::detail {

struct CurvedSurface;

//! The triangles that exceed the angles of some bounds, as the input forces it: between edges of
//! curves that meet at an acute corner, and between curves that are closer than the edges.
//! Cost: O(n).
[[nodiscard]] std::vector<ForcedFace> find_forced_faces(const CurvedSurface& curved,
                                                        const PlacedMesh& mesh,
                                                        const ShapeBounds& bounds);

//! \throw ConstraintUnmet  a triangle that is not forced exceeds a bound, or any the longest edge;
//!        the text names the worst one. Cost: O(n).
void require_bounds(const RemeshResult& result, const ShapeBounds& bounds);

}  // namespace remesh::detail
