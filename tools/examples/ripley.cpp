// example-ripley: Ripley's K of points on a surface, by distances along the surface ([ripley1976]).
// K(r) is the area times the share of pairs that are no farther apart than r. That of uniform,
// independent points is the mean area of a disc of radius r around a point, which on a sphere is
// 2 pi R^2 (1 - cos(r / R)) ([robeson2014]). Clusters have more; points that keep apart have less.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "agvd/agvd.h"
#include "examples/example.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/mesh_file.h"

namespace {

using agvd::Index;

constexpr const char* usage =
    "usage: example-ripley MESH POINTS STEP COUNT\n"
    "Prints K(r) of the points for r = STEP, 2 STEP, ... COUNT STEP, and the mean area of a disc "
    "of\n"
    "that radius around one of them: K of uniform points.\n"
    "  POINTS  a point on each line: `v VERTEX`, `f FACE B0 B1 B2` or `p X Y Z`\n";

// A third of the faces around each vertex.
std::vector<double> vertex_areas(const agvd::Surface& surface) {
    std::vector<double> areas(surface.num_vertices(), 0.0);
    for (Index h = 0; h < 3 * surface.num_faces(); ++h) {
        areas[surface.tail(h)] += agvd::face_area(surface, agvd::Surface::face(h)) / 3;
    }
    return areas;
}

void print_k(const example::Arguments& arguments) {
    const agvd::Surface surface = agvd::build_surface(remesh::read_mesh(arguments[0]).mesh.view());
    const auto points =
        remesh::read_sites(arguments[1], surface.mesh.view(), {}, remesh::Repeats::Allowed).sites;
    const double step = example::number(arguments[2], "STEP", 1e-9);
    const auto count = static_cast<std::size_t>(example::number(arguments[3], "COUNT", 1, 1e6));
    if (points.size() < 2) throw agvd::InvalidInput(arguments[1] + ": add a second point");

    const std::vector<double> areas = vertex_areas(surface);
    std::vector<double> pairs(count, 0.0), discs(count, 0.0);  // By the first radius that holds it.
    const auto add = [&](std::vector<double>& to, double distance, double value) {
        const double ring = std::max(0.0, std::ceil(distance / step) - 1);
        if (ring < static_cast<double>(count)) to[static_cast<std::size_t>(ring)] += value;
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        const agvd::Distances near =
            agvd::find_distances(surface, std::span(points).subspan(i, 1), points,
                                 {.max_distance = step * static_cast<double>(count)});
        for (std::size_t j = 0; j < points.size(); ++j) {
            if (j != i) add(pairs, near.point_distance[j], 1);
        }
        for (std::size_t k = 0; k < near.vertices.size(); ++k) {
            add(discs, near.vertex_distance[k], areas[near.vertices[k]]);
        }
    }
    const auto n = static_cast<double>(points.size());
    const double area = agvd::surface_area(surface);
    double num_pairs = 0, disc = 0;
    std::printf("%12s %12s %12s\n", "r", "K", "uniform");
    for (std::size_t k = 0; k < count; ++k) {
        num_pairs += pairs[k];
        disc += discs[k] / n;
        std::printf("%12g %12.6g %12.6g\n", step * static_cast<double>(k + 1),
                    area * num_pairs / (n * (n - 1)), disc);
    }
}

}  // namespace

int main(int argc, char** argv) { return example::run(argc, argv, usage, 4, 4, print_k); }
