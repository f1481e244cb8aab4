//! \file
//! Arcs of bisectors inside triangles, and Voronoi edges as chains of them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/diagram/edge_labels.h"

namespace agvd {

//! An end of an arc: a crossing on an edge or a cut, or a Voronoi vertex.
struct NodeId {
    EitherIndex id;

    [[nodiscard]] static constexpr NodeId of_crossing(Index crossing) {
        return {EitherIndex::first(crossing)};
    }
    [[nodiscard]] static constexpr NodeId of_voronoi_vertex(Index voronoi_vertex) {
        return {EitherIndex::second(voronoi_vertex)};
    }

    [[nodiscard]] constexpr bool is_voronoi_vertex() const { return id.is_second(); }
    [[nodiscard]] constexpr Index crossing() const { return id.first(); }
    [[nodiscard]] constexpr Index voronoi_vertex() const { return id.second(); }

    friend constexpr bool operator==(const NodeId&, const NodeId&) = default;
};

//! The tail or the head of an arc, in one word.
struct ArcEnd {
    Index word = no_index;  //!< no_index: there is no arc.

    [[nodiscard]] static constexpr ArcEnd tail_of(Index arc) { return {2 * arc}; }
    [[nodiscard]] static constexpr ArcEnd head_of(Index arc) { return {2 * arc + 1}; }

    [[nodiscard]] constexpr bool is_valid() const { return word != no_index; }
    [[nodiscard]] constexpr Index arc() const { return word / 2; }
    [[nodiscard]] constexpr bool is_tail() const { return word % 2 == 0; }
    //! Of the same arc.
    [[nodiscard]] constexpr ArcEnd other() const { return {word ^ 1}; }

    friend constexpr bool operator==(const ArcEnd&, const ArcEnd&) = default;
};

//! A label change on a triangle's boundary. Breakpoints run counter-clockwise; between breakpoint i
//! and breakpoint i + 1 (cyclic) the boundary has label breakpoints[i].site_after.
struct Breakpoint {
    Vec2 position;
    double distance;  //!< From both sites.
    NodeId node;
    Index site_after;
    Index interval;          //!< The one after it: a node of EdgeLabels.
    bool is_across = false;  //!< As in Arc.
};

//! A piece of bisector between two nodes.
struct Arc {
    Index face;
    NodeId tail, head;
    Index left, right;  //!< Sites, walking from tail to head.
    Index first_point;  //!< Its inner polyline points in Arcs::points.
    Index num_points;
    //! The crossing lies on the twin of its half-edge: a glued face meets one twice.
    bool tail_is_across = false, head_is_across = false;
};

//! A point where three cells meet. Counter-clockwise around it: ends[i], then sites[i].
struct VoronoiVertex {
    Index face;
    Vec2 position;  //!< In the face's own frame.
    double distance;
    std::array<ArcEnd, 3> ends;
    std::array<Index, 3> sites;
};

//! Two boundary intervals of a site that are connected inside the triangle.
struct Connection {
    Index a, b;  //!< Nodes of EdgeLabels.
    Index site;
};

//! The part of a triangle in a cell: area, and number of connected pieces.
struct CellPart {
    Index site;
    int pieces;
    double area;
};

//! What a face has in Arcs.
struct FaceArcs {
    Block arcs, voronoi_vertices, connections, parts;
};

//! What some faces contribute. A face that is traced again leaves what it had, unused.
struct Arcs {
    //! Sizes of the lists.
    struct Mark {
        Index points, arcs, voronoi_vertices, connections, parts;
    };

    std::vector<Vec2> points;  //!< In the own frame of the face concerned.
    std::vector<double> point_distance;
    std::vector<Arc> arcs;
    std::vector<VoronoiVertex> voronoi_vertices;
    std::vector<Connection> connections;
    std::vector<CellPart> parts;
    std::vector<FaceArcs> faces;

