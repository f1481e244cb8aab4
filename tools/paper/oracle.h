//! \file
//! Exact geodesic distances by CGAL (Surface_mesh_shortest_path, [xin2009]); the yardstick of tests
//! and comparisons. In target agvd::oracle, since these CGAL headers are GPL.
#pragma once

#include <span>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"

namespace agvd {

//! The exact answer for some points of the surface.
struct NearestSites {
    std::vector<double> distance;  //!< #targets; infinity where no site reaches.
    std::vector<SiteId> site;      //!< #targets; invalid where no site reaches.
};

//! Exact distance of each target from one site; infinity where it does not reach. Only the part of
//! the surface that a shortest path to some target can touch is searched, so near targets are
//! cheap.
[[nodiscard]] std::vector<double> exact_distances(const Surface& surface, const SurfacePoint& site,
                                                  std::span<const SurfacePoint> targets);

//! exact_distances for many sites: the distances of targets[s] from sites[s].
//!
//! \param targets      as many lists as sites.
//! \param num_threads  >= 0; 0: all cores. Each site has a window tree of its own, alive only while
//!                     its targets are answered. Same result for any number.
[[nodiscard]] std::vector<std::vector<double>> exact_distances(
    const Surface& surface, std::span<const SurfacePoint> sites,
    std::span<const std::vector<SurfacePoint>> targets, int num_threads = 0);

//! Distance of each target from its nearest site by one search from all sites, as a user of CGAL
//! would ask for it; infinity where no site reaches. Too long where CGAL loses windows, which up to
//! at least 5.5 it does where several sources meet one on an edge.
//!
//! Cost: one window tree from all sites over the whole surface.
[[nodiscard]] std::vector<double> distances_by_one_search(const Surface& surface,
                                                          std::span<const SurfacePoint> sites,
                                                          std::span<const SurfacePoint> targets);

//! Exact distance (in double) and nearest site of each target; of equally near sites the lowest.
//!
//! Cost: distances_by_one_search, then a search from each site as far as the targets that it may be
//! nearest to.
[[nodiscard]] NearestSites exact_nearest_sites(const Surface& surface,
                                               std::span<const SurfacePoint> sites,
                                               std::span<const SurfacePoint> targets,
                                               int num_threads = 0);

}  // namespace agvd
