// Geodesic Voronoi diagrams and distances on arrays.
#include <pybind11/stl.h>

#include <algorithm>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "binding/arrays.h"
#include "binding/bindings.h"
#include "binding/python_progress.h"
#include "choices.h"
#include "drawn_diagram.h"

namespace python {
namespace {

using agvd::Index;

agvd::PropagationOptions propagation_options(const Indices& groups, const Doubles& weights,
                                             const std::string& engine,
                                             std::optional<double> max_error, int num_threads) {
    return {.points = {.site = vector_of(groups), .start = vector_of(weights)},
            .engine = cli::engine_of(engine),
            .max_error = max_error,
            .num_threads = num_threads};
}

// Points, then lines, then regions; with groups lines and regions come behind these.
cli::DrawnSites sites_of(const Indices& faces, const Doubles& barycentric, const Indices& groups,
                         const std::vector<Indices>& lines, const std::vector<Indices>& regions) {
    cli::DrawnSites sites{points_of(faces, barycentric), {}};
    auto first = static_cast<Index>(sites.points.size());
    if (groups.size() > 0) {
        first = *std::max_element(groups.data(), groups.data() + groups.size()) + 1;
    }
    sites.shapes = shapes_of(lines, regions, first);
    return sites;
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

py::dict run_voronoi(const Doubles& positions, const Indices& triangles, const Indices& faces,
                     const Doubles& barycentric, const Indices& groups, const Doubles& weights,
                     const std::vector<Indices>& lines, const std::vector<Indices>& regions,
                     const Indices& barriers, const Doubles& side_lengths,
                     const std::string& engine, std::optional<double> max_error,
                     std::optional<double> chord, bool keep_slits, int num_threads,
                     const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    const agvd::PropagationOptions options =
        propagation_options(groups, weights, engine, max_error, num_threads);
    const cli::DrawnSites sites = sites_of(faces, barycentric, groups, lines, regions);
    const cli::SurfaceOptions as_surface{keep_slits, edges_of(barriers), vector_of(side_lengths)};
    PythonProgress progress(function,
                            {{"clean", 1}, {"propagate", 1}, {"diagram", 1}, {"dual", 1}});
    cli::DrawnDiagram drawn = progress.run([&] {
        return cli::draw_diagram(
            mesh, sites, options, as_surface, [&](const char* stage) { return progress.of(stage); },
            chord);
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
                                  const Indices& faces, const Doubles& barycentric,
                                  const Doubles& weights, const std::vector<Indices>& lines,
                                  const std::vector<Indices>& regions, const Indices& barriers,
                                  const Doubles& side_lengths, const std::string& engine,
                                  std::optional<double> max_error, bool keep_slits, int num_threads,
                                  const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    const agvd::PropagationOptions options =
        propagation_options({}, weights, engine, max_error, num_threads);
    const cli::DrawnSites sites = sites_of(faces, barycentric, {}, lines, regions);
    const cli::SurfaceOptions as_surface{keep_slits, edges_of(barriers), vector_of(side_lengths)};
    PythonProgress progress(function, {{"clean", 1}, {"propagate", 1}});
    return to_array<double>(progress.run([&] {
        return cli::vertex_distances(mesh, sites, options, as_surface,
                                     [&](const char* stage) { return progress.of(stage); });
    }));
}

py::tuple run_cut_cells(const Doubles& positions, const Indices& triangles, const Indices& faces,
                        const Doubles& barycentric, const Indices& groups, const Doubles& weights,
                        const std::vector<Indices>& lines, const std::vector<Indices>& regions,
                        const Indices& barriers, const Doubles& side_lengths,
                        const std::string& engine, std::optional<double> max_error, bool keep_slits,
                        int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    const agvd::PropagationOptions options =
        propagation_options(groups, weights, engine, max_error, num_threads);
    const cli::DrawnSites sites = sites_of(faces, barycentric, groups, lines, regions);
    const cli::SurfaceOptions as_surface{keep_slits, edges_of(barriers), vector_of(side_lengths)};
    PythonProgress progress(function, {{"clean", 1}, {"propagate", 1}, {"diagram", 2}});
    agvd::CutCells cells = progress.run([&] {
        return cli::cut_cells(mesh, sites, options, as_surface,
                              [&](const char* stage) { return progress.of(stage); });
    });
    return py::make_tuple(to_array<double>(std::move(cells.mesh.positions), 3),
                          to_array<Index>(std::move(cells.mesh.triangles), 3),
                          to_numbers(cells.face_site), to_numbers(cells.face_origin));
}

}  // namespace

void bind_diagram(py::module_& module) {
    module.def("voronoi", &run_voronoi, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("faces").noconvert(),
               py::arg("barycentric").noconvert(), py::arg("groups").noconvert(),
               py::arg("weights").noconvert(), py::arg("lines"), py::arg("regions"),
               py::arg("barriers").noconvert(), py::arg("side_lengths").noconvert(),
               py::arg("engine"), py::arg("max_error"), py::arg("chord"), py::arg("keep_slits"),
               py::arg("num_threads"), py::arg("progress"));
    module.def("cut_cells", &run_cut_cells, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("faces").noconvert(),
               py::arg("barycentric").noconvert(), py::arg("groups").noconvert(),
               py::arg("weights").noconvert(), py::arg("lines"), py::arg("regions"),
               py::arg("barriers").noconvert(), py::arg("side_lengths").noconvert(),
               py::arg("engine"), py::arg("max_error"), py::arg("keep_slits"),
               py::arg("num_threads"), py::arg("progress"));
    module.def("geodesic_distance", &run_distances, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("faces").noconvert(),
               py::arg("barycentric").noconvert(), py::arg("weights").noconvert(), py::arg("lines"),
               py::arg("regions"), py::arg("barriers").noconvert(),
               py::arg("side_lengths").noconvert(), py::arg("engine"), py::arg("max_error"),
               py::arg("keep_slits"), py::arg("num_threads"), py::arg("progress"));
}

}  // namespace python