    [[nodiscard]] Mark mark() const {
        return {size_of(points), size_of(arcs), size_of(voronoi_vertices), size_of(connections),
                size_of(parts)};
    }
    //! Drops all that came since.
    void go_back(const Mark& mark) {
        points.resize(mark.points);
        point_distance.resize(mark.points);
        arcs.resize(mark.arcs);
        voronoi_vertices.resize(mark.voronoi_vertices);
        connections.resize(mark.connections);
        parts.resize(mark.parts);
    }
    //! What came since.
    [[nodiscard]] FaceArcs since(const Mark& mark) const {
        return {{mark.arcs, size_of(arcs) - mark.arcs},
                {mark.voronoi_vertices, size_of(voronoi_vertices) - mark.voronoi_vertices},
                {mark.connections, size_of(connections) - mark.connections},
                {mark.parts, size_of(parts) - mark.parts}};
    }
    //! Adds the faces of another list.
    //! \param positions  of these faces in `faces`.
    void append(const Arcs& chunk, std::span<const Index> positions) {
        const Mark at = mark();
        append_to<Vec2>(points, chunk.points);
        append_to<double>(point_distance, chunk.point_distance);
        append_to<Connection>(connections, chunk.connections);
        append_to<CellPart>(parts, chunk.parts);
        append_to<Arc>(arcs, chunk.arcs);
        append_to<VoronoiVertex>(voronoi_vertices, chunk.voronoi_vertices);
        const auto move = [&](NodeId& node) {
            if (!node.is_voronoi_vertex()) return;
            node = NodeId::of_voronoi_vertex(node.voronoi_vertex() + at.voronoi_vertices);
        };
        for (Index i = at.arcs; i < arcs.size(); ++i) {
            move(arcs[i].tail);
            move(arcs[i].head);
            arcs[i].first_point += at.points;
        }
        for (Index i = at.voronoi_vertices; i < voronoi_vertices.size(); ++i) {
            for (ArcEnd& end : voronoi_vertices[i].ends) end.word += 2 * at.arcs;
        }
        for (std::size_t i = 0; i < positions.size(); ++i) {
            FaceArcs& face = faces[positions[i]] = chunk.faces[i];
            face.arcs.begin += at.arcs;
            face.voronoi_vertices.begin += at.voronoi_vertices;
            face.connections.begin += at.connections;
            face.parts.begin += at.parts;
        }
    }
    //! Makes room for so many times as much, and a tenth more.
    void reserve_for(double times) {
        const auto reserve = [&](auto&... lists) {
            (lists.reserve(
                 static_cast<std::size_t>(1.1 * times * static_cast<double>(lists.size()))),
             ...);
        };
        reserve(points, point_distance, arcs, voronoi_vertices, connections, parts);
    }
};

//! The Voronoi edges between cells. An edge runs through crossings from one vertex of the diagram
//! (a Voronoi vertex, or a crossing on the surface's boundary) to another, or it is closed.
struct JoinedEdges {
    struct Edge {
        ArcEnd first, last;  //!< At its tail and its head.
        Index left, right;   //!< Sites, walking from tail to head.
        bool is_closed;
    };
    //! Open ones by the first of their ends in the faces, then closed ones by their first tail.
    std::vector<Edge> edges;
    std::vector<Index> edge_of_arc;
    //! The arcs' ends at each crossing; on the surface's boundary one only.
    std::vector<std::array<ArcEnd, 2>> crossing_ends;
};

[[nodiscard]] inline NodeId node_at(const Arcs& arcs, ArcEnd end) {
    const Arc& arc = arcs.arcs[end.arc()];
    return end.is_tail() ? arc.tail : arc.head;
}

//! Whether edges end at a node.
[[nodiscard]] inline bool ends_edges(const JoinedEdges& joined, NodeId node) {
    return node.is_voronoi_vertex() || !joined.crossing_ends[node.crossing()][1].is_valid();
}

//! The end of the other arc at a crossing.
[[nodiscard]] inline ArcEnd across(const Arcs& arcs, const JoinedEdges& joined, ArcEnd end) {
    const auto& ends = joined.crossing_ends[node_at(arcs, end).crossing()];
    return ends[0] == end ? ends[1] : ends[0];
}

//! Joins the arcs of all faces into Voronoi edges. Cost: O(arcs).
[[nodiscard]] JoinedEdges join_arcs(const EdgeLabels& labels, const Arcs& arcs, Ticker ticker);

}  // namespace agvd
