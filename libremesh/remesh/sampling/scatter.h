//! \file
//! Independent area-uniform points on one component.
#pragma once

#include "agvd/mesh/surface_point.h"
#include "remesh/topology/components.h"

namespace remesh::detail {

struct ScatteredPoint {
    agvd::SurfacePoint point;  //!< Strictly inside its face.
    agvd::Vec3 position;
};

//! `count` points, no two at one position; the same for the same seed and stream. Fewer only where
//! the component is so small for its coordinates that double cannot tell that many apart.
[[nodiscard]] std::vector<ScatteredPoint> scatter(const agvd::Surface& surface,
                                                  const Component& component, agvd::Index count,
                                                  std::uint64_t seed, std::uint64_t stream,
                                                  const agvd::Progress& progress = {});

}  // namespace remesh::detail
