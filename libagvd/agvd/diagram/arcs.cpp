#include "agvd/diagram/arcs.h"

#include <cassert>

namespace agvd {
namespace {

// Calls each(arc) for the arcs of all faces, in their order.
template <typename Each>
void for_each_arc(const Arcs& arcs, Ticker& ticker, const Each& each) {
    for (const FaceArcs& face : arcs.faces) {
        ticker.tick(1 + face.arcs.count);
        for (Index arc = face.arcs.begin; arc < face.arcs.end(); ++arc) each(arc);
    }
}

// Follows the arcs from one end through crossings until a vertex or the start.
void add_edge(const Arcs& arcs, ArcEnd start, bool is_closed, Ticker& ticker, JoinedEdges& joined) {
    ArcEnd from = start;
    ArcEnd to;
    while (true) {
        joined.edge_of_arc[from.arc()] = size_of(joined.edges);
        ticker.tick();
        to = from.other();
        if (!is_closed && ends_edges(joined, node_at(arcs, to))) break;
        from = across(arcs, joined, to);
        assert(from.is_valid());
        if (from == start) break;
    }
    const Arc& arc = arcs.arcs[start.arc()];
    joined.edges.push_back({start, to, start.is_tail() ? arc.left : arc.right,
                            start.is_tail() ? arc.right : arc.left, is_closed});
}

}  // namespace

JoinedEdges join_arcs(const EdgeLabels& labels, const Arcs& arcs, Ticker ticker) {
    JoinedEdges joined;
    joined.edge_of_arc.resize(arcs.arcs.size(), no_index);
    joined.crossing_ends.resize(labels.crossings.size());
    for_each_arc(arcs, ticker, [&](Index arc) {
        for (const ArcEnd end : {ArcEnd::tail_of(arc), ArcEnd::head_of(arc)}) {
            const NodeId node = node_at(arcs, end);
            if (node.is_voronoi_vertex()) continue;
            auto& ends = joined.crossing_ends[node.crossing()];
            assert(!ends[1].is_valid());
            ends[ends[0].is_valid() ? 1 : 0] = end;
        }
    });
    for_each_arc(arcs, ticker, [&](Index arc) {
        for (const ArcEnd end : {ArcEnd::tail_of(arc), ArcEnd::head_of(arc)}) {
            if (joined.edge_of_arc[arc] == no_index && ends_edges(joined, node_at(arcs, end))) {
                add_edge(arcs, end, false, ticker, joined);
            }
        }
    });
    for_each_arc(arcs, ticker, [&](Index arc) {
        if (joined.edge_of_arc[arc] == no_index) {
            add_edge(arcs, ArcEnd::tail_of(arc), true, ticker, joined);
        }
    });
    return joined;
}

}  // namespace agvd
