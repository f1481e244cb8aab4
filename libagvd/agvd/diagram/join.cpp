#include "agvd/diagram/join.h"

#include <cassert>

namespace agvd {
namespace {

// One end of an arc: 2 * arc + (0: tail, 1: head).
using ArcEnd = Index;
constexpr ArcEnd tail_of(Index arc) { return 2 * arc; }
constexpr ArcEnd head_of(Index arc) { return 2 * arc + 1; }
constexpr ArcEnd other_end(ArcEnd end) { return end ^ 1; }

struct Arc {
    Index tail, head;  // Global nodes: crossings, then branches.
    Index left, right;
    Index chunk, local;
};

struct Node {
    SurfacePoint point;
    double distance = 0;
    std::array<ArcEnd, 2> ends{no_index, no_index};  // Crossings only.
};

class Joiner {
public:
    Joiner(const Surface& surface, const EdgeLabels& labels, std::span<const FaceArcs> chunks,
           Diagram& diagram)
        : surface_(surface), labels_(labels), chunks_(chunks), out_(diagram) {}

    void run() {
        number_nodes();
        collect_arcs();
        std::size_t num_points = arcs_.size() + arcs_.size() / 4;  // A node an arc, and the ends.
        for (const FaceArcs& chunk : chunks_) num_points += chunk.local.points.size();
        out_.points.reserve(num_points);
        out_.point_distance.reserve(num_points);
        edge_end_.assign(2 * arcs_.size(), {});
        is_used_.assign(arcs_.size(), false);
        out_.edge_points.assign(1, 0);
        for (ArcEnd end = 0; end < 2 * arcs_.size(); ++end) {
            if (!is_used_[end / 2] && is_vertex(node_at(end))) walk(end);
        }
        for (Index arc = 0; arc < arcs_.size(); ++arc) {
            if (!is_used_[arc]) walk(tail_of(arc));  // Closed curves.
        }
        out_.vertex_offsets.assign(1, 0);
        add_branches();
        add_boundary();
    }

private:
    void number_nodes() {
        nodes_.resize(labels_.crossings.size());
        is_boundary_.assign(labels_.crossings.size(), 0);
        for (const CrossingRow& row : labels_.rows) {
            for (Index c = row.begin; c < row.begin + row.count; ++c) {
                const Crossing& crossing = labels_.crossings[c];
                nodes_[c].distance = crossing.distance;
                if (row.edge >= CrossingRow::first_cut) {
                    nodes_[c].point =
                        point_on_cut(labels_.cuts[row.edge - CrossingRow::first_cut], crossing.at);
                    continue;
                }
                const Index h = surface_.edge_half[row.edge];
                nodes_[c].point = {FaceId(Surface::face(h)), {0, 0, 0}};
                nodes_[c].point.barycentric[h % 3] = 1 - crossing.at;
                nodes_[c].point.barycentric[(h + 1) % 3] = crossing.at;
                is_boundary_[c] = surface_.twin[h] == no_index ? 1 : 0;
            }
        }
        first_branch_ = static_cast<Index>(nodes_.size());
        for (const FaceArcs& chunk : chunks_) {
            branch_offset_.push_back(static_cast<Index>(nodes_.size()));
            for (const LocalBranch& branch : chunk.local.branches) {
                nodes_.push_back(
                    {to_surface(surface_, branch.face, branch.position), branch.distance});
            }
        }
    }

    [[nodiscard]] SurfacePoint point_on_cut(const Cut& cut, double at) const {
        const Vec2 from = position_of(cut.face, cut.from);
        const Vec2 to = position_of(cut.face, cut.to);
        return to_surface(surface_, cut.face, (1 - at) * from + at * to);
    }

    [[nodiscard]] Vec2 position_of(Index face, Index point) const {
        if (point >= surface_.num_vertices()) {
            return labels_.inner_points[point - surface_.num_vertices()].position;
        }
        const Triangle& triangle = surface_.mesh.triangles[face];
        return face_corners(surface_, face)[point == triangle[0]   ? 0
                                            : point == triangle[1] ? 1
                                                                   : 2];
    }

    [[nodiscard]] Index global_node(Index chunk, Index local) const {
        return local < LocalDiagram::first_branch
                   ? local
                   : branch_offset_[chunk] + local - LocalDiagram::first_branch;
    }

