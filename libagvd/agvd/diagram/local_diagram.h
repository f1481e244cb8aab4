//! \file
//! The arcs of bisectors inside the triangles of one chunk of faces.
#pragma once

#include <array>
#include <vector>

#include "agvd/core/types.h"

namespace agvd {

//! A label change on the triangle's boundary. Breakpoints run counter-clockwise; between breakpoint
//! i and breakpoint i + 1 (cyclic) the boundary has label breakpoints[i].site_after.
struct Breakpoint {
    Vec2 position;
    double distance;  //!< From both sites.
    Index node;       //!< Caller's name of the point.
    Index site_after;
    Index interval;  //!< Caller's name of the interval after it.
};

//! A piece of bisector between two nodes.
struct LocalArc {
    Index face;
    Index tail, head;   //!< Nodes.
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

//! Two boundary intervals of a site that hang together inside.
struct Connection {
    Index a, b;  //!< Names of intervals.
    Index site;
};

//! What the faces of one chunk contribute.
struct LocalDiagram {
    static constexpr Index first_voronoi_vertex = Index{1} << 31;

    std::vector<Vec2> points;  //!< In the own frame of the face concerned.
    std::vector<double> point_distance;
    std::vector<LocalArc> arcs;
    std::vector<LocalVoronoiVertex> voronoi_vertices;  //!< v is node first_voronoi_vertex + v.
    std::vector<Connection> connections;
};

}  // namespace agvd
