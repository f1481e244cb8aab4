// Geodesic Voronoi diagrams and distances on arrays.
#include <pybind11/stl.h>

#include <algorithm>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "binding/arrays.h"
#include "binding/bindings.h"
#include "binding/given_sites.h"
#include "binding/python_progress.h"
#include "choices.h"
#include "compared_files.h"
#include "remesh/meshfile/diagram_file.h"

namespace python {
namespace {

using agvd::Index;

agvd::PropagationOptions propagation_options(const GivenSites& sites, const std::string& engine,
                                             std::optional<double> max_error, int num_threads) {
    return {.points = sites.roles,
            .engine = cli::engine_of(engine),
            .max_error = max_error,
            .num_threads = num_threads};
}

// Points, then lines, then regions. Without groups each is a site; groups and weights of the points
// only leave lines and regions behind them, at 0.
GivenSites make_sites(const Indices& faces, const Doubles& barycentric, const Indices& groups,
                      const Doubles& weights, const std::vector<Indices>& lines,
                      const std::vector<Indices>& regions) {
    GivenSites sites{{points_of(faces, barycentric), {}},
                     {.site = vector_of(groups), .start = vector_of(weights)}};
    const std::size_t num_points = sites.on_mesh.points.size();
    auto first = static_cast<Index>(num_points);
    std::vector<Index>& site = sites.roles.site;
    if (!site.empty()) first = *std::max_element(site.begin(), site.end()) + 1;
    sites.on_mesh.shapes = shapes_of(lines, regions, first);
    std::vector<double>& start = sites.roles.start;
    for (std::size_t i = 0; i < sites.on_mesh.shapes.size(); ++i) {
        const std::size_t part = num_points + i;
        if (part < site.size()) sites.on_mesh.shapes[i].site = site[part];
        if (part < start.size()) sites.on_mesh.shapes[i].start = start[part];
    }
    if (site.size() > num_points) site.resize(num_points);
    if (start.size() > num_points) start.resize(num_points);
    return sites;
}

cli::SurfaceOptions make_surface(bool keep_slits, const Indices& barriers,
                                 const Doubles& side_lengths) {
    return {keep_slits, edges_of(barriers), vector_of(side_lengths)};
}

py::array_t<std::int64_t> sides_of(const std::vector<agvd::VoronoiEdge>& edges) {
    std::vector<std::array<std::int64_t, 2>> sides;
    sides.reserve(edges.size());
    const auto number = [](agvd::SiteId site) {
        return site.is_valid() ? std::int64_t{site.value()} : -1;
    };
    for (const agvd::VoronoiEdge& edge : edges) {
        sides.push_back({number(edge.left), number(edge.right)});
    }
    return to_array<std::int64_t>(std::move(sides), 2);
}

py::dict to_dict(cli::DrawnArcs arcs) {
    std::vector<std::int64_t> kinds;
    for (const agvd::ArcKind kind : arcs.kinds) kinds.push_back(static_cast<std::int64_t>(kind));
    std::vector<std::array<std::int64_t, 2>> spans;
    for (const auto& [begin, end] : arcs.spans) spans.push_back({begin, end});
    py::dict result;
    result["line"] = to_numbers(arcs.lines);
    result["span"] = to_array<std::int64_t>(std::move(spans), 2);
    result["kind"] = to_array<std::int64_t>(std::move(kinds));
    result["focus_left"] = to_array<double>(std::move(arcs.foci[0]), 3);
    result["weight_left"] = to_array<double>(std::move(arcs.weights[0]));
    result["focus_right"] = to_array<double>(std::move(arcs.foci[1]), 3);
    result["weight_right"] = to_array<double>(std::move(arcs.weights[1]));
    return result;
}

py::dict run_voronoi(const Doubles& positions, const Indices& triangles, const GivenSites& sites,
                     const cli::SurfaceOptions& as_surface, const std::string& engine,
                     std::optional<double> max_error, std::optional<double> chord,
                     const std::string& file, int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    const agvd::PropagationOptions options =
        propagation_options(sites, engine, max_error, num_threads);
    PythonProgress progress(function,
                            {{"clean", 1}, {"propagate", 1}, {"diagram", 1}, {"dual", 1}});
    cli::DiagramReader write;
    if (!file.empty()) {
        remesh::check_diagram_extension(file);
        write = [&](const agvd::Surface& surface, std::span<const agvd::SurfacePoint> points,
                    const agvd::Diagram& diagram, const agvd::PropagationOptions& propagated) {
            remesh::write_diagram(file, surface, points, diagram, progress.of("dual"),
                                  propagated.points, propagated.shapes);
        };
    }
    cli::DrawnDiagram drawn = progress.run([&] {
        return cli::draw_diagram(
            mesh, sites.on_mesh, options, as_surface,
            [&](const char* stage) { return progress.of(stage); }, chord, write);
    });
    py::dict result;
    result["labels"] = to_numbers(drawn.labels);
    result["distances"] = to_array<double>(std::move(drawn.distances));
    result["site_positions"] = to_array<double>(std::move(drawn.site_positions), 3);
    result["cell_area"] = to_array<double>(std::move(drawn.diagram.cell_area));
    result["cell_euler"] = to_array<int>(std::move(drawn.diagram.cell_euler));
    result["neighbour_offsets"] = to_numbers(drawn.cells.neighbour_offsets);
    result["neighbours"] = to_numbers(drawn.cells.neighbours);
    result["points"] = to_array<double>(std::move(drawn.lines.points), 3);
    result["point_distances"] = to_array<double>(std::move(drawn.lines.distances));
    result["line_offsets"] = to_numbers(drawn.lines.offsets);
    result["line_sites"] = sides_of(drawn.diagram.edges);
    result["dual"] = to_array<Index>(std::move(drawn.dual), 3);
    result["certified_error"] = drawn.certified_error;
    if (chord) result["arcs"] = to_dict(std::move(drawn.arcs));
    return result;
}

py::array_t<double> run_distances(const Doubles& positions, const Indices& triangles,
                                  const GivenSites& sites, const cli::SurfaceOptions& as_surface,
                                  const std::string& engine, std::optional<double> max_error,
                                  int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    const agvd::PropagationOptions options =
        propagation_options(sites, engine, max_error, num_threads);
    PythonProgress progress(function, {{"clean", 1}, {"propagate", 1}});
    return to_array<double>(progress.run([&] {
        return cli::vertex_distances(mesh, sites.on_mesh, options, as_surface,
                                     [&](const char* stage) { return progress.of(stage); });
    }));
}

py::tuple run_cut_cells(const Doubles& positions, const Indices& triangles, const GivenSites& sites,
                        const cli::SurfaceOptions& as_surface, const std::string& engine,
                        std::optional<double> max_error, int num_threads,
                        const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    const agvd::PropagationOptions options =
        propagation_options(sites, engine, max_error, num_threads);
    PythonProgress progress(function, {{"clean", 1}, {"propagate", 1}, {"diagram", 2}});
    agvd::CutCells cells = progress.run([&] {
        return cli::cut_cells(mesh, sites.on_mesh, options, as_surface,
                              [&](const char* stage) { return progress.of(stage); });
    });
    return py::make_tuple(to_array<double>(std::move(cells.mesh.positions), 3),
                          to_array<Index>(std::move(cells.mesh.triangles), 3),
                          to_numbers(cells.face_site), to_numbers(cells.face_origin));
}

// \return the report as JSON.
std::string run_compare(const std::string& a, const std::string& b, double spacing, Index samples,
                        Index points, int num_threads, const py::object& function) {
    const cli::ComparedFiles files{
        .a = a, .b = b, .options = {.spacing = spacing, .area_samples = samples}, .points = points};
    PythonProgress progress(
        function, {{"read", 1}, {"clean", 1}, {"propagate", 1}, {"diagram", 1}, {"compare", 8}});
    return progress.run([&] {
        const remesh::Comparison found = cli::compare_files(
            files, num_threads, [&](const char* stage) { return progress.of(stage); });
        return to_json(found, {.version = REMESH_VERSION, .a = a, .b = b});
    });
}

}  // namespace

void bind_diagram(py::module_& module) {
    py::class_<GivenSites>(module, "GivenSites")
        .def(py::init(&make_sites), py::arg("faces").noconvert(),
             py::arg("barycentric").noconvert(), py::arg("groups").noconvert(),
             py::arg("weights").noconvert(), py::arg("lines"), py::arg("regions"));
    py::class_<cli::SurfaceOptions>(module, "SurfaceOptions")
        .def(py::init(&make_surface), py::arg("keep_slits"), py::arg("barriers").noconvert(),
             py::arg("side_lengths").noconvert());
    module.def("voronoi", &run_voronoi, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("sites"), py::arg("surface"),
               py::arg("engine"), py::arg("max_error"), py::arg("chord"), py::arg("file"),
               py::arg("num_threads"), py::arg("progress"));
    module.def("compare", &run_compare, py::arg("a"), py::arg("b"), py::arg("spacing"),
               py::arg("samples"), py::arg("points"), py::arg("num_threads"), py::arg("progress"));
    module.def("cut_cells", &run_cut_cells, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("sites"), py::arg("surface"),
               py::arg("engine"), py::arg("max_error"), py::arg("num_threads"),
               py::arg("progress"));
    module.def("geodesic_distance", &run_distances, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("sites"), py::arg("surface"),
               py::arg("engine"), py::arg("max_error"), py::arg("num_threads"),
               py::arg("progress"));
}

}  // namespace python
