//! \file
//! Moves sites towards a centroidal Voronoi tessellation.
#pragma once

#include <span>

#include "remesh/relax/prepared_surface.h"
#include "remesh/relax/relax_options.h"
#include "remesh/sampling/sample_sites.h"

namespace remesh {

//! Lloyd's method with momentum: sites move towards the centroids of their cells, along the
//! surface. Sites on the boundary (barycentric coordinates of exactly 0) stay on it, and those at
//! one of its vertices where they are. Starts may be as uneven as they like, all sites at one spot
//! included: where they are less evenly spread than random points, at any scale, they are moved
//! over first.
//!
//! Where sites are too few for their triangulation to resemble the surface, they stay where they
//! are.
//! \param surface  prepared for the spacing of the sites.
//! \param sites    on surface.input(), as are those of the result.
//! \throw agvd::InvalidOption  an option is out of range.
//! \throw agvd::InvalidInput   a site is not on the surface.
//! \throw agvd::Cancelled      the progress callback returned false.
//! Cost: O(#F) every ten steps, O(#sites) each.
[[nodiscard]] RelaxResult relax_sites(const PreparedSurface& surface,
                                      std::vector<agvd::SurfacePoint> sites,
                                      const RelaxOptions& options = {});

//! sample_sites and relax_sites in one, coarse to fine: a quarter of the sites is sampled and
//! relaxed, the others come in the middles between neighbours, and all are relaxed. Most sites have
//! six neighbours then. Where there are too few sites for that, or too few vertices, it is no more
//! than one after the other.
//!
//! \throw as these two.
[[nodiscard]] RelaxResult sample_relaxed_sites(const PreparedSurface& surface,
                                               const SamplingOptions& sampling,
                                               const RelaxOptions& options = {});

}  // namespace remesh
