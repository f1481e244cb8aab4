// Where sites are moved or added: onto the boundary, and far inside cells.
#include "remesh/dual/closed_ball.h"

#include <algorithm>
#include <optional>

#include "agvd/diagram/diagram.h"
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
    std::vector<std::optional<SurfacePoint>> moved(sites.size());
    for (Index s = 0; s < sites.size(); ++s) {
        if (arc[s] != no_index) moved[s] = middle(surface, diagram, arc[s]);
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
            moved[site] = corner;
            is_taken[site] = true;
        }
    }
    for (Index s = 0; s < sites.size(); ++s) {
        if (moved[s]) fixes.moved.emplace_back(s, *moved[s]);
    }
    return fixes;
}

std::vector<Index> farthest_voronoi_vertices(const Diagram& diagram) {
    std::vector<Index> farthest(diagram.num_sites, no_index);
    for (Index v = 0; v < diagram.vertices.size(); ++v) {
        for (Index i = diagram.vertex_offsets[v]; i < diagram.vertex_offsets[v + 1]; ++i) {
            const SiteId site = diagram.vertex_sites[i];
            if (!site.is_valid()) continue;
            Index& best = farthest[site.value()];
            if (best == no_index || diagram.vertex_distance[v] > diagram.vertex_distance[best]) {
                best = v;
            }
        }
    }
    return farthest;
}

std::vector<Index> points_in_largest_cells(const Diagram& diagram, std::size_t count) {
    const std::vector<Index> farthest = farthest_voronoi_vertices(diagram);
    std::vector<Index> cells;
    for (Index s = 0; s < farthest.size(); ++s) {
        if (farthest[s] != no_index) cells.push_back(s);
    }
    std::stable_sort(cells.begin(), cells.end(),
                     [&](Index a, Index b) { return diagram.cell_area[a] > diagram.cell_area[b]; });
    std::vector<Index> points;
    std::vector<bool> is_taken(diagram.vertices.size(), false);
    for (const Index s : cells) {
        if (points.size() == count) break;
        if (is_taken[farthest[s]]) continue;
        is_taken[farthest[s]] = true;
        points.push_back(farthest[s]);
    }
    return points;
}

}  // namespace remesh
