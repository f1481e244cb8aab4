//! \file
//! What relaxation can be asked for, and what it gives.
#pragma once

#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface_point.h"
#include "remesh/sampling/sample_sites.h"

namespace remesh {

struct RelaxOptions {
    int steps = 60;  //!< >= 0; coarse to fine, on each level.
    //! Stops where ten steps lower the energy by less than this share, >= 0.
    double tolerance = 1e-4;
    std::vector<std::uint8_t> is_fixed = {};  //!< #sites: 1 for sites that stay; or empty.
    Boundary boundary = Boundary::Keep;       //!< Inner sites whose cells meet it move onto it...
    std::vector<agvd::Index> corners = {};    //!< ...and the nearest ones to these vertices of it.
    int num_threads = 0;  //!< >= 0; 0: all cores. The same bytes for any number.
    agvd::Progress progress = {};
};

//! A number of sites that was relaxed.
struct RelaxLevel {
    agvd::Index num_sites = 0;
    //! Before the first step and after each: the sum over the cells of the integral of the squared
    //! distance from the site, mesh units to the fourth; on the sites' triangulation.
    std::vector<double> energy;
};

struct RelaxResult {
    std::vector<agvd::SurfacePoint> sites;
    std::vector<RelaxLevel> levels;  //!< Coarse to fine.
};

}  // namespace remesh
