//! \file
//! The arcs of bisectors inside the triangles of one chunk of faces. The faces of a chunk are
//! traced into one LocalDiagram; indices in it count from the beginning of the chunk, and ArcStore
//! makes them places in its pools.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "agvd/core/types.h"

namespace agvd {

//! An end of an arc: a crossing on an edge or a cut, or a Voronoi vertex.
class NodeId {
public:
    constexpr NodeId() = default;
    [[nodiscard]] static constexpr NodeId of_crossing(Index crossing) {
        return NodeId(EitherIndex::first(crossing));
    }
    [[nodiscard]] static constexpr NodeId of_voronoi_vertex(Index voronoi_vertex) {
        return NodeId(EitherIndex::second(voronoi_vertex));
    }

    [[nodiscard]] constexpr bool is_voronoi_vertex() const { return id_.is_second(); }
    [[nodiscard]] constexpr Index crossing() const { return id_.first(); }
    [[nodiscard]] constexpr Index voronoi_vertex() const { return id_.second(); }

    friend constexpr bool operator==(const NodeId&, const NodeId&) = default;

private:
    explicit constexpr NodeId(EitherIndex id) : id_(id) {}

    EitherIndex id_;
};

//! A stretch of one label on an edge or a cut. It is named by the point at its end, if there is
//! one, else by the crossing that it follows along the edge_half or the cut.
class IntervalId {
public:
    constexpr IntervalId() = default;
    [[nodiscard]] static constexpr IntervalId to_point(Index point) {
        return IntervalId(EitherIndex::first(point));
    }
    [[nodiscard]] static constexpr IntervalId after_crossing(Index crossing) {
        return IntervalId(EitherIndex::second(crossing));
    }

    [[nodiscard]] constexpr bool follows_crossing() const { return id_.is_second(); }
    [[nodiscard]] constexpr Index point() const { return id_.first(); }
    [[nodiscard]] constexpr Index crossing() const { return id_.second(); }

    friend constexpr bool operator==(const IntervalId&, const IntervalId&) = default;

private:
    explicit constexpr IntervalId(EitherIndex id) : id_(id) {}

    EitherIndex id_;
};

//! A label change on the triangle's boundary. Breakpoints run counter-clockwise; between breakpoint
//! i and breakpoint i + 1 (cyclic) the boundary has label breakpoints[i].site_after.
struct Breakpoint {
    Vec2 position;
    double distance;  //!< From both sites.
    NodeId node;      //!< The caller's; a crossing.
    Index site_after;
    IntervalId interval;  //!< The one after it.
};

//! A piece of bisector between two nodes.
struct LocalArc {
    Index face;
    NodeId tail, head;
    Index left, right;  //!< Sites, walking from tail to head.
    Index first_point;  //!< Its inner polyline points in LocalDiagram::points.
    Index num_points;
    //! The node, a crossing, lies on the twin of the half-edge that it names.
    bool tail_is_across = false, head_is_across = false;
};

//! A point where three cells meet. Counter-clockwise around it: arcs[i], then sites[i].
struct LocalVoronoiVertex {
    Index face;
    Vec2 position;
    double distance;
    std::array<Index, 3> arcs;    //!< Indices into arcs.
    std::array<bool, 3> at_tail;  //!< True: the arc starts here.
    std::array<Index, 3> sites;
};

//! Two boundary intervals of a site that are connected inside the triangle.
struct Connection {
    IntervalId a, b;
    Index site;
};

//! What the faces of one chunk contribute.
struct LocalDiagram {
    //! Sizes of the lists.
    struct Mark {
        Index points, arcs, voronoi_vertices, connections;
    };

    std::vector<Vec2> points;  //!< In the own frame of the face concerned.
    std::vector<double> point_distance;
    std::vector<LocalArc> arcs;
    std::vector<LocalVoronoiVertex> voronoi_vertices;
    std::vector<Connection> connections;

    [[nodiscard]] Mark mark() const {
        return {static_cast<Index>(points.size()), static_cast<Index>(arcs.size()),
                static_cast<Index>(voronoi_vertices.size()),
                static_cast<Index>(connections.size())};
    }
    //! Drops all that came since.
    void go_back(const Mark& mark) {
        points.resize(mark.points);
        point_distance.resize(mark.points);
        arcs.resize(mark.arcs);
        voronoi_vertices.resize(mark.voronoi_vertices);
        connections.resize(mark.connections);
    }
};

}  // namespace agvd
