//! \file
//! The closed-ball property: when it holds, the dual is homeomorphic to the surface. Where cells
//! violate it or the boundary, sites are moved or added. Private to remeshing.
#pragma once

#include "agvd/diagram/diagram.h"
#include "remesh/dual/build_dual.h"

namespace remesh {

//! One violation of the property, and points at which more sites help.
struct ClosedBallViolation {
    SiteId site;   //!< The cell.
    SiteId other;  //!< The second cell, if there are two.
    SiteReason reason = SiteReason::NoDisc;
    std::vector<SurfacePoint> remedies;  //!< Where to add sites.
    bool is_at_boundary = false;         //!< A cell meets the boundary twice, as in narrow strips.
};

//! Finds all violations of these conditions ([edelsbrunner1997]). Each cell is a disc with one
//! loop. Two cells meet in nothing or in one arc. No two Voronoi vertices have the same three
//! cells. A cell meets the boundary in nothing or in one arc. No single arc cuts the surface apart.
//! Degenerate Voronoi edges count as points.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(#V + size of the complex) and a sort.
[[nodiscard]] std::vector<ClosedBallViolation> find_closed_ball_violations(
    const Surface& surface, const Diagram& diagram, const Progress& progress = {});

//! #edges: true for an edge between two inner Voronoi vertices that coincide up to rounding. There
//! the dual may use either diagonal.
[[nodiscard]] std::vector<bool> find_degenerate_edges(const Surface& surface,
                                                      const Diagram& diagram, Ticker ticker = {});

//! Moves and new sites. After these fewer cells of inner sites meet the boundary.
struct BoundaryFixes {
    std::vector<std::pair<Index, SurfacePoint>> moved;  //!< Site and its new point, ascending.
    std::vector<SurfacePoint> added;
};

//! An inner site whose cell meets the boundary moves to the middle of its longest arc there. The
//! site nearest to a corner moves to it; if that is at another corner, a new site is placed. Both
//! lists are empty if nothing is to be done.
//!
//! Each move turns an inner site into a boundary site or fills a corner, and neither is undone.
//! \param corners  boundary vertices.
//! Cost: O(size of the complex + #sites).
[[nodiscard]] BoundaryFixes find_boundary_fixes(const Surface& surface, const Diagram& diagram,
                                                std::span<const SurfacePoint> sites,
                                                std::span<const Index> corners);

//! #sites: for each cell its Voronoi vertex farthest from the site (the first of equals); no_index
//! for cells without one. Cost: O(size of the complex).
[[nodiscard]] std::vector<Index> farthest_voronoi_vertices(const Diagram& diagram);

//! The farthest Voronoi vertices of the largest cells, the largest cell first, each once.
//! \param count  at most so many.
//! Cost: O(size of the complex + #sites log #sites).
[[nodiscard]] std::vector<Index> points_in_largest_cells(const Diagram& diagram, std::size_t count);

}  // namespace remesh
