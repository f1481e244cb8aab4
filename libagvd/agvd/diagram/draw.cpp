// The diagram of joined arcs: numbers for edges and vertices, and where their points lie.
#include <algorithm>
#include <utility>

#include "agvd/diagram/join.h"

namespace agvd {

// Where the ends of arcs lie.
class ArcJoiner::Nodes {
public:
    Nodes(const Surface& surface, const EdgeLabels& labels, const ArcStore& arcs)
        : surface_(surface), labels_(labels), arcs_(arcs) {}

    [[nodiscard]] double distance(Index node) const {
        return node >= LocalDiagram::first_voronoi_vertex ? place_of(node).distance
                                                          : labels_.crossings[node].distance;
    }

    [[nodiscard]] SurfacePoint point(Index node) const {
        if (node >= LocalDiagram::first_voronoi_vertex) return place_of(node).point;
        const Crossing& crossing = labels_.crossings[node];
        if (crossing.line >= Crossing::first_cut) {
            return point_on_cut(labels_.cuts[crossing.line - Crossing::first_cut], crossing.at);
        }
        const Index h = crossing.line;
        SurfacePoint point{FaceId(Surface::face(h)), {0, 0, 0}};
        point.barycentric[h % 3] = 1 - crossing.at;
        point.barycentric[(h + 1) % 3] = crossing.at;
        return point;
    }

    // \param is_across  the curve goes on from the twin of the half-edge that the crossing names.
    [[nodiscard]] Passage passage(Index node, bool is_across) const {
        if (node >= LocalDiagram::first_voronoi_vertex) return {};
        const Index line = labels_.crossings[node].line;
        if (line >= Crossing::first_cut) return {};
        return {static_cast<std::uint8_t>(line % 3), is_across};
    }

private:
    [[nodiscard]] const ArcStore::VertexPlace& place_of(Index node) const {
        return arcs_.vertex_places()[node - LocalDiagram::first_voronoi_vertex];
    }

    [[nodiscard]] SurfacePoint point_on_cut(const Cut& cut, double at) const {
        const auto corners = face_corners(surface_, cut.face);
        const Vec2 from = position_of(labels_, corners, cut.from);
        const Vec2 to = position_of(labels_, corners, cut.to);
        return to_surface(surface_, cut.face, (1 - at) * from + at * to);
    }

    const Surface& surface_;
    const EdgeLabels& labels_;
    const ArcStore& arcs_;
};

// One call of draw().
class ArcJoiner::Drawing {
public:
    Drawing(const Surface& surface, const EdgeLabels& labels, const ArcStore& arcs, Ticker ticker,
            ArcJoiner& joiner, Diagram& diagram)
        : surface_(surface),
          labels_(labels),
          arcs_(arcs),
          nodes_(surface, labels, arcs),
          ticker_(ticker),
          in_(joiner),
          out_(diagram) {}

    void run() {
        put_in_order();
        list_edges();
        out_.vertex_offsets.assign(1, 0);
        out_.vertex_ends.clear();
        out_.vertex_sites.clear();
        add_voronoi_vertices();
        add_boundary();

        gather_points();
        out_.vertices.clear();
        out_.vertex_distance.clear();
        for (const FaceVoronoiVertices& in_face : in_.voronoi_vertices_) {
            for (const auto& [point, distance] : arcs_.vertex_places()[in_face.voronoi_vertices]) {
                out_.vertices.push_back(point);
                out_.vertex_distance.push_back(distance);
            }
        }
        for (Index i = 0; i < in_.boundary_loops_.size(); ++i) {
            draw_boundary(in_.boundary_loops_[i], boundary_crossings_[i]);
        }
    }

private:
    // A label change on one of the surface's boundaries, in its direction (the surface on the
    // left).
    struct BoundaryCrossing {
        Index node;
        Index position;  // In the loop.
        Index site_before, site_after;
    };

    void put_in_order() {
        const auto comes_before = [&](Index a, Index b) {
            return in_.edges_[a].key < in_.edges_[b].key;
        };
        const auto first_new = std::find_if(in_.order_.begin(), in_.order_.end(),
                                            [&](Index name) { return in_.edges_[name].is_new; });
        std::sort(first_new, in_.order_.end(), comes_before);
        std::inplace_merge(in_.order_.begin(), first_new, in_.order_.end(), comes_before);
    }

    void list_edges() {
        numbers_.resize(in_.edges_.size());
        out_.edges.clear();
        for (const Index name : in_.order_) {
            ticker_.tick();
            numbers_[name] = static_cast<Index>(out_.edges.size());
            const Edge& edge = in_.edges_[name];
            out_.edges.push_back({SiteId(edge.left), SiteId(edge.right), no_index, no_index});
        }
    }

