// CGAL's isotropic remeshing as a program, for scripts/peers.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <CLI/CLI.hpp>

#include "cli.h"
#include "remesh/clean/clean_input.h"
#include "remesh/meshfile/face_graph.h"
#include "remesh/meshfile/mesh_file.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace PMP = CGAL::Polygon_mesh_processing;

Mesh to_cgal(const agvd::TriangleMesh& mesh) {
    std::vector<Kernel::Point_3> points;
    points.reserve(mesh.positions.size());
    for (const agvd::Vec3& p : mesh.positions) points.emplace_back(p.x(), p.y(), p.z());
    Mesh made;
    PMP::polygon_soup_to_polygon_mesh(points, mesh.triangles, made);
    return made;
}

}  // namespace

int main(int argc, char** argv) {
    std::string input, output;
    double edge_length = 0;
    unsigned int iterations = 10;
    CLI::App app("Isotropic remeshing by CGAL.", "bench-isotropic");
    app.add_option("IN", input, "Mesh to read")->required();
    app.add_option("OUT", output, "Mesh to write")->required();
    app.add_option("--edge-length", edge_length, "Of the result, mesh units")
        ->required()
        ->check(CLI::PositiveNumber);
    app.add_option("--iterations", iterations, "Rounds of splits, collapses, flips, smoothing")
        ->capture_default_str();
    return cli::run(app, argc, argv, [&] {
        Mesh mesh = to_cgal(remesh::clean_input(remesh::read_mesh(input).mesh).mesh);
        PMP::isotropic_remeshing(faces(mesh), edge_length, mesh,
                                 CGAL::parameters::number_of_iterations(iterations));
        mesh.collect_garbage();
        const auto result = remesh::from_face_graph(mesh, get(CGAL::vertex_point, mesh));
        remesh::write_mesh(output, result.mesh.view());
    });
}
