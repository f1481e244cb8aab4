// [qin2016] by its authors' code, https://github.com/YipengQin/VTP_source_code.
#include <cstring>

#include "paper/other_codes.h"
#include "stdafx.h"

#define geodesic geodesic_vtp  // The other code has the same names.
#define private public         // propagate() takes one source; what it does with it is private.
#define auto_ptr unique_ptr    // It is written for C++98 and another compiler.
#define sscanf_s sscanf
#include "geodesic_algorithm_exact.h"
#undef private
#undef auto_ptr
#undef sscanf_s

namespace bench {

std::vector<double> vtp_distances(FlatMesh& flat, std::span<const agvd::Index> sources) {
    geodesic::Mesh mesh;
    mesh.initialize_mesh_data(flat.coordinates, flat.corners);
    geodesic::GeodesicAlgorithmExact algorithm(&mesh);
    for (const agvd::Index v : sources.subspan(1)) {
        geodesic::vertex_pointer source = &mesh.vertices()[v];
        source->geodesic_distance() = 0;
        source->state() = geodesic::Vertex::INSIDE;
        algorithm.create_pseudo_source_windows(source, false);
    }
    algorithm.propagate(sources[0]);
    std::vector<double> distance;
    for (auto& vertex : mesh.vertices()) distance.push_back(vertex.geodesic_distance());
    return distance;
}

}  // namespace bench
