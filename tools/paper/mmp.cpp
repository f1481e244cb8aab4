// [mitchell1987] by Danil Kirsanov's code, as https://github.com/mhogg/pygeodesic has it.
#include <cstring>

#include "paper/other_codes.h"

#define geodesic geodesic_mmp  // The other code has the same names.
#include "geodesic_algorithm_exact.h"

namespace bench {

std::vector<double> mmp_distances(FlatMesh& flat, std::span<const agvd::Index> sources) {
    geodesic::Mesh mesh;
    mesh.initialize_mesh_data(flat.coordinates, flat.corners);
    geodesic::GeodesicAlgorithmExact algorithm(&mesh);
    std::vector<geodesic::SurfacePoint> points;
    for (const agvd::Index v : sources) points.emplace_back(&mesh.vertices()[v]);
    algorithm.propagate(points);
    std::vector<double> distance(mesh.vertices().size());
    for (std::size_t v = 0; v < distance.size(); ++v) {
        geodesic::SurfacePoint point(&mesh.vertices()[v]);
        algorithm.best_source(point, distance[v]);
    }
    return distance;
}

}  // namespace bench
