//! \file
//! CGAL's exact distances as one more method, if the build has CGAL.
#pragma once

#include <span>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "bench/timing.h"

namespace bench {

struct ExactRun {
    std::vector<double> vertex_distance;  //!< #V; infinity where no site reaches.
    Seconds taken;                        //!< On one core.
};

//! exact_nearest_sites of all vertices: one search from all sites, which alone is not reliable, and
//! one from each site as far as it may be nearest.
//! \throw agvd::InvalidOption  built without CGAL.
[[nodiscard]] ExactRun run_exact(const agvd::Surface& surface,
                                 std::span<const agvd::SurfacePoint> sites);

//! Error of vertex distances, relative to the exact ones.
struct VertexError {
    double mean = 0;
    double max = 0;
    double lowest = 0;  //!< Below 0: a distance shorter than exact.
};

//! \param ours, exact  #V; vertices that neither reaches are left out, infinite where only one does
//!                     or where only the exact one is 0.
[[nodiscard]] VertexError vertex_error(std::span<const double> ours, std::span<const double> exact);

}  // namespace bench
