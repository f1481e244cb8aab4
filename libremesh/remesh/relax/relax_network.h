//! \file
//! Sites on a surface that is cut along a network of curves.
#pragma once

#include "remesh/relax/relax_sites.h"
#include "remesh/sampling/network_plan.h"

namespace remesh {

struct NetworkSites {
    CurveSites curves;                      //!< Of the curves, with their copies.
    std::vector<agvd::SurfacePoint> sites;  //!< The copies, then the inner ones.
    std::vector<RelaxLevel> levels;         //!< Coarse to fine; empty: they were not relaxed.
};

//! As many sites as asked for, those of curves counted as often as vertices come of them, and
//! relaxes them, coarse to fine: those of curves slide along these.
//!
//! \param surface   of plan.cut.surface.
//! \param plan  its network needs no more than sampling.num_samples vertices.
//! \param options   boundary and corners do not count.
//! \throw as sample_relaxed_sites.
[[nodiscard]] NetworkSites sample_network_sites(const PreparedSurface& surface,
                                                const NetworkPlan& plan,
                                                const SamplingOptions& sampling,
                                                const RelaxOptions& options);

//! The same from sites that are there, all at once.
//!
//! \param curves  sites of plan.network. \param inner  the others: inside faces, or on edges and
//!                vertices off the curves.
[[nodiscard]] NetworkSites relax_network_sites(const PreparedSurface& surface,
                                               const NetworkPlan& plan, CurveSites curves,
                                               std::span<const agvd::SurfacePoint> inner,
                                               const RelaxOptions& options);

}  // namespace remesh
