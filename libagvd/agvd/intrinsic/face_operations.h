//! \file
//! Flips and splits of a triangulation by its lengths, in place. Private to intrinsic.
#pragma once

#include "agvd/mesh/surface.h"

namespace agvd::detail {

//! The corner `d` opposite to a new edge as d = a * tail + b * head + c * apex of the half-edge that
//! the operation starts from; a + b + c = 1. A flip has c < 0, a split c = 0.
struct QuadShares {
    double tail = 0;
    double head = 0;
    double apex = 0;
};

//! Twice the area of a face that has none, as a share of the square of its longest edge. Such a face
//! gets this height; that changes its lengths by less than rounding.
inline constexpr double least_doubled_area = 0x1p-50;

//! Gives a height to every face that has less than `least_doubled_area`.
//! \return the number of such faces. Cost: O(#F).
Index raise_flat_faces(Surface& surface);

//! Two faces with a common edge, laid out in the plane: tail of the half-edge at (0, 0), head at
//! (length, 0), apex above, the corner across below.
struct Quad {
    double length;
    Vec2 apex;
    Vec2 across;

    //! \param half_edge  has a twin.
    Quad(const Surface& surface, Index half_edge);

    [[nodiscard]] double flipped_length() const { return (apex - across).norm(); }
    //! The edge fails the Delaunay condition, or all four corners lie on a circle and the other
    //! diagonal is shorter.
    [[nodiscard]] bool should_flip() const;
    [[nodiscard]] QuadShares shares() const;
    //! Both diagonals lie inside.
    [[nodiscard]] bool is_convex() const;
};

//! Replaces faces f = (a, b, c) and g = (b, a, d) at an edge by f = (a, d, c) and g = (d, b, c). The
//! edge keeps its number.
//! \param half_edge  of face f, from a to b; its twin lies in another face.
void flip(Surface& surface, Index half_edge, const Quad& quad);

//! What splitting an edge has made. An edge on the boundary has one side only.
struct EdgeSplit {
    struct Side {
        Index half_edge = no_index;  //!< Of the face that was cut, before it was.
        Index new_face = no_index;
    };
    Side side[2];
    Index new_edge = no_index;  //!< The half of the edge at its head; the other keeps its number.
};

//! Cuts the faces at an edge from its middle to their apexes: face (a, b, c) becomes (a, m, c), and
//! (m, b, c) is added. The vertex m must be the last of the mesh, without faces.
[[nodiscard]] EdgeSplit split_edge(Surface& surface, Index half_edge, Index middle);

}  // namespace agvd::detail
