// Ends of degenerate Voronoi edges become one point. The polygon of the cells around each is cut by
// removing ears whose diagonal is new.
#include "remesh/dual/build_dual.h"

#include <algorithm>
#include <array>
#include <set>

#include "agvd/core/progress.h"
#include "agvd/core/types.h"
#include "agvd/core/union_find.h"

namespace remesh {
namespace {

// Relative to the distance from the sites. Voronoi vertices are Newton solutions with errors of
// about 1e-12, or more where bisectors meet at a small angle.
constexpr double relative_length = 1e-8;

bool is_inner_vertex(const Diagram& diagram, Index vertex) {
    for (Index i = diagram.vertex_offsets[vertex]; i < diagram.vertex_offsets[vertex + 1]; ++i) {
        if (!diagram.vertex_sites[i].is_valid()) return false;
    }
    return true;
}

// #edges: true for an edge between two inner Voronoi vertices that coincide up to rounding. There
// the dual may use either diagonal.
std::vector<bool> find_degenerate_edges(const Surface& surface, const Diagram& diagram,
                                        Ticker ticker) {
    std::vector<bool> result(diagram.edges.size(), false);
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const VoronoiEdge& edge = diagram.edges[e];
        ticker.tick(1 + diagram.edge_points[e + 1] - diagram.edge_points[e]);
        if (edge.tail == no_index || edge.tail == edge.head || !edge.right.is_valid()) continue;
        if (!is_inner_vertex(diagram, edge.tail) || !is_inner_vertex(diagram, edge.head)) continue;
        result[e] = curve_length(surface, diagram, e) <=
                    relative_length * diagram.vertex_distance[edge.tail];
    }
    return result;
}

class DualBuilder {
public:
    DualBuilder(const Diagram& diagram, std::vector<bool> is_contracted, Ticker ticker)
        : diagram_(diagram), is_contracted_(std::move(is_contracted)), ticker_(ticker) {
        keep_forest();
        locate_ends();
        for (Index e = 0; e < diagram.edges.size(); ++e) {
            const VoronoiEdge& edge = diagram.edges[e];
            ticker_.tick(4);  // A set is slow.
            if (is_contracted_[e] || !edge.right.is_valid()) continue;
            taken_.insert(edge_key(edge.left.value(), edge.right.value()));
        }
    }

    std::vector<Triangle> run() {
        std::vector<bool> is_done(diagram_.vertices.size(), false);
        for (Index v = 0; v < diagram_.vertices.size(); ++v) {
            ticker_.tick();
            if (is_done[v]) continue;
            polygon_.clear();
            collect_polygon(v, is_done);
            if (std::find(polygon_.begin(), polygon_.end(), no_index) != polygon_.end()) continue;
            triangulate();
        }
        return std::move(triangles_);
    }

private:
    // Contracted edges must not close a cycle, otherwise the polygon would have a hole.
    void keep_forest() {
        UnionFind joined(diagram_.vertices.size());
        for (Index e = 0; e < diagram_.edges.size(); ++e) {
            const VoronoiEdge& edge = diagram_.edges[e];
            if (is_contracted_[e]) is_contracted_[e] = joined.unite(edge.tail, edge.head);
        }
    }

    void locate_ends() {
        end_at_.assign(2 * diagram_.edges.size(), no_index);
        vertex_of_end_.resize(diagram_.vertex_ends.size());
        for (Index v = 0; v < diagram_.vertices.size(); ++v) {
            for (Index i = diagram_.vertex_offsets[v]; i < diagram_.vertex_offsets[v + 1]; ++i) {
                const EdgeEnd& end = diagram_.vertex_ends[i];
                end_at_[2 * end.edge + (end.is_tail ? 0 : 1)] = i;
                vertex_of_end_[i] = v;
            }
        }
    }

    [[nodiscard]] Index next_around(Index end) const {
        const Index v = vertex_of_end_[end];
        return end + 1 == diagram_.vertex_offsets[v + 1] ? diagram_.vertex_offsets[v] : end + 1;
    }

    // Collects the cells around v and all vertices contracted with it, counter-clockwise.
    void collect_polygon(Index v, std::vector<bool>& is_done) {
        is_done[v] = true;
        Index end = diagram_.vertex_offsets[v];
        while (is_contracted_[diagram_.vertex_ends[end].edge]) {
            end = across(end, is_done);
            end = next_around(end);
        }
        const Index first = end;
        do {
            polygon_.push_back(diagram_.vertex_sites[end].value());
            end = next_around(end);
            while (is_contracted_[diagram_.vertex_ends[end].edge]) {
                end = next_around(across(end, is_done));
            }
        } while (end != first);
    }

    [[nodiscard]] Index across(Index end, std::vector<bool>& is_done) const {
        const EdgeEnd& here = diagram_.vertex_ends[end];
        const Index there = end_at_[2 * here.edge + (here.is_tail ? 1 : 0)];
        is_done[vertex_of_end_[there]] = true;
        return there;
    }

    void triangulate() {
        while (polygon_.size() > 3) {
            std::size_t ear = 0;
            while (ear < polygon_.size() && !is_free_ear(ear)) ++ear;
            if (ear == polygon_.size()) ear = 0;  // All taken: the caller's check finds it.
            const Index a = at(ear + polygon_.size() - 1);
            const Index b = at(ear);
            const Index c = at(ear + 1);
            triangles_.push_back({a, b, c});
            taken_.insert(edge_key(a, c));
            polygon_.erase(polygon_.begin() + static_cast<std::ptrdiff_t>(ear));
        }
        if (polygon_.size() == 3) triangles_.push_back({polygon_[0], polygon_[1], polygon_[2]});
    }

    [[nodiscard]] Index at(std::size_t i) const { return polygon_[i % polygon_.size()]; }

    [[nodiscard]] bool is_free_ear(std::size_t i) const {
        const Index a = at(i + polygon_.size() - 1);
        const Index c = at(i + 1);
        return a != c && !taken_.contains(edge_key(a, c));
    }

    const Diagram& diagram_;
    std::vector<bool> is_contracted_;
    Ticker ticker_;
    std::vector<Index> end_at_;         // By 2 * edge + (0: tail, 1: head): index in vertex_ends.
    std::vector<Index> vertex_of_end_;  // By index in vertex_ends.
    std::set<std::uint64_t> taken_;     // Edges of the dual so far.
    std::vector<Index> polygon_;
    std::vector<Triangle> triangles_;
};

}  // namespace

std::vector<Triangle> build_dual(const Surface& surface, const Diagram& diagram,
                                 const Progress& progress) {
    Poller poller(progress);
    const Ticker ticker(poller);
    return DualBuilder(diagram, find_degenerate_edges(surface, diagram, ticker), ticker).run();
}

const char* delaunay_name(Delaunay delaunay) {
    constexpr std::array names = {"intrinsic", "extrinsic", "off"};
    return names[static_cast<std::size_t>(delaunay)];
}

}  // namespace remesh
