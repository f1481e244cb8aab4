#include "remesh/meshfile/face_graph.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <gtest/gtest.h>

#include "agvd/mesh/topology.h"
#include "support/shapes.h"

using agvd::Triangle;
using agvd::Vec3;

namespace {

// A cube of six quads.
template <typename Point, typename Graph>
void make_cube(Graph& graph) {
    CGAL::make_hexahedron(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0),
                          Point(0, 1, 1), Point(0, 0, 1), Point(1, 0, 1), Point(1, 1, 1), graph);
}

template <typename Graph>
void expect_cube(const Graph& graph) {
    const auto result = remesh::from_face_graph(graph, get(CGAL::vertex_point, graph));
    EXPECT_EQ(result.mesh.positions.size(), 8u);
    ASSERT_EQ(result.mesh.triangles.size(), 12u);
    EXPECT_NEAR(std::abs(shapes::signed_volume(result.mesh)), 1, 1e-15);
    const agvd::MeshView view = result;
    EXPECT_EQ(view.triangles.data(), result.mesh.triangles.data());

    // Each triangle lies in the face that it names, each position is that of its vertex.
    ASSERT_EQ(result.faces.size(), 12u);
    ASSERT_EQ(result.vertices.size(), 8u);
    for (std::size_t t = 0; t < 12; ++t) {
        EXPECT_TRUE(result.faces[t] == *std::next(faces(graph).begin(), static_cast<long>(t / 2)));
        std::size_t found = 0;
        for (const auto v : vertices_around_face(halfedge(result.faces[t], graph), graph)) {
            for (const agvd::Index corner : result.mesh.triangles[t]) {
                found += result.vertices[corner] == v ? 1 : 0;
            }
        }
        EXPECT_EQ(found, 3u);
    }
    for (std::size_t v = 0; v < 8; ++v) {
        const auto& p = get(CGAL::vertex_point, graph, result.vertices[v]);
        EXPECT_EQ(result.mesh.positions[v].x(), CGAL::to_double(p.x()));
        EXPECT_EQ(result.mesh.positions[v].z(), CGAL::to_double(p.z()));
    }
}

}  // namespace

TEST(FaceGraph, SurfaceMeshesAndPolyhedraOfAnyKernelAreMeshes) {
    using Double = CGAL::Simple_cartesian<double>;
    using Float = CGAL::Simple_cartesian<float>;
    using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
    CGAL::Surface_mesh<Double::Point_3> mesh;
    make_cube<Double::Point_3>(mesh);
    expect_cube(mesh);
    CGAL::Surface_mesh<Float::Point_3> floats;
    make_cube<Float::Point_3>(floats);
    expect_cube(floats);
    CGAL::Surface_mesh<Exact::Point_3> exact;
    make_cube<Exact::Point_3>(exact);
    expect_cube(exact);
    CGAL::Polyhedron_3<Double> polyhedron;
    make_cube<Double::Point_3>(polyhedron);
    expect_cube(polyhedron);
}

TEST(FaceGraph, RemovedElementsAreSkippedAndIsolatedVerticesStay) {
    using Point = CGAL::Simple_cartesian<double>::Point_3;
    CGAL::Surface_mesh<Point> mesh;
    const auto gone = mesh.add_vertex(Point(9, 9, 9));
    const auto a = mesh.add_vertex(Point(0, 0, 0)), b = mesh.add_vertex(Point(1, 0, 0)),
               c = mesh.add_vertex(Point(0, 1, 0)), alone = mesh.add_vertex(Point(5, 5, 5));
    mesh.add_face(a, b, c);
    mesh.remove_vertex(gone);
    const auto result = remesh::from_face_graph(mesh, mesh.points());
    EXPECT_EQ(result.mesh.positions,
              (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}));
    EXPECT_EQ(result.vertices[3], alone);
    ASSERT_EQ(result.mesh.triangles.size(), 1u);
    Triangle triangle = result.mesh.triangles[0];
    std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
    EXPECT_EQ(triangle, (Triangle{0, 1, 2}));
}