    // The end of the Voronoi edge that lies at the end of an arc.
    [[nodiscard]] EdgeEnd edge_end(ArcEnd end) const {
        const Index name = in_.edge_of_arc_[end / 2];
        return {numbers_[name], in_.first_ends_[name] == end};
    }

    void attach(const EdgeEnd& end, Index site, Index vertex) {
        out_.vertex_ends.push_back(end);
        out_.vertex_sites.push_back(SiteId(site));
        (end.is_tail ? out_.edges[end.edge].tail : out_.edges[end.edge].head) = vertex;
    }

    void finish_vertex() {
        out_.vertex_offsets.push_back(static_cast<Index>(out_.vertex_ends.size()));
    }

    void add_voronoi_vertices() {
        Index vertex = 0;
        for (const FaceVoronoiVertices& in_face : in_.voronoi_vertices_) {
            ticker_.tick();
            for (const ArcStore::VoronoiVertex& voronoi_vertex :
                 arcs_.voronoi_vertices()[in_face.voronoi_vertices]) {
                for (std::size_t k = 0; k < 3; ++k) {
                    attach(edge_end(voronoi_vertex.ends[k]), voronoi_vertex.sites[k], vertex);
                }
                finish_vertex();
                ++vertex;
            }
        }
    }

    // What lies between the crossings of a boundary, and the vertices at them.
    void add_boundary() {
        for (const std::vector<Index>& loop : in_.boundary_loops_) {
            std::vector<BoundaryCrossing>& crossings = boundary_crossings_.emplace_back();
            for (Index i = 0; i < loop.size(); ++i) {
                // A boundary edge has one half-edge, so its crossings run along the loop.
                const Block& row = labels_.edge_rows[surface_.edge[loop[i]]];
                for (Index node = row.begin; node < row.end(); ++node) {
                    const Crossing& c = labels_.crossings[node];
                    crossings.push_back({node, i, c.site_before, c.site_after});
                }
            }
            const Index site = labels_.point_site[surface_.tail(loop[0])];
            if (!crossings.empty()) {
                add_boundary_arcs(crossings);
            } else if (site != no_index) {
                out_.edges.push_back({SiteId(site), {}, no_index, no_index});
            }
        }
    }

    void add_boundary_arcs(std::span<const BoundaryCrossing> crossings) {
        const auto first_edge = static_cast<Index>(out_.edges.size());
        const auto count = static_cast<Index>(crossings.size());
        for (const BoundaryCrossing& from : crossings) {
            out_.edges.push_back({SiteId(from.site_after), {}, no_index, no_index});
        }
        for (Index i = 0; i < count; ++i) {
            const BoundaryCrossing& c = crossings[i];
            const auto vertex = static_cast<Index>(out_.vertex_offsets.size()) - 1;
            const Index behind = first_edge + (i + count - 1) % count;
            attach({first_edge + i, true}, c.site_after, vertex);
            attach(edge_end(in_.crossing_ends_[c.node][0]), c.site_before, vertex);
            attach({behind, false}, no_index, vertex);
            finish_vertex();
        }
    }

    // Edge after edge.
    void gather_points() {
        std::vector<SurfacePoint>& old_points = in_.points_;
        std::vector<double>& old_distances = in_.point_distance_;
        std::vector<Passage>& old_passages = in_.passages_;
        std::swap(out_.points, old_points);
        std::swap(out_.point_distance, old_distances);
        std::swap(out_.passages, old_passages);
        out_.points.clear();
        out_.point_distance.clear();
        out_.passages.clear();
        const std::size_t num_arcs = arcs_.arcs().size();  // A node an arc, and the ends.
        out_.points.reserve(num_arcs + num_arcs / 4 + arcs_.points().size());
        out_.point_distance.reserve(out_.points.capacity());
        out_.passages.reserve(out_.points.capacity());
        out_.edge_points.assign(1, 0);
        // Old ones that follow one another are copied together.
        Block kept;
        const auto copy_kept = [&] {
            const auto copy = [&](const auto& from, auto& to) {
                to.insert(to.end(), from.begin() + kept.begin, from.begin() + kept.end());
            };
            copy(old_points, out_.points);
            copy(old_distances, out_.point_distance);
            copy(old_passages, out_.passages);
            kept = {};
        };
        for (const Index name : in_.order_) {
            Edge& edge = in_.edges_[name];
            if (edge.is_new || edge.first_point != kept.end()) copy_kept();
            if (std::exchange(edge.is_new, false)) {
                edge.first_point = out_.edge_points.back();
                walk(in_.first_ends_[name], edge.last);
                end_edge();
                edge.num_points = out_.edge_points.back() - edge.first_point;
                continue;
            }
            if (kept.count == 0) kept.begin = edge.first_point;
            kept.count += edge.num_points;
            edge.first_point = out_.edge_points.back();
            out_.edge_points.push_back(edge.first_point + edge.num_points);
        }
        copy_kept();
    }

