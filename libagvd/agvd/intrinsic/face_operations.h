//! \file
//! Flips and splits of a triangulation given by lengths, in place. Private to intrinsic.
#pragma once

#include "agvd/core/poller.h"
#include "agvd/intrinsic/face_charts.h"
#include "agvd/mesh/surface.h"

namespace agvd::detail {

//! The corner `d` opposite to a new edge as d = a * tail + b * head + c * apex of the half-edge
//! that the operation starts from; a + b + c = 1. A flip has c < 0, a split c = 0.
struct QuadShares {
    double tail = 0;
    double head = 0;
    double apex = 0;
};

//! Gives a height to every face that has less than `least_doubled_area`.
//! \return the number of such faces. Cost: O(#F).
Index raise_degenerate_faces(Surface& surface, int num_threads, Poller& poller);

//! Two faces with a common edge, laid out in one plane: the tail of the half-edge at (0, 0), the
//! apex on its left, the corner across on its right.
struct Quad {
    Vec2 head;
    Vec2 apex;
    Vec2 across;

    [[nodiscard]] double shortening() const;  //!< The other diagonal's length over the edge's.
    //! The edge fails the Delaunay condition, or all four corners lie on a circle and the other
    //! diagonal is shorter.
    [[nodiscard]] bool should_flip() const;
    [[nodiscard]] QuadShares shares() const;
    //! The quad is convex: both diagonals lie inside.
    [[nodiscard]] bool is_convex() const;
};

//! \param half_edge  has a twin.
[[nodiscard]] Quad quad_at(const Surface& surface, Index half_edge);
//! The same from the charts, in the chart of the half-edge's face. Flips use this.
[[nodiscard]] Quad quad_at(const Surface& surface, FaceCharts& charts, Index half_edge);

//! Replaces faces f = (a, b, c) and g = (b, a, d) at an edge by f = (a, d, c) and g = (d, b, c).
//! The edge keeps its number.
//! \param half_edge  of face f, from a to b; its twin lies in another face.
//! \param quad       the quad at the half-edge, from the charts.
void flip(Surface& surface, FaceCharts& charts, Index half_edge, const Quad& quad);

//! The result of splitting an edge. An edge on the boundary has one side only.
struct EdgeSplit {
    struct Side {
        Index half_edge = no_index;  //!< The half-edge, before the cut, of the face that was cut.
        Index new_face = no_index;
    };
    Side side[2];
    //! The half of the edge at its head. The other half keeps the number of the edge.
    Index new_edge = no_index;
};

//! Cuts the faces at an edge from a point of it to their apexes: face (a, b, c) becomes (a, m, c),
//! and (m, b, c) is added. The vertex m must be one of the mesh, without faces.
//! \param at  the position of m: its share of the way from the tail to the head, in (0, 1).
[[nodiscard]] EdgeSplit split_edge(Surface& surface, FaceCharts& charts, Index half_edge, double at,
                                   Index middle);

}  // namespace agvd::detail
