// An edge is a chain of arcs; its points are their nodes and inner points. Edges between cells
// come before those on the surface's boundary, and Voronoi vertices before the label changes on
// the boundary, where an edge between cells meets two edges of the boundary.
#include <cassert>
#include <utility>

#include "agvd/diagram/face_relays.h"
#include "agvd/diagram/stages.h"

namespace agvd {
namespace {

// A label change on one of the surface's boundaries, in its direction (the surface on the left).
struct BoundaryCrossing {
    Index crossing;
    Index position;  // Of its half-edge in the loop.
};

class Drawing {
public:
    Drawing(const Surface& surface, const DiagramParts& parts, Ticker ticker, Diagram& out)
        : surface_(surface), parts_(parts), ticker_(ticker), out_(out) {}

    void draw_complex() {
        out_.vertex_offsets.assign(1, 0);
        for (const JoinedEdges::Edge& edge : joined_.edges) {
            ticker_.tick();
            out_.edges.push_back({SiteId(edge.left), SiteId(edge.right), no_index, no_index});
        }
        draw_voronoi_vertices();
        for (const std::vector<Index>& loop : parts_.boundary_loops) {
            const Index site = labels_.point_site[surface_.tail(loop[0])];
            const std::vector<BoundaryCrossing> crossings = crossings_along(loop);
            if (!crossings.empty()) {
                attach_boundary(crossings);
            } else if (site != no_index) {
                out_.edges.push_back({SiteId(site), {}, no_index, no_index});
            }
        }
    }

    void draw_points() {
        reserve_points();
        out_.edge_points.assign(1, 0);
        if (has_shapes_) out_.edge_arcs.assign(1, 0);
        for (const JoinedEdges::Edge& edge : joined_.edges) draw_edge(edge);
        for (const std::vector<Index>& loop : parts_.boundary_loops) {
            const std::vector<BoundaryCrossing> crossings = crossings_along(loop);
            if (!crossings.empty()) {
                draw_boundary_edges(loop, crossings);
            } else if (labels_.point_site[surface_.tail(loop[0])] != no_index) {
                for (const Index h : loop) add_mesh_vertex(h);
                finish_edge();
            }
        }
    }

private:
    [[nodiscard]] std::vector<BoundaryCrossing> crossings_along(std::span<const Index> loop) const {
        std::vector<BoundaryCrossing> crossings;
        for (Index i = 0; i < loop.size(); ++i) {
            // A boundary edge has one half-edge, so its crossings run along the loop.
            const Block& row = labels_.edge_rows[surface_.edge[loop[i]]];
            for (Index c = row.begin; c < row.end(); ++c) crossings.push_back({c, i});
        }
        return crossings;
    }

    // --- Edges and vertices --------------------------------------------------------------------

    void draw_voronoi_vertices() {
        for (const FaceArcs& face : arcs_.faces) {
            ticker_.tick();
            for (const VoronoiVertex& voronoi_vertex :
                 elements_of(arcs_.voronoi_vertices, face.voronoi_vertices)) {
                for (std::size_t k = 0; k < 3; ++k) {
                    attach(edge_end(voronoi_vertex.ends[k]), voronoi_vertex.sites[k]);
                }
                finish_vertex(point_of(voronoi_vertex), voronoi_vertex.distance);
            }
        }
    }

    // The edges of one loop between its label changes, and the vertices at these.
    void attach_boundary(std::span<const BoundaryCrossing> crossings) {
        const auto first_edge = size_of(out_.edges);
        const auto count = static_cast<Index>(crossings.size());
        for (const BoundaryCrossing& from : crossings) {
            const SiteId site(labels_.crossings[from.crossing].site_after);
            out_.edges.push_back({site, {}, no_index, no_index});
        }
        for (Index i = 0; i < count; ++i) {
            const Index name = crossings[i].crossing;
            const Crossing& crossing = labels_.crossings[name];
            attach({first_edge + i, true}, crossing.site_after);
            attach(edge_end(joined_.crossing_ends[name][0]), crossing.site_before);
            attach({first_edge + (i + count - 1) % count, false}, no_index);
            finish_vertex(point_of(crossing), crossing.distance);
        }
    }

