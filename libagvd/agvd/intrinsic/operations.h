//! \file
//! Flips, splits, insertion and removal of vertices in a triangulation given by lengths, in place.
//! Gaps of removed elements: corners, edge_half or outgoing are no_index. Private.
#pragma once

#include <algorithm>
#include <cmath>

#include "agvd/core/progress.h"
#include "agvd/intrinsic/charts.h"
#include "agvd/intrinsic/history.h"

namespace agvd::detail {

//! Twice the area that a degenerate face gets, as a share of the square of its longest edge. That
//! changes its lengths by less than rounding.
inline constexpr double least_doubled_area = 0x1p-50;

//! The least length of an edge as a share of the longest beside it: rounding might give 0.
inline constexpr double least_length = 0x1p-50;

//! Sets the three apexes of a face from its chart. The lengths of sides are those of the chart,
//! which may differ from the edges' lengths by rounding.
void set_apexes(Surface& surface, Index face, const FaceChart& chart);

//! Makes two half-edges twins, with an edge; the twin may be no_index.
void join(Surface& surface, Index half_edge, Index twin, Index edge);

//! Gives an outgoing half-edge to vertices that have none: on the boundary the one without twin.
void renew_outgoing(Surface& surface, std::span<const Index> faces);

//! Removes the outgoing half-edges that lie in faces that are about to change.
void forget_outgoing(Surface& surface, std::span<const Index> faces);

//! Adds a vertex without faces, at the origin.
Index add_vertex(Surface& surface);

//! Gives a height to every face that has less than `least_doubled_area`. Cost: O(#F).
void raise_degenerate_faces(Surface& surface, int num_threads, Poller& poller);

//! Two faces with a common edge, laid out in one plane: the tail of the half-edge at (0, 0), the
//! apex on its left, the corner across on its right.
struct Quad {
    Vec2 head;
    Vec2 apex;
    Vec2 across;

    //! The other diagonal's length over the edge's.
    [[nodiscard]] double shortening() const { return (apex - across).norm() / head.norm(); }
    //! The edge fails the Delaunay condition: the angles opposite to it sum to more than pi. Where
    //! the corners are nearly on a circle: the other diagonal is shorter.
    [[nodiscard]] bool should_flip() const {
        constexpr double on_circle = 1e-9;  // Of the sine of the sum, and of lengths.
        const double cos_apex = (-apex).dot(head - apex), sin_apex = cross(head, apex);
        const double cos_across = (-across).dot(head - across), sin_across = cross(across, head);
        const double scale =
            apex.norm() * (head - apex).norm() * across.norm() * (head - across).norm();
        const double sine = cos_apex * sin_across + sin_apex * cos_across;
        if (std::abs(sine) > on_circle * scale) return sine < 0;
        return head.norm() > (1 + on_circle) * (apex - across).norm();
    }
    [[nodiscard]] QuadShares shares() const {
        const double longest = std::max({head.norm(), apex.norm(), (head - apex).norm()});
        const double whole = std::max(cross(head, apex), least_doubled_area * longest * longest);
        return {cross(head - across, apex - across) / whole, cross(across, apex) / whole,
                -cross(across, head) / whole};
    }
    //! The quad is convex: both diagonals lie inside.
    [[nodiscard]] bool is_convex() const {
        // A diagonal that is as short as the rounding of the sides may have length 0.
        if ((apex - across).norm() <= least_length * std::max(apex.norm(), across.norm())) {
            return false;
        }
        constexpr double least_share = 1e-13;  // With less the quad has no corner there.
        const QuadShares share = shares();
        const double sum = std::abs(share.tail) + std::abs(share.head) - share.apex;
        return share.tail > least_share * sum && share.head > least_share * sum;
    }
    //! Of the triangle at the head after a flip: its doubled area over the squares of its sides.
    [[nodiscard]] double quality_behind() const {
        const Vec2 a = apex - head, b = across - head;
        return std::abs(cross(a, b)) / (a.squaredNorm() + b.squaredNorm() + (a - b).squaredNorm());
    }
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

//! Makes a gap of a face.
void bury(Surface& surface, Index face);

//! Lays a face out after its lengths have changed; no triangle gets the least height.
void renew_face(Surface& surface, FaceCharts& charts, Index face);

//! Cuts face (a, b, c) into (a, b, m), and the new faces (b, c, m) and (c, a, m).
//! \param where  barycentric coordinates of m, > 0.
//! \param vertex  m, which has no faces.
void insert_in_face(Surface& surface, FaceCharts& charts, Index face,
                    const std::array<double, 3>& where, Index vertex);

//! Removes an inner vertex of three edges: its three faces become one, the first of them.
//! \param half_edge  leaves the vertex.
void remove_from_face(Surface& surface, FaceCharts& charts, Index half_edge);

//! Removes a vertex of the boundary that has two faces. They become one, whose boundary edge
//! replaces the two at the vertex.
//! \param half_edge  leaves the vertex along the boundary.
//! \param length     of the new edge.
void remove_from_boundary(Surface& surface, FaceCharts& charts, Index half_edge, double length);

//! Removes a vertex with a single face, and that face. The third edge of the face is not on the
//! boundary.
//! \param half_edge  leaves the vertex along the boundary.
void remove_ear(Surface& surface, Index half_edge);

//! Removes inner vertices without curvature, whose angles sum to 2 pi: the surface stays. Those
//! with an edge shorter than `min_length` are removed as far as possible, in rounds without two
//! neighbours; see VertexRing. To be called before all other operations: flips add errors to
//! angles, and after flips of needles points would pass four times as many operations. Leaves gaps.
//! \param history  records the operations.
//! \return the number of vertices removed. Cost: O(#F), and O(log n) for each vertex removed.
Index remove_flat_vertices(Surface& surface, FaceCharts& charts, FaceHistory& history,
                           double min_length, int num_threads, Poller& poller);

//! Closes gaps: the last faces and edges get the numbers of removed ones. Charts become invalid.
void compact_faces(Surface& surface, FaceHistory& history);

}  // namespace agvd::detail
