//! \file
//! Sites on the surface: sampled or given, and relaxed.
#pragma once

#include "remesh/curves/curve_sites.h"

namespace remesh::detail {

struct CleanedInput;
struct Domain;
struct StageContext;

struct PlacedSites {
    //! On the cleaned surface. Sites of curves come first, with a copy for each side of the cut.
    std::vector<SurfacePoint> sites;
    CurveSites curves = {};                    //!< The first of `sites`; empty without a plan.
    std::vector<ChainEdge> chain = {};         //!< Edges along the curves that the dual must have.
    std::vector<Index> boundary_corners = {};  //!< Boundary vertices that need a site, ascending.

    //! Copies of sites of curves, the first of each site excluded: they become no vertex of their
    //! own.
    [[nodiscard]] Index num_other_copies(const Domain& domain) const;
};

//! Samples sites or takes the caller's, and relaxes them if the options ask for it.
//! \throw as sample_relaxed_sites, relax_sites and to_cleaned.
//! Cost: see these.
[[nodiscard]] PlacedSites place_sites(const CleanedInput& cleaned, const Domain& domain,
                                      const StageContext& context);

}  // namespace remesh::detail
