// An edge is a chain of arcs. Its points are the node at the beginning of each arc, the inner
// points of the arc, and the node at the end of the last one. Points lie in faces of the surface,
// with barycentric coordinates; a crossing is given in the face of the half-edge that it names.
#include "agvd/diagram/draw_points.h"

#include "agvd/diagram/face_relays.h"

namespace agvd {
namespace {

const ArcStore::VertexPlace& place_of(const DrawingInput& in, NodeId node) {
    return in.parts.arcs.vertex_places()[node.voronoi_vertex()];
}

double distance_of(const DrawingInput& in, NodeId node) {
    return node.is_voronoi_vertex() ? place_of(in, node).distance
                                    : in.parts.labels.crossings[node.crossing()].distance;
}

SurfacePoint point_on_cut(const DrawingInput& in, const Cut& cut, double at) {
    const auto corners = face_corners(in.surface, cut.face);
    const Vec2 from = position_of(in.parts.labels, corners, cut.from);
    const Vec2 to = position_of(in.parts.labels, corners, cut.to);
    return to_surface(in.surface, cut.face, (1 - at) * from + at * to);
}

SurfacePoint point_of(const DrawingInput& in, NodeId node) {
    if (node.is_voronoi_vertex()) return place_of(in, node).point;
    const Crossing& crossing = in.parts.labels.crossings[node.crossing()];
    if (crossing.line.is_cut()) {
        return point_on_cut(in, in.parts.labels.cuts[crossing.line.cut()], crossing.at);
    }
    const Index h = crossing.line.half_edge();
    SurfacePoint point{FaceId(Surface::face(h)), {0, 0, 0}};
    point.barycentric[h % 3] = 1 - crossing.at;
    point.barycentric[(h + 1) % 3] = crossing.at;
    return point;
}

// \param is_across  the curve goes on from the twin of the half-edge that the crossing names.
Passage passage_at(const DrawingInput& in, NodeId node, bool is_across) {
    if (node.is_voronoi_vertex()) return {};
    const LineId line = in.parts.labels.crossings[node.crossing()].line;
    if (line.is_cut()) return {};
    return {static_cast<std::uint8_t>(line.half_edge() % 3), is_across};
}

void add_point(const SurfacePoint& point, double distance, const Passage& passage, Diagram& out) {
    out.points.push_back(point);
    out.point_distance.push_back(distance);
    out.passages.push_back(passage);
}

void add_node(const DrawingInput& in, NodeId node, const Passage& passage, Diagram& out) {
    add_point(point_of(in, node), distance_of(in, node), passage, out);
}

void add_boundary_crossing(const DrawingInput& in, Index crossing, Diagram& out) {
    const auto node = NodeId::of_crossing(crossing);
    add_node(in, node, passage_at(in, node, false), out);
}

// The tail of a half-edge on the boundary.
void add_mesh_vertex(const DrawingInput& in, Index half_edge, Diagram& out) {
    const Index v = in.surface.tail(half_edge);
    SurfacePoint point{FaceId(Surface::face(half_edge)), {0, 0, 0}};
    point.barycentric[half_edge % 3] = 1;
    add_point(point, in.parts.labels.vertex_distance[v],
              {static_cast<std::uint8_t>(half_edge % 3), true}, out);
}

void add_inner_points(const DrawingInput& in, ArcEnd from, Diagram& out) {
    const LocalArc& arc = in.parts.arcs.arcs()[from.arc()];
    for (Index j = 0; j < arc.num_points; ++j) {
        const Index k = arc.first_point + (from.is_tail() ? j : arc.num_points - 1 - j);
        const ArcStore::Point& point = in.parts.arcs.points()[k];
        add_point(to_surface(in.surface, arc.face, point.position), point.distance, {}, out);
    }
}

void end_edge(Diagram& out) { out.edge_points.push_back(static_cast<Index>(out.points.size())); }

// Of one loop of the boundary, each arc from one label change to the next.
void draw_boundary_arcs(const DrawingInput& in, const std::vector<Index>& loop,
                        std::span<const BoundaryCrossing> crossings, Diagram& out) {
    const auto count = static_cast<Index>(crossings.size());
    const auto loop_size = static_cast<Index>(loop.size());
    for (Index i = 0; i < count; ++i) {
        const BoundaryCrossing& from = crossings[i];
        const BoundaryCrossing& to = crossings[(i + 1) % count];
        add_boundary_crossing(in, from.crossing, out);
        // The mesh vertices between: tails of the half-edges after `from` up to that of `to`.
        Index steps = (to.position + loop_size - from.position) % loop_size;
        if (steps == 0 && i + 1 == count) steps = loop_size;
        for (Index j = 1; j <= steps; ++j) {
            add_mesh_vertex(in, loop[(from.position + j) % loop_size], out);
        }
        add_boundary_crossing(in, to.crossing, out);
        end_edge(out);
    }
}

// How many points are drawn at most.
std::size_t most_points(const DrawingInput& in) {
    const ArcStore& arcs = in.parts.arcs;
    // A node at the beginning of each arc and at the end of each edge.
    std::size_t count = arcs.arcs().size() + arcs.points().size() + in.parts.joined.order.size();
    for (std::size_t i = 0; i < in.boundary.size(); ++i) {
        count += in.parts.boundary_loops[i].size() + 2 * in.boundary[i].size();
    }
    return count;
}

}  // namespace

void clear_points(const DrawingInput& input, Diagram& diagram) {
    diagram.points.clear();
    diagram.point_distance.clear();
    diagram.passages.clear();
    const std::size_t most = most_points(input);
    diagram.points.reserve(most);
    diagram.point_distance.reserve(most);
    diagram.passages.reserve(most);
    diagram.edge_points.assign(1, 0);
}

void draw_edge(const DrawingInput& input, Index name, Ticker& ticker, Diagram& diagram) {
    const ArcStore& arcs = input.parts.arcs;
    const JoinedEdges& joined = input.parts.joined;
    const ArcEnd last = joined.edges[name].last;
    ArcEnd from = joined.first_ends[name];
    while (true) {
        ticker.tick();
        const LocalArc& arc = arcs.arcs()[from.arc()];
        const NodeId node = node_at(arcs, from);
        const bool is_across = from.is_tail() ? arc.tail_is_across : arc.head_is_across;
        add_node(input, node,
                 ends_edges(joined, node) ? Passage{} : passage_at(input, node, is_across),
                 diagram);
        add_inner_points(input, from, diagram);
        const ArcEnd to = from.other();
        if (to == last) break;
        from = across(arcs, joined, to);
    }
    // A closed curve does not repeat its first point.
    const NodeId end = node_at(arcs, last);
    if (ends_edges(joined, end)) add_node(input, end, {}, diagram);
    end_edge(diagram);
}

void draw_boundary(const DrawingInput& input, Diagram& diagram) {
    for (std::size_t i = 0; i < input.boundary.size(); ++i) {
        const std::vector<Index>& loop = input.parts.boundary_loops[i];
        if (!input.boundary[i].empty()) {
            draw_boundary_arcs(input, loop, input.boundary[i], diagram);
        } else if (input.parts.labels.point_site[input.surface.tail(loop[0])] != no_index) {
            for (const Index h : loop) add_mesh_vertex(input, h, diagram);
            end_edge(diagram);
        }
    }
}

void draw_vertices(const DrawingInput& input, Diagram& diagram) {
    diagram.vertices.clear();
    diagram.vertex_distance.clear();
    for (const FaceVoronoiVertices& in_face : input.voronoi_vertices) {
        for (const auto& [point, distance] :
             input.parts.arcs.vertex_places()[in_face.voronoi_vertices]) {
            diagram.vertices.push_back(point);
            diagram.vertex_distance.push_back(distance);
        }
    }
    for (const std::vector<BoundaryCrossing>& loop : input.boundary) {
        for (const BoundaryCrossing& at : loop) {
            const auto node = NodeId::of_crossing(at.crossing);
            diagram.vertices.push_back(point_of(input, node));
            diagram.vertex_distance.push_back(distance_of(input, node));
        }
    }
}

}  // namespace agvd
