//! \file
//! Sites on the curves of a network, with a copy on each side of the cut. Private to remeshing.
#pragma once

#include <functional>

#include "remesh/curves/curve_network.h"
#include "remesh/curves/glue.h"

namespace remesh {

//! The positions of vertices on the curves: one at each node, the others in order along each curve.
//! At each position is a *group* of sites of the cut surface: one copy for each wedge or side.
struct CurveSites {
    std::vector<SurfacePoint> sites;    //!< Of all groups, on the cut surface.
    std::vector<Index> first_copy;      //!< #groups + 1: index into sites.
    std::vector<Index> first_of_curve;  //!< #curves + 1: its first group; nodes come before.
    //! #groups: position on its curve, mesh units; 0 at nodes. May leave [0, length] on closed
    //! curves.
    std::vector<double> along;
    //! #sites: the vertex of the result. A group becomes one, at a junction one for each sheet.
    std::vector<Index> vertex;
    Index num_vertices = 0;  //!< Number of such vertices.

    [[nodiscard]] Index num_groups() const { return static_cast<Index>(along.size()); }
    [[nodiscard]] Index num_nodes() const { return first_of_curve[0]; }
};

//! Measures a curve in spacings. Its sites belong at even distances in this measure.
//! \return #edges + 1: spacings before each edge, then of the whole curve. An edge counts as its
//! length over the spacing, and up to twice that where the curve turns by more than 30 degrees over
//! a spacing.
//! Cost: O(n log n).
[[nodiscard]] std::vector<double> spacings_along(const Surface& surface, const Curve& curve,
                                                 double spacing);

//! The number of intervals of each curve: they are about a spacing long, but no fewer than
//! fewest_intervals.
[[nodiscard]] std::vector<Index> curve_intervals(const Surface& surface,
                                                 const CurveNetwork& network, double spacing,
                                                 const UnitAt& unit_at = {});

//! The fewest intervals that can be triangulated: three on a curve that returns to its start; two
//! on a junction, on a curve with the same ends as another, and on one whose ends belong to no
//! other curve; one otherwise, and on locked edges.
[[nodiscard]] std::vector<Index> fewest_intervals(const CurveNetwork& network);

//! The number of vertices of the result on a network with these intervals. Vertices of junctions
//! count once for each sheet, unless the sheets are welded.
[[nodiscard]] std::size_t num_curve_vertices(const CurveNetwork& network,
                                             std::span<const Index> intervals);

//! The same for placed sites.
[[nodiscard]] inline Index num_result_vertices(const CurveNetwork& network,
                                               const CurveSites& sites) {
    return network.is_welded() ? sites.num_groups() : sites.num_vertices;
}

//! The number of these vertices on junctions.
[[nodiscard]] Index num_junction_vertices(const CurveNetwork& network, const CurveSites& sites);

//! Places at even distances in the measure of spacings_along.
//! \param intervals  #curves, >= 1.
//! \return #curves: ascending, mesh units; without the ends of the curve.
[[nodiscard]] std::vector<std::vector<double>> even_positions(const Surface& surface,
                                                              const CurveNetwork& network,
                                                              double spacing,
                                                              std::span<const Index> intervals,
                                                              const UnitAt& unit_at = {});

//! The number of intervals into which such positions divide each curve.
[[nodiscard]] std::vector<Index> intervals_between(const CurveNetwork& network,
                                                   std::span<const std::vector<double>> along);

//! Sites at such positions and at the nodes.
[[nodiscard]] CurveSites curve_sites_at(const CurveNetwork& network, const CutSurface& cut,
                                        std::span<const std::vector<double>> along);

//! Moves all copies of a group that is not a node to another position of its curve.
//! \param curve  of the group.
void move_along(const Curve& curve, Index group, double along, CurveSites& sites);

//! A directed edge that each triangulation of the sites must have; the surface is on its left.
struct ChainEdge {
    Index from = no_index, to = no_index;  //!< Index into CurveSites::sites.
    Index curve = 0;
    Index interval = 0;  //!< Of the curve.
    Index side = 0;      //!< Index into Curve::sides, and of the copy within a group.
};

//! The ends of the edges, in the same order.
[[nodiscard]] std::vector<DirectedEdge> ends_of(std::span<const ChainEdge> chain);

//! The group of each copy: #sites.
[[nodiscard]] std::vector<Index> groups_of_copies(const CurveSites& sites);

//! All chain edges, by curve, then by side.
[[nodiscard]] std::vector<ChainEdge> chain_edges(const CurveNetwork& network, const CutSurface& cut,
                                                 const CurveSites& sites);

//! A triangle between an interval of a curve and one k times as long has an angle of at most 1/k.
//! So a first interval after a node that is more than eight times the shortest one there is divided
//! in equal proportions, unless the short curve ends a narrow strip, which sites do not widen.
//! \param along  #curves: positions between the ends of each, ascending; edited in place.
//! Cost: O(curves + sites).
void guard_corners(const Surface& surface, const CurveNetwork& network,
                   std::vector<std::vector<double>>& along);

}  // namespace remesh
