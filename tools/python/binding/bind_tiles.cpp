// Meshes that are larger than memory: files cut into tiles, meshed and joined.
#include <pybind11/stl.h>

#include "binding/arrays.h"
#include "binding/bindings.h"
#include "binding/python_progress.h"
#include "remesh/tilefiles/tile_jobs.h"
#include "shortfalls.h"

namespace python {
namespace {

py::dict to_dict(const remesh::TilePlan& plan) {
    py::dict result;
    result["num_faces"] = plan.num_faces;
    result["area"] = plan.area;
    result["spacing"] = plan.spacing;
    result["vertices"] = plan.num_vertices;
    result["border_vertices"] = plan.num_sites;
    result["warning"] =
        plan.crease_length > 0 ? cli::creases_of_tiles_text(plan.crease_length) : std::string();
    return result;
}

py::dict run_split(const std::string& file, const std::string& folder, agvd::Index num_samples,
                   agvd::Index samples_per_tile, std::uint64_t seed, int relax_steps,
                   int num_threads, const py::object& function) {
    PythonProgress progress(function, {{"split", 1}});
    return to_dict(progress.run([&] {
        return remesh::split_into_tiles(file, folder,
                                        {.num_samples = num_samples,
                                         .samples_per_tile = samples_per_tile,
                                         .seed = seed,
                                         .relax_steps = relax_steps,
                                         .num_threads = num_threads,
                                         .progress = progress.of("split")});
    }));
}

// \return how many were made now, and how many were there.
std::pair<agvd::Index, agvd::Index> run_mesh(const std::string& folder,
                                             const std::vector<agvd::Index>& tiles, int num_threads,
                                             const py::object& function) {
    PythonProgress progress(function, {{"mesh", 1}});
    const remesh::MeshedTiles meshed = progress.run([&] {
        return remesh::mesh_tiles(folder, tiles,
                                  {.num_threads = num_threads, .progress = progress.of("mesh")});
    });
    return {meshed.made, meshed.there};
}

py::tuple run_join(const std::string& folder, int num_threads, const py::object& function) {
    PythonProgress progress(function, {{"join", 1}});
    remesh::JoinedTiles joined = progress.run([&] {
        return remesh::join_tiles(folder,
                                  {.num_threads = num_threads, .progress = progress.of("join")});
    });
    return py::make_tuple(to_array<double>(std::move(joined.mesh.positions), 3),
                          to_array<agvd::Index>(std::move(joined.mesh.triangles), 3));
}

}  // namespace

void bind_tiles(py::module_& module) {
    module.def("split_into_tiles", &run_split, py::arg("file"), py::arg("folder"),
               py::arg("num_samples"), py::arg("samples_per_tile"), py::arg("seed"),
               py::arg("relax_steps"), py::arg("num_threads"), py::arg("progress"));
    module.def(
        "read_tile_plan",
        [](const std::string& folder) { return to_dict(remesh::read_tile_plan(folder)); },
        py::arg("folder"));
    module.def("mesh_tiles", &run_mesh, py::arg("folder"), py::arg("tiles"), py::arg("num_threads"),
               py::arg("progress"));
    module.def("join_tiles", &run_join, py::arg("folder"), py::arg("num_threads"),
               py::arg("progress"));
}

}  // namespace python
