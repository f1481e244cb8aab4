//! \file
//! Sites on a surface that is cut along a network of curves.
#pragma once

#include "remesh/sites/network_plan.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/sites.h"

namespace remesh {

struct NetworkSites {
    CurveSites curves;                //!< Of the curves, with their copies.
    std::vector<SurfacePoint> sites;  //!< The copies on curves, then the inner sites.
    std::vector<RelaxLevel> levels;   //!< Coarse to fine; empty: not relaxed.
    //! Inner sites of the coarse level, on surface.input(), whose cells wrap around narrow parts.
    std::vector<SurfacePoint> narrow_points;
    //! Relaxation divided locked edges that are longer than the spacing with sites of these points,
    //! on surface.input(). They are no vertices of the result, but its cells are those of all.
    std::vector<SurfacePoint> dividing = {};
    //! The edges along all curves with these sites, which follow `sites`; empty if there are none.
    std::vector<DirectedEdge> divided_chain = {};
};

//! Samples and relaxes sites, coarse to fine; sites of curves slide along these. The result has
//! sampling.num_samples vertices: a site of a curve counts as often as it becomes a vertex.
//! \param surface   of plan.cut.surface().
//! \param plan      its network needs at most sampling.num_samples vertices.
//! \param options   boundary and is_fixed are ignored.
//! \throw as sample_sites and relax_sites.
[[nodiscard]] NetworkSites sample_network_sites(const PreparedSurface& surface,
                                                const NetworkPlan& plan,
                                                const SamplingOptions& sampling,
                                                const RelaxOptions& options);

//! The same from given sites, on one level.
//! \param curves  sites of plan.network.
//! \param inner   the other sites: inside faces, or on edges and vertices off the curves.
[[nodiscard]] NetworkSites relax_network_sites(const PreparedSurface& surface,
                                               const NetworkPlan& plan, CurveSites curves,
                                               std::span<const SurfacePoint> inner,
                                               const RelaxOptions& options);

}  // namespace remesh
