//! \file
//! Exact distances between single sites and points, by the window engine on what can lie between.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"

namespace agvd {

struct SiteDistanceQuery {
    SiteId site;
    SurfacePoint point;
    double guess;  //!< About the distance, at best a little more; a bad one costs time only.
};

//! The exact distance of each query's point from its site; infinity where it does not reach. A
//! point is moved by at most 1e-6 of its face's edges, so as to split the faces decently.
//!
//! \param num_threads  >= 0; 0: all cores. Same result for any number.
//! \throw Cancelled  the progress callback returned false.
//! Cost: for each site one exact search over the faces that lie within the largest of its guesses
//! in space.
[[nodiscard]] std::vector<double> site_distances(const Surface& surface,
                                                 std::span<const SurfacePoint> sites,
                                                 std::span<const SiteDistanceQuery> queries,
                                                 int num_threads = 0,
                                                 const Progress& progress = {});

}  // namespace agvd
