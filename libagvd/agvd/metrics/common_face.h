//! \file
//! Points on edges and vertices as points of any of their faces. Private to the metrics.
#pragma once

#include <optional>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

//! The same point as a point of `face`; none if it does not lie in that face.
[[nodiscard]] std::optional<SurfacePoint> seen_from(const Surface& surface,
                                                    const SurfacePoint& point, Index face);

//! The faces that hold both of two different points: at most two. Cost: O(faces around a).
struct CommonFaces {
    Index first = no_index;   //!< no_index: none.
    Index second = no_index;  //!< Where both lie on one edge; no_index otherwise.
};
[[nodiscard]] CommonFaces common_faces(const Surface& surface, const SurfacePoint& a,
                                       const SurfacePoint& b);

}  // namespace agvd