    // The end of the Voronoi edge that lies at the end of an arc.
    [[nodiscard]] EdgeEnd edge_end(ArcEnd end) const {
        const Index edge = joined_.edge_of_arc[end.arc()];
        assert(joined_.edges[edge].first == end || joined_.edges[edge].last == end);
        return {edge, joined_.edges[edge].first == end};
    }

    // To the vertex that is finished next.
    void attach(const EdgeEnd& end, Index site) {
        const auto vertex = size_of(out_.vertices);
        out_.vertex_ends.push_back(end);
        out_.vertex_sites.push_back(SiteId(site));
        (end.is_tail ? out_.edges[end.edge].tail : out_.edges[end.edge].head) = vertex;
    }

    void finish_vertex(const SurfacePoint& point, double distance) {
        out_.vertices.push_back(point);
        out_.vertex_distance.push_back(distance);
        out_.vertex_offsets.push_back(size_of(out_.vertex_ends));
    }

    // --- Points --------------------------------------------------------------------------------

    void reserve_points() {
        // A node at the beginning of each arc and at the end of each edge.
        std::size_t most = arcs_.arcs.size() + arcs_.points.size() + joined_.edges.size();
        for (const std::vector<Index>& loop : parts_.boundary_loops) {
            most += loop.size() + 2 * crossings_along(loop).size();
        }
        out_.points.reserve(most);
        out_.point_distance.reserve(most);
        out_.passages.reserve(most);
        out_.arcs.reserve(parts_.shapes.shapes.size());
    }

    void finish_edge() {
        out_.edge_points.push_back(size_of(out_.points));
        if (has_shapes_) out_.edge_arcs.push_back(size_of(out_.arcs));
    }

    void draw_edge(const JoinedEdges::Edge& edge) {
        ArcEnd from = edge.first;
        while (true) {
            ticker_.tick();
            const Arc& arc = arcs_.arcs[from.arc()];
            const NodeId node = node_at(arcs_, from);
            const bool is_across = from.is_tail() ? arc.tail_is_across : arc.head_is_across;
            add_node(node, ends_edges(joined_, node) ? Passage{} : passage_at(node, is_across));
            if (has_shapes_) add_shapes(from);
            add_inner_points(arc, from.is_tail());
            const ArcEnd to = from.other();
            if (to == edge.last) break;
            from = across(arcs_, joined_, to);
        }
        // A closed curve does not repeat its first point.
        const NodeId end = node_at(arcs_, edge.last);
        if (ends_edges(joined_, end)) add_node(end, {});
        finish_edge();
    }

    // Each arc of one loop from one label change to the next.
    void draw_boundary_edges(std::span<const Index> loop,
                             std::span<const BoundaryCrossing> crossings) {
        const auto count = static_cast<Index>(crossings.size());
        const auto loop_size = static_cast<Index>(loop.size());
        for (Index i = 0; i < count; ++i) {
            const BoundaryCrossing& from = crossings[i];
            const BoundaryCrossing& to = crossings[(i + 1) % count];
            add_boundary_crossing(from.crossing);
            // The mesh vertices between: tails of the half-edges after `from` up to that of `to`.
            Index steps = (to.position + loop_size - from.position) % loop_size;
            if (steps == 0 && i + 1 == count) steps = loop_size;
            for (Index j = 1; j <= steps; ++j) {
                add_mesh_vertex(loop[(from.position + j) % loop_size]);
            }
            add_boundary_crossing(to.crossing);
            finish_edge();
        }
    }

    [[nodiscard]] SurfacePoint point_of(const VoronoiVertex& voronoi_vertex) const {
        return to_surface(surface_, voronoi_vertex.face, voronoi_vertex.position);
    }

