// Distances of points, within a radius, and of the k nearest sites, on arrays.
#include "agvd/paths/distances.h"

#include <pybind11/stl.h>

#include "binding/arrays.h"
#include "binding/bindings.h"
#include "binding/given_sites.h"
#include "binding/python_progress.h"

namespace python {
namespace {

using agvd::Index;
using agvd::SurfacePoint;

// #V: the least distance of the surface's vertices at the place of each vertex of the caller.
std::vector<double> of_given_vertices(const cli::GivenSurface& given,
                                      const agvd::Distances& found) {
    std::vector<double> distances(given.surface().num_vertices(), agvd::infinity);
    for (std::size_t i = 0; i < found.vertices.size(); ++i) {
        distances[found.vertices[i]] = found.vertex_distance[i];
    }
    std::vector<double> result;
    for (const Index place : given.vertices_of_least(distances)) {
        result.push_back(place == agvd::no_index ? agvd::infinity : distances[place]);
    }
    return result;
}

py::array_t<double> run_distances_at(const Doubles& positions, const Indices& triangles,
                                     const GivenSites& sites, const cli::SurfaceOptions& as_surface,
                                     const Indices& target_faces, const Doubles& target_barycentric,
                                     bool has_targets, double radius, double max_error,
                                     int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    std::vector<SurfacePoint> targets;
    if (has_targets) targets = points_of(target_faces, target_barycentric);
    PythonProgress progress(function, {{"clean", 1}, {"propagate", 3}});
    return to_array<double>(progress.run([&] {
        const cli::GivenSurface given =
            cli::given_surface(mesh, as_surface, num_threads, progress.of("clean"));
        const agvd::SurfaceSites on_surface = sites.on(given);
        const agvd::Distances found =
            agvd::find_distances(given.surface(), on_surface.points, given.to_surface(targets),
                                 {.points = on_surface.roles,
                                  .shapes = on_surface.shapes,
                                  .max_distance = radius,
                                  .max_error = max_error,
                                  .num_threads = num_threads,
                                  .progress = progress.of("propagate")});
        return has_targets ? found.point_distance : of_given_vertices(given, found);
    }));
}

// Rows of the caller's vertices.
struct Ranks {
    std::vector<agvd::SiteId> sites;
    std::vector<double> distances;
};

Ranks of_given_vertices(const cli::GivenSurface& given, const agvd::KNearest& found) {
    std::vector<double> first;
    for (std::size_t i = 0; i < found.distance.size(); i += found.k) {
        first.push_back(found.distance[i]);
    }
    Ranks ranks;
    for (const Index place : given.vertices_of_least(first)) {
        for (Index i = 0; i < found.k; ++i) {
            const std::size_t at = std::size_t{place} * found.k + i;
            const bool is_there = place != agvd::no_index;
            ranks.sites.push_back(is_there ? found.site[at] : agvd::SiteId());
            ranks.distances.push_back(is_there ? found.distance[at] : agvd::infinity);
        }
    }
    return ranks;
}

py::tuple run_nearest_sites(const Doubles& positions, const Indices& triangles,
                            const GivenSites& sites, const cli::SurfaceOptions& as_surface, Index k,
                            double max_error, int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    PythonProgress progress(function, {{"clean", 1}, {"propagate", 3}});
    Ranks ranks = progress.run([&] {
        const cli::GivenSurface given =
            cli::given_surface(mesh, as_surface, num_threads, progress.of("clean"));
        const agvd::SurfaceSites on_surface = sites.on(given);
        return of_given_vertices(given,
                                 agvd::k_nearest_sites(given.surface(), on_surface.points, k,
                                                       {.points = on_surface.roles,
                                                        .shapes = on_surface.shapes,
                                                        .max_error = max_error,
                                                        .num_threads = num_threads,
                                                        .progress = progress.of("propagate")}));
    });
    return py::make_tuple(to_numbers(ranks.sites), to_array<double>(std::move(ranks.distances)));
}

}  // namespace

void bind_distances(py::module_& module) {
    module.def("distances_at", &run_distances_at, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("sites"), py::arg("surface"),
               py::arg("target_faces").noconvert(), py::arg("target_barycentric").noconvert(),
               py::arg("has_targets"), py::arg("radius"), py::arg("max_error"),
               py::arg("num_threads"), py::arg("progress"));
    module.def("nearest_sites", &run_nearest_sites, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("sites"), py::arg("surface"), py::arg("k"),
               py::arg("max_error"), py::arg("num_threads"), py::arg("progress"));
}

}  // namespace python
