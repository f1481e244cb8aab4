#include "agvd/diagram/arcs.h"

#include <cassert>

namespace agvd {
namespace {

template <typename T>
void append_all(const std::vector<T>& from, std::vector<T>& to) {
    to.insert(to.end(), from.begin(), from.end());
}

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

Arcs::Mark Arcs::mark() const {
    return {size_of(points), size_of(arcs), size_of(voronoi_vertices), size_of(connections),
            size_of(parts)};
}

void Arcs::go_back(const Mark& mark) {
    points.resize(mark.points);
    point_distance.resize(mark.points);
    arcs.resize(mark.arcs);
    voronoi_vertices.resize(mark.voronoi_vertices);
    connections.resize(mark.connections);
    parts.resize(mark.parts);
}

FaceArcs Arcs::since(const Mark& mark) const {
    return {{mark.arcs, size_of(arcs) - mark.arcs},
            {mark.voronoi_vertices, size_of(voronoi_vertices) - mark.voronoi_vertices},
            {mark.connections, size_of(connections) - mark.connections},
            {mark.parts, size_of(parts) - mark.parts}};
}

void Arcs::append(const Arcs& chunk, std::span<const Index> positions) {
    const Mark at = mark();
    append_all(chunk.points, points);
    append_all(chunk.point_distance, point_distance);
    append_all(chunk.connections, connections);
    append_all(chunk.parts, parts);
    const auto moved = [&](NodeId node) {
        return node.is_voronoi_vertex()
                   ? NodeId::of_voronoi_vertex(node.voronoi_vertex() + at.voronoi_vertices)
                   : node;
    };
    for (Arc arc : chunk.arcs) {
        arc.tail = moved(arc.tail);
        arc.head = moved(arc.head);
        arc.first_point += at.points;
        arcs.push_back(arc);
    }
    for (VoronoiVertex voronoi_vertex : chunk.voronoi_vertices) {
        for (ArcEnd& end : voronoi_vertex.ends) end.word += 2 * at.arcs;
        voronoi_vertices.push_back(voronoi_vertex);
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
        FaceArcs& face = faces[positions[i]] = chunk.faces[i];
        face.arcs.begin += at.arcs;
        face.voronoi_vertices.begin += at.voronoi_vertices;
        face.connections.begin += at.connections;
        face.parts.begin += at.parts;
    }
}

void Arcs::reserve_for(double times) {
    constexpr double spare = 1.1;
    const auto reserve = [&](auto& elements) {
        const auto size = static_cast<double>(elements.size());
        elements.reserve(static_cast<std::size_t>(spare * times * size));
    };
    reserve(points);
    reserve(point_distance);
    reserve(arcs);
    reserve(voronoi_vertices);
    reserve(connections);
    reserve(parts);
}

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
