#include "remesh/guarantee/farthest_voronoi_vertices.h"

namespace remesh {

using agvd::Index;
using agvd::no_index;

std::vector<Index> farthest_voronoi_vertices(const agvd::Diagram& diagram) {
    std::vector<Index> farthest(diagram.num_sites, no_index);
    for (Index v = 0; v < diagram.vertices.size(); ++v) {
        for (Index i = diagram.vertex_offsets[v]; i < diagram.vertex_offsets[v + 1]; ++i) {
            const agvd::SiteId site = diagram.vertex_sites[i];
            if (!site.is_valid()) continue;
            Index& best = farthest[site.value()];
            if (best == no_index || diagram.vertex_distance[v] > diagram.vertex_distance[best]) {
                best = v;
            }
        }
    }
    return farthest;
}

}  // namespace remesh
