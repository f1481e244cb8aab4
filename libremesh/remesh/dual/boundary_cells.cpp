#include "remesh/dual/boundary_cells.h"

#include <algorithm>
#include <optional>

#include "agvd/diagram/curve_piece.h"
#include "agvd/mesh/surface_points.h"

namespace remesh {
namespace {

// The point half way along an arc of the boundary.
SurfacePoint middle(const Surface& surface, const Diagram& diagram, Index edge) {
    double rest = curve_length(surface, diagram, edge) / 2;
    const Index last = diagram.edge_points[edge + 1] - 1;
    for (Index i = diagram.edge_points[edge]; i < last; ++i) {
        const auto [from, to] = curve_piece(surface, diagram, edge, i);
        const double step = face_distance(surface, from, to);
        if (rest > step && i + 1 < last) {
            rest -= step;
            continue;
        }
        if (!(step > 0)) return from;
        SurfacePoint result = from;
        const double share = std::min(rest / step, 1.0);
        for (std::size_t k = 0; k < 3; ++k) {
            result.barycentric[k] = (1 - share) * from.barycentric[k] + share * to.barycentric[k];
        }
        return result;
    }
    return diagram.points[last];
}

}  // namespace

BoundaryFixes find_boundary_fixes(const Surface& surface, const Diagram& diagram,
                                  std::span<const SurfacePoint> sites,
                                  std::span<const Index> corners) {
    BoundaryFixes fixes;
    std::vector<Index> arc(sites.size(), no_index);  // #sites: the longest of an inner site.
    std::vector<double> arc_length(sites.size(), 0);
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const VoronoiEdge& edge = diagram.edges[e];
        if (edge.right.is_valid() || edge.tail == no_index) continue;
        const Index site = edge.left.value();
        if (is_on_boundary(surface, sites[site])) continue;
        const double along = curve_length(surface, diagram, e);
        if (arc[site] != no_index && along <= arc_length[site]) continue;
        arc[site] = e;
        arc_length[site] = along;
    }
    std::vector<std::optional<SurfacePoint>> place(sites.size());
    for (Index s = 0; s < sites.size(); ++s) {
        if (arc[s] != no_index) place[s] = middle(surface, diagram, arc[s]);
    }
    std::vector<bool> is_corner(surface.num_vertices(), false);
    for (const Index v : corners) is_corner[v] = true;
    std::vector<bool> is_taken(sites.size(), false);  // #sites: at a corner.
    for (Index s = 0; s < sites.size(); ++s) {
        const auto v = vertex_of(surface, sites[s]);
        is_taken[s] = v && is_corner[*v];
    }
    for (const Index v : corners) {
        if (!diagram.nearest_site[v].is_valid()) continue;
        const Index site = diagram.nearest_site[v].value();
        if (vertex_of(surface, sites[site]) == v) continue;
        const SurfacePoint corner = point_at(surface, v);
        if (is_taken[site]) {
            fixes.added.push_back(corner);
        } else {
            place[site] = corner;
            is_taken[site] = true;
        }
    }
    for (Index s = 0; s < sites.size(); ++s) {
        if (place[s]) fixes.moved.emplace_back(s, *place[s]);
    }
    return fixes;
}

}  // namespace remesh
