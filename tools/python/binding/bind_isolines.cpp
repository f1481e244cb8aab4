// Lines of equal distance on arrays.
#include "agvd/paths/isolines.h"

#include <pybind11/stl.h>

#include "binding/arrays.h"
#include "binding/bindings.h"
#include "binding/given_sites.h"
#include "binding/python_progress.h"

namespace python {
namespace {

using agvd::Index;
using agvd::SurfacePoint;

// What the lines are asked for with.
struct Wanted {
    std::vector<double> levels;  // Empty: at every step.
    double step;
    std::optional<double> tolerance;  // None: a share of the diagonal.
};

// Lines as polylines in space.
struct DrawnLines {
    std::vector<agvd::Vec3> points;
    std::vector<Index> offsets;  // #lines + 1.
    std::vector<double> levels;  // #lines.
    std::vector<std::uint8_t> is_closed;
};

double default_tolerance(const agvd::MeshView& mesh) {
    Eigen::AlignedBox3d box;
    for (const agvd::Vec3& p : mesh.positions) box.extend(p);
    return 1e-4 * box.diagonal().norm();
}

// \param propagate  propagate(faces): with relays in these.
template <typename Propagate>
DrawnLines compute(const agvd::Surface& surface, const Propagate& propagate, const Wanted& wanted,
                   const agvd::IsolineOptions& options) {
    const agvd::Propagation distances = propagate(std::vector<Index>());
    const std::vector<double> levels =
        wanted.levels.empty() ? agvd::levels_every(distances, wanted.step) : wanted.levels;
    const agvd::Propagation propagation =
        propagate(agvd::faces_at_levels(surface, distances, levels));
    const agvd::Isolines isolines = agvd::build_isolines(surface, propagation, levels, options);
    const agvd::MeshView mesh = surface.mesh.view();
    agvd::DrawnIsolines drawn = agvd::draw_isolines(
        surface, isolines, wanted.tolerance ? *wanted.tolerance : default_tolerance(mesh));
    DrawnLines lines;
    for (const SurfacePoint& point : drawn.points) lines.points.push_back(position(mesh, point));
    lines.offsets = std::move(drawn.offsets);
    for (const agvd::Isoline& line : isolines.lines) {
        lines.levels.push_back(levels[line.level]);
        lines.is_closed.push_back(line.is_closed ? 1 : 0);
    }
    return lines;
}

py::dict run_isolines(const Doubles& positions, const Indices& triangles, const GivenSites& sites,
                      const cli::SurfaceOptions& as_surface, const std::vector<double>& levels,
                      double step, std::optional<double> tolerance, double max_error,
                      int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    PythonProgress progress(function, {{"clean", 1}, {"propagate", 4}, {"isolines", 1}});
    DrawnLines lines = progress.run([&] {
        const cli::GivenSurface given =
            cli::given_surface(mesh, as_surface, num_threads, progress.of("clean"));
        const agvd::Surface& surface = given.surface();
        const agvd::SurfaceSites on_surface = sites.on(given);
        const auto propagate = [&](std::vector<Index> faces) {
            return GivenSites::propagate_on(surface, on_surface, std::move(faces), max_error,
                                            num_threads, progress.of("propagate"));
        };
        return compute(surface, propagate, {levels, step, tolerance},
                       {.num_threads = num_threads, .progress = progress.of("isolines")});
    });
    py::dict result;
    result["points"] = to_array<double>(std::move(lines.points), 3);
    result["offsets"] = to_numbers(lines.offsets);
    result["levels"] = to_array<double>(std::move(lines.levels));
    result["is_closed"] = to_array<bool>(std::move(lines.is_closed));
    return result;
}

}  // namespace

void bind_isolines(py::module_& module) {
    module.def("isolines", &run_isolines, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("sites"), py::arg("surface"),
               py::arg("levels"), py::arg("step"), py::arg("tolerance"), py::arg("max_error"),
               py::arg("num_threads"), py::arg("progress"));
}

}  // namespace python
