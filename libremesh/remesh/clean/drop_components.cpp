#include "remesh/clean/drop_components.h"

#include <algorithm>
#include <string>

#include "agvd/core/error.h"

namespace remesh {

Index drop_components(CleanResult& clean, const Topology& topology, double least_share) {
    double area = 0;
    for (const ComponentTopology& c : topology.components) area += c.area;
    std::vector<bool> stays;
    for (const ComponentTopology& c : topology.components) {
        stays.push_back(c.area >= least_share * area);
    }
    const auto dropped = static_cast<Index>(std::count(stays.begin(), stays.end(), false));
    if (dropped == 0) return 0;
    if (dropped == stays.size()) {
        throw InvalidOption("no component has " + std::to_string(100 * least_share) +
                            " % of the area or more; use a smaller drop_components");
    }
    clean.connectivity = {};
    std::vector<Index> number(clean.mesh.positions.size(), no_index);
    Index num_faces = 0;
    for (Index f = 0; f < clean.mesh.triangles.size(); ++f) {
        if (!stays[topology.face_component[f]]) continue;
        for (const Index v : clean.mesh.triangles[f]) number[v] = 0;
        clean.mesh.triangles[num_faces] = clean.mesh.triangles[f];
        clean.face_origin[num_faces++] = clean.face_origin[f];
    }
    clean.mesh.triangles.resize(num_faces);
    clean.face_origin.resize(num_faces);
    Index num_vertices = 0;
    for (Index v = 0; v < number.size(); ++v) {
        if (number[v] == no_index) continue;
        clean.mesh.positions[num_vertices] = clean.mesh.positions[v];
        clean.vertex_origin[num_vertices] = clean.vertex_origin[v];
        number[v] = num_vertices++;
    }
    clean.mesh.positions.resize(num_vertices);
    clean.vertex_origin.resize(num_vertices);
    for (Triangle& t : clean.mesh.triangles) {
        for (Index& v : t) v = number[v];
    }
    return dropped;
}

}  // namespace remesh
