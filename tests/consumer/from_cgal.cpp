#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>
#include <CGAL/boost/graph/generators.h>
#include <agvd/agvd.h>
#include <remesh/meshfile/face_graph.h>
#include <remesh/remesh.h>

#include <cmath>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace PMP = CGAL::Polygon_mesh_processing;

int main() {
    Mesh mesh;
    CGAL::make_icosahedron<Mesh, Kernel::Point_3>(mesh, {0, 0, 0}, 1);
    const auto input = remesh::from_face_graph(mesh, get(CGAL::vertex_point, mesh));

    // Before: exact distances from a vertex.
    using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>;
    CGAL::Surface_mesh_shortest_path<Traits> paths(mesh);
    paths.add_source_point(*vertices(mesh).begin());
    const double before = paths.shortest_distance_to_source_points(Mesh::Vertex_index(7)).first;
    // After: of all vertices at once. Face 0 has vertex 0 as a corner.
    const agvd::Surface surface = agvd::build_surface(input.mesh);
    agvd::SurfacePoint source{agvd::FaceId(0), {0, 0, 0}};
    for (std::size_t k = 0; k < 3; ++k)
        source.barycentric[k] = input.mesh.triangles[0][k] == 0 ? 1 : 0;
    const double after =
        agvd::propagate(surface, std::vector{source}, {.max_error = 0}).vertex_distance[7];

    // Before: edges of length .2, the mesh itself changes.
    PMP::isotropic_remeshing(faces(mesh), 0.2, mesh, CGAL::parameters::number_of_iterations(10));
    // After: a new mesh.
    const auto result = remesh::remesh(input, {.sizing = {.count = remesh::MeanEdge{0.2}}});

    const auto count = static_cast<double>(num_vertices(mesh));
    const auto new_count = static_cast<double>(result.mesh.positions.size());
    return std::abs(after - before) < 1e-12 && std::abs(new_count / count - 1) < 0.3 ? 0 : 1;
}
