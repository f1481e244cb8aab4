//! \file
//! Independent area-uniform points on one component.
#pragma once

#include <algorithm>
#include <array>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/topology.h"
#include "remesh/sites/size_field.h"

namespace remesh::detail {

//! Least barycentric coordinate of a point inside a face. It keeps points off edges by more than
//! the rounding of any position, and biases the density by no more than this share.
inline constexpr double interior_margin = 1e-6;

//! Moves a point of a face off its edges by at least that, where it is nearer.
inline void keep_inside(std::array<double, 3>& barycentric) {
    double sum = 0;
    for (double& b : barycentric) sum += b = std::max(b, interior_margin);
    for (double& b : barycentric) b /= sum;
}

struct ScatteredPoint {
    SurfacePoint point;  //!< Strictly inside its face.
    Vec3 position;
};

//! Draws `count` points, no two at one position; the same for the same seed and stream. There are
//! fewer only if the component is so small for its coordinates that double holds no more.
//! \param sizes  points are uniform by area in squares of the local length; null: by area.
[[nodiscard]] std::vector<ScatteredPoint> scatter(const Surface& surface,
                                                  const Component& component, Index count,
                                                  std::uint64_t seed, std::uint64_t stream,
                                                  const Progress& progress = {},
                                                  const SizeField* sizes = nullptr);

}  // namespace remesh::detail