    void collect_arcs() {
        std::size_t count = 0;
        for (const FaceArcs& chunk : chunks_) count += chunk.local.arcs.size();
        arcs_.reserve(count);
        for (Index chunk = 0; chunk < chunks_.size(); ++chunk) {
            arc_offset_.push_back(static_cast<Index>(arcs_.size()));
            const auto& local_arcs = chunks_[chunk].local.arcs;
            for (Index i = 0; i < local_arcs.size(); ++i) {
                const LocalArc& a = local_arcs[i];
                const auto arc = static_cast<Index>(arcs_.size());
                arcs_.push_back({global_node(chunk, a.tail), global_node(chunk, a.head), a.left,
                                 a.right, chunk, i});
                for (const ArcEnd end : {tail_of(arc), head_of(arc)}) {
                    if (node_at(end) >= first_branch_) continue;
                    auto& ends = nodes_[node_at(end)].ends;
                    assert(ends[1] == no_index);
                    ends[ends[0] == no_index ? 0 : 1] = end;
                }
            }
        }
    }

    [[nodiscard]] Index node_at(ArcEnd end) const {
        return end % 2 == 0 ? arcs_[end / 2].tail : arcs_[end / 2].head;
    }
    [[nodiscard]] bool is_vertex(Index node) const {
        return node >= first_branch_ || (node < is_boundary_.size() && is_boundary_[node] != 0);
    }

    void add_point(const SurfacePoint& point, double distance) {
        out_.points.push_back(point);
        out_.point_distance.push_back(distance);
    }
    void add_node_point(Index node) { add_point(nodes_[node].point, nodes_[node].distance); }

    void add_inner_points(ArcEnd from) {
        const Arc& arc = arcs_[from / 2];
        const LocalDiagram& local = chunks_[arc.chunk].local;
        const LocalArc& a = local.arcs[arc.local];
        for (Index j = 0; j < a.num_points; ++j) {
            const Index k = a.first_point + (from % 2 == 0 ? j : a.num_points - 1 - j);
            add_point(to_surface(surface_, a.face, local.points[k]), local.point_distance[k]);
        }
    }

    // Follows the arcs from one end through crossings until a Voronoi vertex or the start.
    void walk(ArcEnd start) {
        const auto edge = static_cast<Index>(out_.edges.size());
        const Arc& first = arcs_[start / 2];
        VoronoiEdge& result = out_.edges.emplace_back();
        result.left = SiteId(start % 2 == 0 ? first.left : first.right);
        result.right = SiteId(start % 2 == 0 ? first.right : first.left);
        const bool is_closed = !is_vertex(node_at(start));
        ArcEnd from = start;
        while (true) {
            is_used_[from / 2] = true;
            add_node_point(node_at(from));
            add_inner_points(from);
            const ArcEnd to = other_end(from);
            const Index node = node_at(to);
            if (is_vertex(node)) {
                add_node_point(node);
                edge_end_[start] = {edge, true};
                edge_end_[to] = {edge, false};
                break;
            }
            const auto& ends = nodes_[node].ends;
            from = ends[0] == to ? ends[1] : ends[0];
            if (is_closed && from == start) break;
        }
        out_.edge_points.push_back(static_cast<Index>(out_.points.size()));
    }

    void attach(const EdgeEnd& end, Index site, Index vertex) {
        out_.vertex_ends.push_back(end);
        out_.vertex_sites.push_back(SiteId(site));
        (end.is_tail ? out_.edges[end.edge].tail : out_.edges[end.edge].head) = vertex;
    }

    void finish_vertex(Index node) {
        out_.vertices.push_back(nodes_[node].point);
        out_.vertex_distance.push_back(nodes_[node].distance);
        out_.vertex_offsets.push_back(static_cast<Index>(out_.vertex_ends.size()));
    }

    void add_branches() {
        for (Index chunk = 0; chunk < chunks_.size(); ++chunk) {
            const auto& branches = chunks_[chunk].local.branches;
            for (Index i = 0; i < branches.size(); ++i) {
                const auto vertex = static_cast<Index>(out_.vertices.size());
                for (std::size_t k = 0; k < 3; ++k) {
                    const Index arc = arc_offset_[chunk] + branches[i].arcs[k];
                    const ArcEnd end = branches[i].at_tail[k] ? tail_of(arc) : head_of(arc);
                    attach(edge_end_[end], branches[i].sites[k], vertex);
                }
                finish_vertex(branch_offset_[chunk] + i);
            }
        }
    }

