#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <remesh/meshfile/face_graph.h>
#include <remesh/remesh.h>

int main() {
    using Point = CGAL::Simple_cartesian<double>::Point_3;
    CGAL::Surface_mesh<Point> mesh;  // Or a Polyhedron_3, ...
    CGAL::make_hexahedron(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0),
                          Point(0, 1, 1), Point(0, 0, 1), Point(1, 0, 1), Point(1, 1, 1), mesh);
    const auto input = remesh::from_face_graph(mesh, get(CGAL::vertex_point, mesh));
    const auto result = remesh::remesh(input, {.num_samples = 100});
    std::vector<Point> points;
    for (const auto& p : result.mesh.positions) points.emplace_back(p.x(), p.y(), p.z());
    CGAL::Surface_mesh<Point> back;
    CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, result.mesh.triangles,
                                                                back);
    return num_vertices(back) == 100 ? 0 : 1;
}
