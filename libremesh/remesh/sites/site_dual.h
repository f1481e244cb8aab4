//! \file
//! Quick labels of the vertices, and sites between the sites that they are of.
#pragma once

#include <optional>

#include "agvd/propagation/distance_bounds.h"
#include "remesh/dual/site_mesh.h"
#include "remesh/sites/prepared_surface.h"

namespace remesh::detail {

//! Labels by distances along edges and straight across them: a few per cent too long, at the cost
//! of two sweeps over the edges.
//! \return  the labels of the vertices of surface.base.
[[nodiscard]] DistanceBounds label_vertices(const PreparedSurface& surface,
                                            std::span<const SurfacePoint> sites, int num_threads,
                                            const Progress& progress = {});

//! A point halfway between two sites whose labels meet.
struct Middle {
    Index low = 0, high = 0;  //!< The sites.
    double length = 0;        //!< Of a path between them.
    SurfacePoint point;       //!< On the input, off its boundary.
    //! A site that is there already; no_index: none, `point` is used.
    Index site = no_index;
};

//! A triangulation with the middles of its edges.
struct SiteDual {
    std::vector<Triangle> triangles;
    std::vector<Middle> middles;  //!< By (low, high): one for each pair that meets.
};

//! The middles between sites whose labels meet: by (low, high), one for each pair.
//! Cost: sorting the edges whose ends have two labels.
[[nodiscard]] std::vector<Middle> label_middles(const IntrinsicTriangulation& base,
                                                const DistanceBounds& labels);

//! Moves each site that labels boundary vertices onto the boundary: to a corner that it labels, or
//! to the point nearest by its labels, off the vertices, so that it can move along.
//! \param spacing  of the sites, at which corners are found (corners_of_curve).
//! Cost: that of label_vertices.
void move_to_boundary(const PreparedSurface& surface, double spacing, int num_threads,
                      const Progress& progress, std::vector<SurfacePoint>& sites);

//! Adds sites in the middles between neighbours, so that most sites have six neighbours. If these
//! are too many, the closest pairs get none; if they are too few, the largest triangles get one
//! site each. Nothing if that is not enough for `count` sites.
//! \param weights  #sites; new ones get the mean of the sites around them.
//! \param unit     #sites: of lengths at each; empty: mesh units.
//! Cost: O(n log n).
[[nodiscard]] std::optional<TriangulatedSites> subdivide(const Surface& surface,
                                                         const std::vector<SurfacePoint>& sites,
                                                         const std::vector<double>& weights,
                                                         const SiteDual& dual, Index count,
                                                         std::span<const double> unit = {});

}  // namespace remesh::detail