    [[nodiscard]] SurfacePoint point_of(const Crossing& crossing) const {
        if (crossing.line.is_cut()) {
            const Cut& cut = labels_.cuts[crossing.line.cut()];
            const auto corners = face_corners(surface_, cut.face);
            const Vec2 from = labels_.position_of(cut.from, corners);
            const Vec2 to = labels_.position_of(cut.to, corners);
            return to_surface(surface_, cut.face, (1 - crossing.at) * from + crossing.at * to);
        }
        return point_on(crossing.line.half_edge(), crossing.at);
    }

    // \param is_across  the curve goes on from the twin of the half-edge that the crossing names.
    [[nodiscard]] Passage passage_at(NodeId node, bool is_across) const {
        if (node.is_voronoi_vertex()) return {};
        const LineId line = labels_.crossings[node.crossing()].line;
        if (line.is_cut()) return {};
        return {static_cast<std::uint8_t>(line.half_edge() % 3), is_across};
    }

    void add_point(const SurfacePoint& point, double distance, const Passage& passage) {
        out_.points.push_back(point);
        out_.point_distance.push_back(distance);
        out_.passages.push_back(passage);
    }

    void add_node(NodeId node, const Passage& passage) {
        if (node.is_voronoi_vertex()) {
            const VoronoiVertex& at = arcs_.voronoi_vertices[node.voronoi_vertex()];
            add_point(point_of(at), at.distance, passage);
        } else {
            const Crossing& at = labels_.crossings[node.crossing()];
            add_point(point_of(at), at.distance, passage);
        }
    }

    void add_boundary_crossing(Index crossing) {
        const auto node = NodeId::of_crossing(crossing);
        add_node(node, passage_at(node, false));
    }

    // The tail of a half-edge on the boundary.
    void add_mesh_vertex(Index half_edge) {
        add_point(point_on(half_edge, 0), labels_.vertex_distance[surface_.tail(half_edge)],
                  {static_cast<std::uint8_t>(half_edge % 3), true});
    }

    void add_inner_points(const Arc& arc, bool from_tail) {
        for (Index j = 0; j < arc.num_points; ++j) {
            const Index k = arc.first_point + (from_tail ? j : arc.num_points - 1 - j);
            add_point(to_surface(surface_, arc.face, arcs_.points[k]), arcs_.point_distance[k], {});
        }
    }

    // Of an arc at whose first node the last point so far lies.
    void add_shapes(ArcEnd from) {
        const std::span<const ArcShape> shapes =
            elements_of(parts_.shapes.shapes, parts_.shapes.of_arc[from.arc()]);
        const FaceId face(arcs_.arcs[from.arc()].face);
        Index point = size_of(out_.points) - 1;
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            const ArcShape& shape = shapes[from.is_tail() ? i : shapes.size() - 1 - i];
            BisectorArc arc{face,        shape.kind, point, shape.conic.focus, shape.conic.weight,
                            shape.begin, shape.end};
            if (!from.is_tail()) {
                std::swap(arc.focus[0], arc.focus[1]);
                std::swap(arc.weight[0], arc.weight[1]);
                std::swap(arc.begin, arc.end);
            }
            out_.arcs.push_back(arc);
            point += shape.num_points + 1;
        }
    }

    const Surface& surface_;
    const DiagramParts& parts_;
    const EdgeLabels& labels_ = parts_.labels;
    const Arcs& arcs_ = parts_.arcs;
    const JoinedEdges& joined_ = parts_.joined;
    const bool has_shapes_ = !parts_.shapes.of_arc.empty();
    Ticker ticker_;
    Diagram& out_;
};

}  // namespace

Diagram draw_complex(const Surface& surface, const DiagramParts& parts, Ticker ticker) {
    Diagram diagram;
    diagram.num_sites = parts.num_sites;
    Drawing(surface, parts, ticker, diagram).draw_complex();
    return diagram;
}

void draw_points(const Surface& surface, const DiagramParts& parts, Ticker ticker,
                 Diagram& diagram) {
    Drawing(surface, parts, ticker, diagram).draw_points();
}

}  // namespace agvd
