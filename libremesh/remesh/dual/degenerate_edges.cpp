#include "remesh/dual/degenerate_edges.h"

#include "agvd/diagram/diagram.h"

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

}  // namespace

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

}  // namespace remesh
