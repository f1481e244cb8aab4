//! \file
//! Exact distances between single sites and points, by the window engine on what can lie between.
//! From a line or region it runs on the whole surface, as far as the points are.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "agvd/propagation/propagate.h"

namespace agvd {

struct SiteDistanceQuery {
    SiteId site;  //!< A point, or a shape behind the points.
    SurfacePoint point;
    double guess;  //!< About the distance, at best a little more; a bad one costs time only.
};

//! The exact distance of each query's point from its site; infinity where it does not reach. For
//! distances from points a point is moved by at most 1e-6 of its face's edges, so as to split the
//! faces decently.
//!
//! \param shapes       their `site` is not read.
//! \param num_threads  >= 0; 0: all cores. Same result for any number.
//! \throw Cancelled  the progress callback returned false.
//! Cost: for each site one exact search over the faces that lie within the largest of its guesses
//! in space; for each shape O(#F), and the windows within the largest of its guesses.
[[nodiscard]] std::vector<double> site_distances(
    const Surface& surface, std::span<const SurfacePoint> sites, std::span<const SiteShape> shapes,
    std::span<const SiteDistanceQuery> queries, int num_threads = 0, const Progress& progress = {});

}  // namespace agvd
