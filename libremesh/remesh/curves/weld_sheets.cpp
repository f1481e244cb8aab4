#include "remesh/curves/weld_sheets.h"

#include <algorithm>

#include "agvd/mesh/any_mesh.h"

namespace remesh {

std::vector<Triangle> rename_vertices(std::span<const Triangle> triangles,
                                      std::span<const Index> first) {
    std::vector<Triangle> result(triangles.begin(), triangles.end());
    for (Triangle& t : result) {
        for (Index& v : t) v = first[v];
    }
    return result;
}

std::vector<Index> weld_sheets(std::span<const Index> group, TriangleMesh& mesh) {
    if (group.empty()) return {};
    std::vector<Index> number(std::size_t{*std::max_element(group.begin(), group.end())} + 1,
                              no_index);
    std::vector<Index> staying, new_vertex;
    for (Index v = 0; v < group.size(); ++v) {
        Index& welded = number[group[v]];
        if (welded == no_index) {
            welded = static_cast<Index>(staying.size());
            mesh.positions[welded] = mesh.positions[v];
            staying.push_back(v);
        }
        new_vertex.push_back(welded);
    }
    mesh.positions.resize(staying.size());
    mesh.triangles = rename_vertices(mesh.triangles, new_vertex);
    return staying;
}

Index num_branched_edges(std::span<const Triangle> triangles) {
    Index count = 0;
    for_each_edge(sorted_edge_sides(triangles), [&](std::span<const EdgeSide> edge) {
        if (edge.size() > 2) ++count;
    });
    return count;
}

}  // namespace remesh
