//! \file
//! Sites on the surface: sampled or given, and relaxed.
#pragma once

#include "remesh/curves/curve_sites.h"

namespace remesh::detail {

struct Domain;
struct StageContext;

struct PlacedSites {
    //! On the cleaned surface. Sites of curves come first, with a copy for each side of the cut.
    std::vector<SurfacePoint> sites;
    CurveSites curves = {};             //!< The first of `sites`.
    std::vector<ChainEdge> chain = {};  //!< Edges along the curves that the dual must have.
    //! On the cleaned surface: see NetworkSites.
    std::vector<SurfacePoint> narrow_points = {};
    //! On the cleaned surface, and the chain with them: see NetworkSites.
    std::vector<SurfacePoint> dividing = {};
    std::vector<DirectedEdge> divided_chain = {};
};

//! Samples sites or takes the caller's, and relaxes them if the options ask for it.
//! \throw as sample_network_sites and relax_network_sites.
//! Cost: see these.
[[nodiscard]] PlacedSites place_sites(const Domain& domain, const StageContext& context);

}  // namespace remesh::detail
