//! \file
//! The curves of a surface that a mesh of it must reproduce: its boundary, its creases, and the
//! junctions of sheets.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"
#include "remesh/features/junctions.h"

namespace remesh {

//! Where a face lies along a curve.
struct CurveSide {
    std::vector<agvd::Index> half_edges;  //!< Of the surface, in the curve's order.
    bool runs_along = true;               //!< The half-edges; else they run against the curve.
    agvd::Index sheet = 0;                //!< Equal for two sides that are one edge of the surface.
};

//! A chain of edges between two nodes, or a closed one without any. A boundary has one side, a
//! crease two of one sheet, a junction as many as faces meet there.
struct Curve {
    std::vector<CurveSide> sides;  //!< Those that run along it first; then by sheet.
    std::vector<double> up_to;  //!< #edges + 1: length before each edge, then of all; mesh units.
    agvd::Index begin = agvd::no_index;  //!< Index into CurveNetwork::nodes; no_index: closed.
    agvd::Index end = agvd::no_index;    //!< Likewise.
    agvd::Index num_sheets = 1;          //!< Above 1: a junction.

    [[nodiscard]] std::size_t num_edges() const { return up_to.size() - 1; }
    [[nodiscard]] double length() const { return up_to.back(); }
    [[nodiscard]] bool is_closed() const { return begin == agvd::no_index; }
    [[nodiscard]] bool is_junction() const { return num_sheets > 1; }
    [[nodiscard]] bool is_crease() const { return !is_junction() && sides.size() == 2; }
    //! The vertex before edge i, or after the last one.
    //! \param i  at most num_edges().
    [[nodiscard]] agvd::Index vertex(const agvd::Surface& surface, std::size_t i,
                                     std::size_t side = 0) const;
};

//! Every edge belongs to one curve at most. Nodes are where other than two of its edges meet, where
//! boundary and crease meet, where the sheets of a junction are joined otherwise before than
//! behind, and corners: where the network turns by more than 45 degrees and keeps that turn over
//! half a spacing.
struct CurveNetwork {
    std::vector<agvd::Index> nodes;  //!< Vertices of the surface, ascending; of copies the first.
    std::vector<Curve> curves;       //!< By lowest edge.
    //! The other copies of nodes at junctions, ascending: vertex, node.
    std::vector<std::pair<agvd::Index, agvd::Index>> copies;
    Junctions junctions = Junctions::Apart;  //!< What becomes of its sheets.

    [[nodiscard]] bool is_welded() const { return junctions == Junctions::Keep; }
};

//! \param is_crease  #E: 1 for the edges of creases; boundary edges always belong to the network,
//!                   and so do junctions.
//! \param spacing    > 0, mesh units: of the sites.
//! Cost: O(#V + #E).
[[nodiscard]] CurveNetwork find_network(const agvd::Surface& surface,
                                        std::span<const std::uint8_t> is_crease, double spacing,
                                        const JunctionSet& junctions = {});

//! A loop of agvd::boundary_loops as a closed curve that begins at its first vertex. Cost: O(n).
[[nodiscard]] Curve curve_of_loop(const agvd::Surface& surface, std::vector<agvd::Index> loop);

//! Vertices (see Curve::vertex) where a curve turns by more than 45 degrees: at the vertex itself,
//! and between the chords to the points half a spacing before and after it, so that a rough curve
//! has no corners that sites at this spacing could not follow. Of several within half a spacing the
//! sharpest, and none so near an end.
//! \return ascending.
//! Cost: O(k log k + k c), c = corners.
[[nodiscard]] std::vector<std::size_t> corners_of_curve(const agvd::Surface& surface,
                                                        const Curve& curve, double spacing);

//! A point of a curve as one of the faces on a side of it.
//!
//! \param along  in [0, length]; taken modulo the length on closed curves.
//! \param side   index into its sides.
//! Cost: O(log n).
[[nodiscard]] agvd::SurfacePoint point_on_curve(const Curve& curve, double along,
                                                std::size_t side = 0);

//! The direction of the curve there, of length 1.
[[nodiscard]] agvd::Vec3 tangent_of_curve(const agvd::Surface& surface, const Curve& curve,
                                          double along);

}  // namespace remesh
