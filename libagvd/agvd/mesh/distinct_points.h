//! \file
//! Finds points of a surface that coincide.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

//! A vertex, an edge or a face, and a position on it. It is equal for equal points, whichever of
//! its faces a point names.
struct PlaceOnSurface {
    //! Vertices first, then edges by their lower half-edge, then faces.
    std::uint64_t element = std::numeric_limits<std::uint64_t>::max();
    //! Vertex: 0. Edge: shares of the ends of that half-edge. Face: barycentric coordinates.
    std::array<double, 3> where{};

    auto operator<=>(const PlaceOnSurface&) const = default;
};

[[nodiscard]] PlaceOnSurface place_of(const Surface& surface, const SurfacePoint& point);

//! The points that do not lie exactly where an earlier one does, ascending. As sites the other
//! points own nothing, since ties go to the earlier site. Points of two parts of the surface at one
//! position
//! in space are different. Cost: O(#points log #points).
[[nodiscard]] std::vector<Index> distinct_points(const Surface& surface,
                                                 std::span<const SurfacePoint> points);

//! The chosen points, in the order of `chosen`.
[[nodiscard]] std::vector<SurfacePoint> points_of(std::span<const SurfacePoint> points,
                                                  std::span<const Index> chosen);

}  // namespace agvd
