//! \file
//! A triangulation of sites with the topology of the surface: the dual of their cells or, more
//! roughly, of labels of the vertices. Where cells are no discs, narrow parts are simplified to
//! their sites, and only there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/distance_bounds.h"
#include "remesh/curves/glue.h"
#include "remesh/dual/build_dual.h"
#include "remesh/names.h"

namespace remesh::detail {

//! What becomes of sites that have no fan of triangles, such as those whose cells wrap around a rod
//! that is thinner than the spacing.
enum class Narrow : std::uint8_t {
    Leave,     //!< The triangles stay as they are.
    Simplify,  //!< The vertices around are removed one by one until the sites are left.
};

//! Triangles of sites and of what could not be removed.
struct SiteTriangles {
    //! Below #sites a corner is a site, from there on it is one of `extra`.
    std::vector<Triangle> triangles;
    //! Vertices without which the surface's topology could not be had, on the surface.
    std::vector<SurfacePoint> extra = {};
    //! Ascending: sites whose cells or labels are no discs, or whose triangles are no fan, and
    //! those where the rim is wrong.
    std::vector<Index> narrow = {};
    DualCounts counts = {};
};

//! \param surface  may be a Delta-complex.
//! \param labels   of its vertices: those of the cells, if these are given.
//! \param cells    the dual of these is made; null: each face whose corners have three labels
//!                 becomes a triangle. Then flips lead to the dual of the cells: see make_delaunay.
//! \param sites    on the surface. Of several at one position only one may get triangles.
//! \param chain    edges that the rim is to have: see close_rim. Empty: any rim will do.
//! Cost: O(n log n); where parts are simplified, that of simplify() for these.
[[nodiscard]] SiteTriangles triangulate_sites(const Surface& surface, const DistanceBounds& labels,
                                              const CellComplex* cells,
                                              std::span<const SurfacePoint> sites,
                                              std::span<const DirectedEdge> chain, Narrow narrow,
                                              Ticker ticker = {});

//! Removes the last sites, those of dividing points, and what could not be removed before.
//! \param num_kept  the number of sites without these.
//! \param sites     all, on the surface.
//! Cost: that of simplify() for the parts around these.
void remove_dividing(const Surface& surface, std::span<const SurfacePoint> sites, Index num_kept,
                     SiteTriangles& triangles, Ticker ticker = {});

}  // namespace remesh::detail
