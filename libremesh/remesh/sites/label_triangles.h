//! \file
//! A triangulation of the sites from labels of the vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agvd/propagation/distance_bounds.h"
#include "remesh/curves/glue.h"
#include "remesh/names.h"
#include "remesh/sites/prepared_surface.h"

namespace remesh::detail {

//! A triangulation of sites.
struct LabelTriangles {
    std::vector<Triangle> triangles;  //!< Of site indices.
    std::vector<Index> narrow;        //!< Ascending: sites whose labels cover no disc.
};

//! What becomes of labels that cover no disc, as those around a narrow part.
enum class NarrowLabels : std::uint8_t {
    Merge,  //!< Their sites lack a closed fan of triangles.
    //! Their vertices stay, and collapses of edges remove all but the one nearest to the site. They
    //! are merged if that fails.
    Reduce,
};

//! The surface with all vertices of a label merged into one: a triangle for each face whose corners
//! have three labels. Sites that label no vertex get one. If no narrow labels are merged the result
//! has the topology of the surface, and flips turn it into the dual of the cells: see
//! make_delaunay.
//! \param sites  on the surface, those that `labels` are of.
//! \param chain  edges that the rim is to have: see close_rim.
//! Cost: O(n log n); collapses take most of it where many parts are narrow.
[[nodiscard]] LabelTriangles triangulate_by_labels(const Surface& surface,
                                                   const DistanceBounds& labels,
                                                   std::span<const SurfacePoint> sites,
                                                   std::span<const DirectedEdge> chain = {},
                                                   NarrowLabels narrow = NarrowLabels::Reduce,
                                                   const Progress& progress = {});

//! Corrects labels, which are rough where cells hold few vertices: of the site that a label names
//! and those around it the nearest in space counts, if the surface faces the same side at both.
//! \param sites      on surface.input().
//! \param triangles  of the sites.
//! \param label      #V of surface.base.
//! Cost: O(n).
void correct_labels(const PreparedSurface& surface, std::span<const SurfacePoint> sites,
                    std::span<const Triangle> triangles, std::vector<Index>& label);

}  // namespace remesh::detail
