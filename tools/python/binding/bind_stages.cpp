// Stages of remesh() one by one: cleaning, sampling, relaxation.
#include <pybind11/stl.h>

#include "agvd/mesh/closest_point.h"
#include "binding/arrays.h"
#include "binding/bindings.h"
#include "binding/python_progress.h"
#include "choices.h"
#include "given_surface.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/sites.h"
#include "report/report_common.h"

namespace python {
namespace {

// \return positions, triangles, the vertices and the faces that they come from, counts by name.
py::tuple run_clean(const Doubles& positions, const Indices& triangles, bool keep_slits,
                    int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    PythonProgress progress(function, {{"clean", 1}});
    remesh::CleanResult clean = progress.run([&] {
        return remesh::clean_input(mesh, {.keep_slits = keep_slits,
                                          .num_threads = num_threads,
                                          .progress = progress.of("clean")});
    });
    py::dict counts;
    for (const auto& row : remesh::detail::repair_rows) counts[row.key] = clean.counts.*row.count;
    return py::make_tuple(to_array<double>(std::move(clean.mesh.positions), 3),
                          to_array<agvd::Index>(std::move(clean.mesh.triangles), 3),
                          to_numbers(clean.vertex_origin), to_numbers(clean.face_origin), counts);
}

py::tuple run_sample(const Doubles& positions, const Indices& triangles, agvd::Index num_samples,
                     const std::string& init, const std::string& boundary, std::uint64_t seed,
                     int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    PythonProgress progress(function, {{"clean", 1}, {"sample", 1}});
    const remesh::SamplingOptions options{.num_samples = num_samples,
                                          .init = cli::init_of(init),
                                          .boundary = cli::boundary_of(boundary),
                                          .seed = seed,
                                          .num_threads = num_threads,
                                          .progress = progress.of("sample")};
    return to_arrays(progress.run([&] {
        const cli::GivenSurface given(
            mesh, {.num_threads = num_threads, .progress = progress.of("clean")});
        return given.to_given(remesh::sample_sites(given.surface(), options));
    }));
}

// The caller's rule on when to stop, called with the energies so far. What it raises ends the call.
class StoppingRule {
public:
    explicit StoppingRule(py::object function) : function_(std::move(function)) {}

    [[nodiscard]] std::function<bool(const remesh::RelaxLevel&)> goes_on() {
        if (function_.is_none()) return {};
        return [this](const remesh::RelaxLevel& level) {
            const py::gil_scoped_acquire acquire;
            const int stops = PyObject_IsTrue(function_(py::cast(level.energy)).ptr());
            if (stops < 0) throw py::error_already_set();
            return stops == 0;
        };
    }

private:
    py::object function_;
};

// \return faces and coordinates of the sites, the energies.
py::tuple run_relax(const Doubles& positions, const Indices& triangles, const Indices& faces,
                    const Doubles& barycentric, int steps, double tolerance,
                    std::vector<std::uint8_t> is_fixed, const std::string& boundary,
                    const py::object& stop, int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    const std::vector<agvd::SurfacePoint> sites = points_of(faces, barycentric);
    PythonProgress progress(function, {{"clean", 1}, {"relax", 9}});
    StoppingRule rule(stop);
    const remesh::RelaxOptions options{.steps = steps,
                                       .tolerance = tolerance,
                                       .goes_on = rule.goes_on(),
                                       .is_fixed = std::move(is_fixed),
                                       .boundary = cli::boundary_of(boundary),
                                       .num_threads = num_threads,
                                       .progress = progress.of("relax")};
    std::vector<double> energies;
    const py::tuple places = to_arrays(progress.run([&] {
        const cli::GivenSurface given(
            mesh, {.num_threads = num_threads, .progress = progress.of("clean")});
        const remesh::PreparedSurface prepared(given.surface(),
                                               remesh::mean_spacing(given.surface(), sites.size()),
                                               num_threads, progress.of("relax"));
        remesh::RelaxResult relaxed =
            remesh::relax_sites(prepared, given.to_surface(sites), options);
        if (!relaxed.levels.empty()) energies = std::move(relaxed.levels.back().energy);
        return given.to_given(relaxed.sites);
    }));
    return py::make_tuple(places[0], places[1], to_array<double>(std::move(energies)));
}

py::tuple run_nearest(const Doubles& positions, const Indices& triangles, const Doubles& points,
                      const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    const agvd::MeshView queries = view_of(points, Indices(std::vector<py::ssize_t>{0, 3}));
    PythonProgress progress(function, {{"sample", 1}});
    return to_arrays(progress.run([&] {
        const agvd::ClosestPointTree tree(mesh, progress.of("sample"));
        std::vector<agvd::SurfacePoint> nearest;
        nearest.reserve(queries.positions.size());
        for (const agvd::Vec3& point : queries.positions) {
            nearest.push_back(tree.query(point).point);
        }
        return nearest;
    }));
}

}  // namespace

void bind_stages(py::module_& module) {
    module.def("clean", &run_clean, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("keep_slits"), py::arg("num_threads"),
               py::arg("progress"));
    module.def("sample_sites", &run_sample, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("num_samples"), py::arg("init"),
               py::arg("boundary"), py::arg("seed"), py::arg("num_threads"), py::arg("progress"));
    module.def("relax_sites", &run_relax, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("faces").noconvert(),
               py::arg("barycentric").noconvert(), py::arg("steps"), py::arg("tolerance"),
               py::arg("is_fixed"), py::arg("boundary"), py::arg("stop"), py::arg("num_threads"),
               py::arg("progress"));
    module.def("nearest_points", &run_nearest, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("points").noconvert(),
               py::arg("progress"));
}

}  // namespace python
