//! \file
//! Voronoi edges as chains of arcs.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/diagram/arc_store.h"

namespace agvd {

//! The Voronoi edges between cells. An edge runs through crossings from one vertex of the diagram
//! (a Voronoi vertex, or a crossing on the surface's boundary) to another, or it is closed. Edges
//! are known by names: a name serves again when its edge is gone.
struct JoinedEdges {
    struct Edge {
        std::uint64_t key;  //!< Edges ascend by it in the diagram; see join_arcs().
        ArcEnd last;        //!< At its head; that at its tail is in `first_ends`.
        Index left, right;  //!< Sites, walking from tail to head.
        Block drawn{};      //!< Its points in a diagram drawn before. Empty: a new edge.

        [[nodiscard]] bool is_closed() const { return key >> 63 != 0; }
    };
    std::vector<Edge> edges;         //!< By name.
    std::vector<ArcEnd> first_ends;  //!< By name; none: the edge is gone.
    std::vector<Index> order;        //!< Names, by key.
    std::vector<Index> free_names;   //!< Of edges that are gone; no arc has such a name.

    std::vector<Index> edge_of_arc;  //!< Names; no_index: none yet. The edge may be gone.
    //! The arcs' ends at each crossing; on the surface's boundary one only.
    std::vector<std::array<ArcEnd, 2>> crossing_ends;
};

[[nodiscard]] inline NodeId node_at(const ArcStore& arcs, ArcEnd end) {
    const LocalArc& arc = arcs.arcs()[end.arc()];
    return end.is_tail() ? arc.tail : arc.head;
}

//! Whether edges end at a node.
[[nodiscard]] inline bool ends_edges(const JoinedEdges& joined, NodeId node) {
    return node.is_voronoi_vertex() || !joined.crossing_ends[node.crossing()][1].is_valid();
}

//! The end of the other arc at a crossing.
[[nodiscard]] inline ArcEnd across(const ArcStore& arcs, const JoinedEdges& joined, ArcEnd end) {
    const auto& ends = joined.crossing_ends[node_at(arcs, end).crossing()];
    return ends[0] == end ? ends[1] : ends[0];
}

}  // namespace agvd
