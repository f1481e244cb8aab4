//! \file
//! Exact geodesic distances by CGAL (Surface_mesh_shortest_path, Xin-Wang); the yardstick of tests
//! and comparisons. In target agvd::oracle, since these CGAL headers are GPL.
#pragma once

#include <span>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

struct NearestSites {
    std::vector<double> distance;  //!< #targets; infinity where no site reaches.
    std::vector<SiteId> site;      //!< #targets; invalid where no site reaches.
};

//! Exact distance (in double) and nearest site of each target, all sites at once.
[[nodiscard]] NearestSites exact_nearest_sites(const Surface& surface,
                                               std::span<const SurfacePoint> sites,
                                               std::span<const SurfacePoint> targets);

//! Exact distance of each target from one site.
[[nodiscard]] std::vector<double> exact_distances(const Surface& surface, const SurfacePoint& site,
                                                  std::span<const SurfacePoint> targets);

}  // namespace agvd
