//! \file
//! The curves of a surface that a mesh of it must reproduce: its boundary and its creases.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace remesh {

//! The two sides of a curve.
enum class Side : std::uint8_t {
    Left,  //!< Its half-edges run along the curve.
    Right  //!< They run against it.
};

//! A chain of edges between two nodes, or a closed one without any.
struct Curve {
    //! For each side its edges in the curve's order, as half-edges of the surface; empty where no
    //! face lies on that side.
    std::array<std::vector<agvd::Index>, 2> half_edges;
    std::vector<double> up_to;  //!< #edges + 1: length before each edge, then of all; mesh units.
    agvd::Index begin = agvd::no_index;  //!< Index into CurveNetwork::nodes; no_index: closed.
    agvd::Index end = agvd::no_index;    //!< Likewise.

    [[nodiscard]] std::size_t num_edges() const { return up_to.size() - 1; }
    [[nodiscard]] double length() const { return up_to.back(); }
    [[nodiscard]] bool is_closed() const { return begin == agvd::no_index; }
    [[nodiscard]] bool is_crease() const { return has(Side::Left) && has(Side::Right); }
    [[nodiscard]] const std::vector<agvd::Index>& on(Side side) const {
        return half_edges[static_cast<std::size_t>(side)];
    }
    [[nodiscard]] bool has(Side side) const { return !on(side).empty(); }
    //! The vertex before edge i, or after the last one. \param i  at most num_edges().
    [[nodiscard]] agvd::Index vertex(const agvd::Surface& surface, std::size_t i, Side side) const;
};

//! Every edge belongs to one curve at most. Nodes are where other than two of its edges meet, where
//! boundary and crease meet, and corners: where the network turns by more than 45 degrees and keeps
//! that turn over half a spacing.
struct CurveNetwork {
    std::vector<agvd::Index> nodes;  //!< Vertices of the surface, ascending.
    std::vector<Curve> curves;       //!< By lowest edge.
};

//! \param is_crease  #E: 1 for the edges of creases; boundary edges always belong to the network.
//! \param spacing    > 0, mesh units: of the sites.
//! Cost: O(#V + #E).
[[nodiscard]] CurveNetwork find_network(const agvd::Surface& surface,
                                        std::span<const std::uint8_t> is_crease, double spacing);

//! A loop of agvd::boundary_loops as a closed curve that begins at its first vertex. Cost: O(n).
[[nodiscard]] Curve curve_of_loop(const agvd::Surface& surface, std::vector<agvd::Index> loop);

//! Vertices (see Curve::vertex) where a curve turns by more than 45 degrees: at the vertex itself,
//! and between the chords to the points half a spacing before and after it, so that a rough curve
//! has no corners that sites at this spacing could not follow. Of several within half a spacing the
//! sharpest, and none so near an end. \return ascending. Cost: O(k log k + k c), c = corners.
[[nodiscard]] std::vector<std::size_t> corners_of_curve(const agvd::Surface& surface,
                                                        const Curve& curve, double spacing);

//! A point of a curve as one of the faces on a side of it.
//!
//! \param along  in [0, length]; taken modulo the length on closed curves.
//! \param side   one that the curve has.
//! Cost: O(log n).
[[nodiscard]] agvd::SurfacePoint point_on_curve(const Curve& curve, double along, Side side);

//! The direction of the curve there, of length 1.
[[nodiscard]] agvd::Vec3 tangent_of_curve(const agvd::Surface& surface, const Curve& curve,
                                          double along);

}  // namespace remesh
