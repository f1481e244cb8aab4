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

//! What becomes of labels that cover no disc, such as the cells around a rod that is thinner than
//! the spacing.
enum class NarrowLabels : std::uint8_t {
    Merge,     //!< They are merged as all others: the triangles around are no fan.
    Simplify,  //!< Their components are simplified to their sites: see simplify_merged.
};

//! The result of triangulate_by_labels().
struct LabelTriangles {
    std::vector<Triangle> triangles;  //!< Of sites.
    //! Ascending: sites whose labels are no disc, or around which merged labels are no fan, and
    //! those where the rim is wrong.
    std::vector<Index> narrow = {};
    Index num_simplified = 0;  //!< Components.
};

//! The surface with all vertices of a label merged into one: a triangle for each face whose corners
//! have three labels. Sites that label no vertex get one. If each label covers a disc the result
//! has the topology of the surface, and flips turn it into the dual of the cells: see
//! make_delaunay.
//! \param sites  on the surface, those that `labels` are of.
//! \param chain  edges that the rim is to have: see close_rim.
//! Cost: O(n log n).
[[nodiscard]] LabelTriangles triangulate_by_labels(const Surface& surface,
                                                   const DistanceBounds& labels,
                                                   std::span<const SurfacePoint> sites,
                                                   std::span<const DirectedEdge> chain = {},
                                                   NarrowLabels narrow = NarrowLabels::Merge,
                                                   Ticker ticker = {});

//! Corrects labels, which are rough where cells hold few vertices: of the site that a label names
//! and those around it the nearest in space counts, if the surface faces the same side at both.
//! \param sites      on surface.input().
//! \param triangles  of the sites.
//! \param label      #V of surface.base.
//! Cost: O(n).
void correct_labels(const PreparedSurface& surface, std::span<const SurfacePoint> sites,
                    std::span<const Triangle> triangles, std::vector<Index>& label);

}  // namespace remesh::detail
