//! \file
//! Sites that lie on one another.
#pragma once

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace remesh {

//! The sites without those that lie exactly where an earlier one lies, in their order. Such a site
//! owns nothing, as ties go to the earlier one, but each one costs as much as any other, and many
//! on one spot far more. Points of two parts of the surface at one position in space are different.
//!
//! \param sites  points of the surface; one on an edge counts as on either face.
//! Cost: O(#sites log #sites).
[[nodiscard]] std::vector<agvd::SurfacePoint> distinct_sites(
    const agvd::Surface& surface, const std::vector<agvd::SurfacePoint>& sites);

}  // namespace remesh
