//! \file
//! Parts of a mesh around some of its vertices, and of the surface under them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh::detail {

//! #V: the number of edges to the nearest of some vertices, at most `most`; no_index: farther.
//! \param num_vertices   #V.
//! \param is_left_out  #triangles: 1 for those without whose edges it counts; or empty.
//! Cost: O(n).
[[nodiscard]] std::vector<Index> rings_around(std::span<const Triangle> triangles,
                                              std::size_t num_vertices,
                                              std::span<const Index> vertices, Index most,
                                              std::span<const std::uint8_t> is_left_out = {});

//! The faces in which some points lie, and those on the way to which no face is farther than
//! `radius` in space from the point where the way began. Not all that are so near: the first way to
//! a face counts.
//! \return ascending. Cost: O(n log n), n = faces found.
[[nodiscard]] std::vector<Index> faces_around(const Surface& surface,
                                              std::span<const SurfacePoint> points, double radius);

}  // namespace remesh::detail