    // Label changes along one boundary loop, in its direction (the surface on the left).
    struct BoundaryCrossing {
        Index node;
        Index position;  // In the loop.
        Index site_before, site_after;
    };

    void add_boundary() {
        for (const std::vector<Index>& loop : boundary_loops(surface_)) {
            std::vector<BoundaryCrossing> crossings;
            for (Index i = 0; i < loop.size(); ++i) {
                // A boundary edge has one half-edge, so its crossings run along the loop.
                const auto on_edge = labels_.on_edge(surface_.edge[loop[i]]);
                for (const Crossing& c : on_edge) {
                    const auto node = static_cast<Index>(&c - labels_.crossings.data());
                    crossings.push_back({node, i, c.site_before, c.site_after});
                }
            }
            if (crossings.empty()) {
                add_closed_boundary(loop);
            } else {
                add_boundary_arcs(loop, crossings);
            }
        }
    }

    void add_mesh_vertex(Index half_edge) {
        const Index v = surface_.tail(half_edge);
        SurfacePoint point{FaceId(Surface::face(half_edge)), {0, 0, 0}};
        point.barycentric[half_edge % 3] = 1;
        add_point(point, labels_.vertex_distance[v]);
    }

    void add_closed_boundary(const std::vector<Index>& loop) {
        const Index site = labels_.point_site[surface_.tail(loop[0])];
        if (site == no_index) return;
        for (const Index h : loop) add_mesh_vertex(h);
        out_.edges.push_back({SiteId(site), {}, no_index, no_index});
        out_.edge_points.push_back(static_cast<Index>(out_.points.size()));
    }

    void add_boundary_arcs(const std::vector<Index>& loop,
                           const std::vector<BoundaryCrossing>& crossings) {
        const auto first_edge = static_cast<Index>(out_.edges.size());
        const auto count = static_cast<Index>(crossings.size());
        const auto loop_size = static_cast<Index>(loop.size());
        for (Index i = 0; i < count; ++i) {
            const BoundaryCrossing& from = crossings[i];
            const BoundaryCrossing& to = crossings[(i + 1) % count];
            add_node_point(from.node);
            // The mesh vertices between: tails of the half-edges after `from` up to that of `to`.
            Index steps = (to.position + loop_size - from.position) % loop_size;
            if (steps == 0 && i + 1 == count) steps = loop_size;
            for (Index j = 1; j <= steps; ++j)
                add_mesh_vertex(loop[(from.position + j) % loop_size]);
            add_node_point(to.node);
            out_.edges.push_back({SiteId(from.site_after), {}, no_index, no_index});
            out_.edge_points.push_back(static_cast<Index>(out_.points.size()));
        }
        for (Index i = 0; i < count; ++i) {
            const BoundaryCrossing& c = crossings[i];
            const auto vertex = static_cast<Index>(out_.vertices.size());
            const Index behind = first_edge + (i + count - 1) % count;
            attach({first_edge + i, true}, c.site_after, vertex);
            attach(edge_end_[nodes_[c.node].ends[0]], c.site_before, vertex);
            attach({behind, false}, no_index, vertex);
            finish_vertex(c.node);
        }
    }

    const Surface& surface_;
    const EdgeLabels& labels_;
    std::span<const FaceArcs> chunks_;
    Diagram& out_;

    std::vector<Node> nodes_;
    std::vector<std::uint8_t> is_boundary_;          // Of the crossings.
    std::vector<Index> branch_offset_, arc_offset_;  // By chunk.
    Index first_branch_ = 0;
    std::vector<Arc> arcs_;
    std::vector<EdgeEnd> edge_end_;  // By arc end: the end of the Voronoi edge that lies there.
    std::vector<bool> is_used_;
};

}  // namespace

void join_arcs(const Surface& surface, const EdgeLabels& labels, std::span<const FaceArcs> chunks,
               Diagram& diagram) {
    Joiner(surface, labels, chunks, diagram).run();
}

}  // namespace agvd