    void walk(ArcEnd from, ArcEnd last) {
        while (true) {
            ticker_.tick();
            const LocalArc& arc = arcs_.arcs()[from / 2];
            const Index node = node_at(arcs_, from);
            const bool is_across = from % 2 == 0 ? arc.tail_is_across : arc.head_is_across;
            add_node(node, in_.is_vertex(node) ? Passage{} : nodes_.passage(node, is_across));
            add_inner_points(from);
            const ArcEnd to = other_end(from);
            if (to == last) break;
            from = in_.across(arcs_, to);
        }
        // A closed curve does not repeat its first point.
        const Index end = node_at(arcs_, last);
        if (in_.is_vertex(end)) add_node(end, {});
    }

    void add_inner_points(ArcEnd from) {
        const LocalArc& arc = arcs_.arcs()[from / 2];
        for (Index j = 0; j < arc.num_points; ++j) {
            const Index k = arc.first_point + (from % 2 == 0 ? j : arc.num_points - 1 - j);
            const ArcStore::Point& point = arcs_.points()[k];
            add_point(to_surface(surface_, arc.face, point.position), point.distance, {});
        }
    }

    void draw_boundary(const std::vector<Index>& loop,
                       const std::vector<BoundaryCrossing>& crossings) {
        if (crossings.empty()) {
            if (labels_.point_site[surface_.tail(loop[0])] == no_index) return;
            for (const Index h : loop) add_mesh_vertex(h);
            end_edge();
            return;
        }
        const auto count = static_cast<Index>(crossings.size());
        const auto loop_size = static_cast<Index>(loop.size());
        for (Index i = 0; i < count; ++i) {
            const BoundaryCrossing& from = crossings[i];
            const BoundaryCrossing& to = crossings[(i + 1) % count];
            add_node(from.node, nodes_.passage(from.node, false));
            // The mesh vertices between: tails of the half-edges after `from` up to that of `to`.
            Index steps = (to.position + loop_size - from.position) % loop_size;
            if (steps == 0 && i + 1 == count) steps = loop_size;
            for (Index j = 1; j <= steps; ++j) {
                add_mesh_vertex(loop[(from.position + j) % loop_size]);
            }
            add_node(to.node, nodes_.passage(to.node, false));
            end_edge();
        }
        for (const BoundaryCrossing& crossing : crossings) {
            out_.vertices.push_back(nodes_.point(crossing.node));
            out_.vertex_distance.push_back(nodes_.distance(crossing.node));
        }
    }

    void add_point(const SurfacePoint& point, double distance, const Passage& passage) {
        out_.points.push_back(point);
        out_.point_distance.push_back(distance);
        out_.passages.push_back(passage);
    }
    void add_node(Index node, const Passage& passage) {
        add_point(nodes_.point(node), nodes_.distance(node), passage);
    }
    void add_mesh_vertex(Index half_edge) {
        const Index v = surface_.tail(half_edge);
        SurfacePoint point{FaceId(Surface::face(half_edge)), {0, 0, 0}};
        point.barycentric[half_edge % 3] = 1;
        add_point(point, labels_.vertex_distance[v],
                  {static_cast<std::uint8_t>(half_edge % 3), true});
    }
    void end_edge() { out_.edge_points.push_back(static_cast<Index>(out_.points.size())); }

    const Surface& surface_;
    const EdgeLabels& labels_;
    const ArcStore& arcs_;
    Nodes nodes_;
    Ticker ticker_;
    ArcJoiner& in_;
    Diagram& out_;
    std::vector<Index> numbers_;  // By edge of the joiner, in the diagram.
    std::vector<std::vector<BoundaryCrossing>> boundary_crossings_;  // By loop.
};

void ArcJoiner::draw(const Surface& surface, const EdgeLabels& labels, const ArcStore& arcs,
                     Ticker ticker, Diagram& diagram) {
    Drawing(surface, labels, arcs, ticker, *this, diagram).run();
}

}  // namespace agvd
