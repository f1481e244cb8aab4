//! \file
//! Sites on the curves of a network, with a copy on each side of the cut.
#pragma once

#include <algorithm>

#include "remesh/features/close_rim.h"
#include "remesh/features/curve_network.h"
#include "remesh/features/cut_surface.h"

namespace remesh {

//! Vertices that the curves of a mesh get: one at each node, the others in order along each curve.
//! Each is a *group* of sites of the cut surface, its copies, one for each wedge or side.
struct CurveSites {
    std::vector<agvd::SurfacePoint> sites;    //!< Of all groups, on the cut surface.
    std::vector<agvd::Index> first_copy;      //!< #groups + 1: index into sites.
    std::vector<agvd::Index> first_of_curve;  //!< #curves + 1: its groups, besides nodes.
    //! #groups: place on its curve, mesh units; of nodes 0. Of closed curves it may leave
    //! [0, length].
    std::vector<double> along;
    //! #sites: the vertex that each becomes. A group becomes one, at a junction one for each sheet.
    std::vector<agvd::Index> vertex;
    agvd::Index num_vertices = 0;  //!< Of these.

    [[nodiscard]] agvd::Index num_groups() const { return static_cast<agvd::Index>(along.size()); }
    [[nodiscard]] agvd::Index num_nodes() const { return first_of_curve[0]; }
};

//! Where the sites of a curve belong: even at this measure.
//!
//! \return #edges + 1: spacings before each edge, then of all. An edge counts as its length over
//! the spacing, and up to twice that where the curve turns by more than 30 degrees over a spacing.
//! Cost: O(n log n).
[[nodiscard]] std::vector<double> spacings_along(const agvd::Surface& surface, const Curve& curve,
                                                 double spacing);

//! How many intervals each curve is divided into, so that they are about a spacing long but
//! no fewer than fewest_intervals.
[[nodiscard]] std::vector<agvd::Index> curve_intervals(const agvd::Surface& surface,
                                                       const CurveNetwork& network, double spacing);

//! The fewest that can be triangulated: three where a curve comes back to where it began, two where
//! another one has the same ends, or neither end belongs to another one, and of junctions.
[[nodiscard]] std::vector<agvd::Index> fewest_intervals(const CurveNetwork& network);

//! Vertices of the result on a network with so many intervals: those of junctions once for each
//! sheet, unless these are welded.
[[nodiscard]] std::size_t num_curve_vertices(const CurveNetwork& network,
                                             std::span<const agvd::Index> intervals);

//! The same of sites that are placed.
[[nodiscard]] inline agvd::Index num_result_vertices(const CurveNetwork& network,
                                                     const CurveSites& sites) {
    return network.is_welded() ? sites.num_groups() : sites.num_vertices;
}

//! Those of them on junctions.
[[nodiscard]] agvd::Index num_junction_vertices(const CurveNetwork& network,
                                                const CurveSites& sites);

//! Places at even distances by spacings_along.
//!
//! \param intervals  #curves, >= 1.
//! \return #curves: ascending, mesh units; the ends of a curve are not among them.
[[nodiscard]] std::vector<std::vector<double>> even_places(const agvd::Surface& surface,
                                                           const CurveNetwork& network,
                                                           double spacing,
                                                           std::span<const agvd::Index> intervals);

//! How many intervals such places divide each curve into.
[[nodiscard]] std::vector<agvd::Index> intervals_between(
    const CurveNetwork& network, std::span<const std::vector<double>> along);

//! Sites at such places, and at the nodes.
[[nodiscard]] CurveSites curve_sites_at(const CurveNetwork& network, const CutSurface& cut,
                                        std::span<const std::vector<double>> along);

//! Puts a group that is no node at another place of its curve, all copies of it.
//!
//! \param curve  the group's.
void move_along(const Curve& curve, agvd::Index group, double along, CurveSites& sites);

//! A directed edge of each triangulation of the sites: it has the surface on its left.
struct ChainEdge {
    agvd::Index from = agvd::no_index, to = agvd::no_index;  //!< Index into CurveSites::sites.
    agvd::Index curve = 0;
    agvd::Index interval = 0;  //!< Of the curve.
    agvd::Index side = 0;      //!< Index into its sides: also of the copy within a group.
};

//! Ends of edges, in their order.
[[nodiscard]] std::vector<DirectedEdge> ends_of(std::span<const ChainEdge> chain);

//! The same for each part of the surface, ascending.
//!
//! \param part_of  of a site: Index -> Index below num_parts.
template <typename PartOf>
[[nodiscard]] std::vector<std::vector<DirectedEdge>> chain_by_part(std::span<const ChainEdge> chain,
                                                                   agvd::Index num_parts,
                                                                   const PartOf& part_of) {
    std::vector<std::vector<DirectedEdge>> parts(num_parts);
    for (const ChainEdge& edge : chain) {
        parts[part_of(edge.from)].emplace_back(edge.from, edge.to);
    }
    for (std::vector<DirectedEdge>& part : parts) std::sort(part.begin(), part.end());
    return parts;
}

//! The group of each copy: #sites.
[[nodiscard]] std::vector<agvd::Index> groups_of_copies(const CurveSites& sites);

//! All, curve by curve, side by side.
[[nodiscard]] std::vector<ChainEdge> chain_edges(const CurveNetwork& network, const CutSurface& cut,
                                                 const CurveSites& sites);

}  // namespace remesh
