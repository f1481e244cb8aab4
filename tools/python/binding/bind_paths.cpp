// Shortest paths on arrays.
#include "agvd/paths/geodesic_path.h"
#include "agvd/propagation/propagate.h"
#include "binding/arrays.h"
#include "binding/bindings.h"
#include "binding/given_sites.h"
#include "binding/python_progress.h"

namespace python {
namespace {

using agvd::Index;
using agvd::SurfacePoint;

// Paths as polylines in space.
struct DrawnPaths {
    std::vector<agvd::Vec3> points;
    std::vector<Index> offsets{0};  // #paths + 1.
    std::vector<double> lengths;
    std::vector<agvd::SiteId> sites;  // Of paths to sites.

    void add(const agvd::MeshView& mesh, const agvd::GeodesicPath& path) {
        for (const SurfacePoint& point : path.points) points.push_back(position(mesh, point));
        offsets.push_back(static_cast<Index>(points.size()));
        lengths.push_back(path.points.empty() ? agvd::infinity : path.length);
    }
};

py::dict to_dict(DrawnPaths drawn) {
    py::dict result;
    result["points"] = to_array<double>(std::move(drawn.points), 3);
    result["offsets"] = to_numbers(drawn.offsets);
    result["lengths"] = to_array<double>(std::move(drawn.lengths));
    result["sites"] = to_numbers(drawn.sites);
    return result;
}

py::dict run_paths_to_sites(const Doubles& positions, const Indices& triangles,
                            const Indices& faces, const Doubles& barycentric,
                            const GivenSites& sites, const cli::SurfaceOptions& as_surface,
                            double max_error, int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    const std::vector<SurfacePoint> starts = points_of(faces, barycentric);
    PythonProgress progress(function, {{"clean", 1}, {"propagate", 4}, {"paths", 1}});
    return to_dict(progress.run([&] {
        const cli::GivenSurface given =
            cli::given_surface(mesh, as_surface, num_threads, progress.of("clean"));
        const agvd::Surface& surface = given.surface();
        const agvd::SurfaceSites on_surface = sites.on(given);
        const agvd::Propagation propagation =
            GivenSites::propagate_on(surface, on_surface, agvd::all_faces(surface), max_error,
                                     num_threads, progress.of("propagate"));
        DrawnPaths drawn;
        for (const agvd::SitePath& path :
             agvd::paths_to_sites(surface, on_surface.points, propagation, given.to_surface(starts),
                                  {.num_threads = num_threads, .progress = progress.of("paths")})) {
            drawn.add(surface.mesh.view(), path.path);
            drawn.sites.push_back(path.site);
        }
        return drawn;
    }));
}

py::dict run_paths_between(const Doubles& positions, const Indices& triangles, const Indices& faces,
                           const Doubles& barycentric, const Indices& end_faces,
                           const Doubles& end_barycentric, const cli::SurfaceOptions& as_surface,
                           double max_error, int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    const std::vector<SurfacePoint> starts = points_of(faces, barycentric);
    const std::vector<SurfacePoint> ends = points_of(end_faces, end_barycentric);
    PythonProgress progress(function, {{"clean", 1}, {"paths", 5}});
    return to_dict(progress.run([&] {
        const cli::GivenSurface given =
            cli::given_surface(mesh, as_surface, num_threads, progress.of("clean"));
        const std::vector<SurfacePoint> from = given.to_surface(starts);
        const std::vector<SurfacePoint> to = given.to_surface(ends);
        std::vector<agvd::PointPair> pairs;
        for (std::size_t i = 0; i < from.size(); ++i) pairs.push_back({from[i], to[i]});
        DrawnPaths drawn;
        for (const agvd::GeodesicPath& path :
             agvd::shortest_paths(given.surface(), pairs,
                                  {.max_error = max_error,
                                  .num_threads = num_threads,
                                  .progress = progress.of("paths")})) {
            drawn.add(given.surface().mesh.view(), path);
        }
        return drawn;
    }));
}

}  // namespace

void bind_paths(py::module_& module) {
    module.def("paths_to_sites", &run_paths_to_sites, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("faces").noconvert(),
               py::arg("barycentric").noconvert(), py::arg("sites"), py::arg("surface"),
               py::arg("max_error"), py::arg("num_threads"), py::arg("progress"));
    module.def("paths_between", &run_paths_between, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("faces").noconvert(),
               py::arg("barycentric").noconvert(), py::arg("end_faces").noconvert(),
               py::arg("end_barycentric").noconvert(), py::arg("surface"), py::arg("max_error"),
               py::arg("num_threads"), py::arg("progress"));
}

}  // namespace python
