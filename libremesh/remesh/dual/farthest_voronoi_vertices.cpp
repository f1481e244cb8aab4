#include "remesh/dual/farthest_voronoi_vertices.h"

#include <algorithm>

namespace remesh {

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

std::vector<Index> places_in_largest_cells(const Diagram& diagram, std::size_t count) {
    const std::vector<Index> farthest = farthest_voronoi_vertices(diagram);
    std::vector<Index> cells;
    for (Index s = 0; s < farthest.size(); ++s) {
        if (farthest[s] != no_index) cells.push_back(s);
    }
    std::stable_sort(cells.begin(), cells.end(),
                     [&](Index a, Index b) { return diagram.cell_area[a] > diagram.cell_area[b]; });
    std::vector<Index> places;
    std::vector<bool> is_taken(diagram.vertices.size(), false);
    for (const Index s : cells) {
        if (places.size() == count) break;
        if (is_taken[farthest[s]]) continue;
        is_taken[farthest[s]] = true;
        places.push_back(farthest[s]);
    }
    return places;
}

}  // namespace remesh
