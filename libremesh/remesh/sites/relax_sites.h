//! \file
//! Moves sites towards a centroidal Voronoi tessellation.
#pragma once

#include <span>

#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/relax_options.h"
#include "remesh/sites/sample_sites.h"

namespace remesh {

//! Lloyd's method with momentum: sites move towards the centroids of their cells, along the
//! surface. Sites on the boundary (barycentric coordinates of exactly 0) stay on it; sites at
//! boundary vertices do not move. The start may be as uneven as all sites at one place: sites that
//! are spread less evenly than random points, at any scale, are redistributed first.
//!
//! Sites that are too few for their triangulation to resemble the surface are not relaxed.
//! \param surface  prepared for the spacing of the sites.
//! \param sites    on surface.input(), as are those of the result.
//! \throw InvalidOption  an option is out of range.
//! \throw InvalidSites   a site is not on the surface.
//! \throw Cancelled      the progress callback returned false.
//! Cost: O(#F) every ten steps, O(#sites) each.
[[nodiscard]] RelaxResult relax_sites(const PreparedSurface& surface,
                                      std::vector<SurfacePoint> sites,
                                      const RelaxOptions& options = {});

//! sample_sites and relax_sites in one, coarse to fine: a quarter of the sites is sampled and
//! relaxed, the others are added in the middles between neighbours, and all are relaxed. Then most
//! sites have six neighbours. If there are too few sites or vertices for that, the two functions
//! are called in turn.
//!
//! \throw as these two functions.
[[nodiscard]] RelaxResult sample_relaxed_sites(const PreparedSurface& surface,
                                               const SamplingOptions& sampling,
                                               const RelaxOptions& options = {});

}  // namespace remesh
