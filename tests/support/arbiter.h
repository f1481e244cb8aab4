//! \file
//! Exact geodesic distances, independent of CGAL and of the engines, to decide which is right if
//! they differ.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"

namespace arbiter {

struct Distances {
    std::vector<long double> distance;  //!< #targets; infinity where no site reaches.
    std::vector<agvd::SiteId> site;     //!< #targets: which one; any of those that tie.
};

//! Windows in long double, nearest first, dropped only where a vertex of their own edge is at least
//! as good for all of them (the safest test of [xin2009]); no trimming, no merging, no float. Every
//! length is that of a path on the surface: a point that rounding puts outside a window is reached
//! by a path that bends at the window's end.
//!
//! \param longest  the search ends there: greater distances are upper bounds, or infinite.
//! Cost: from one site half a second on 10 000 faces, half a minute on 100 000; less from more.
[[nodiscard]] Distances nearest_sites(
    const agvd::Surface& surface, std::span<const agvd::SurfacePoint> sites,
    std::span<const agvd::SurfacePoint> targets,
    long double longest = std::numeric_limits<long double>::infinity());

}  // namespace arbiter
