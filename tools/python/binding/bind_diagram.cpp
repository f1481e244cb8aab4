// Geodesic Voronoi diagrams and distances on arrays.
#include <pybind11/stl.h>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "based_diagram.h"
#include "binding/arrays.h"
#include "binding/bindings.h"
#include "binding/given_surface.h"
#include "binding/option_names.h"
#include "diagram_lines.h"
#include "remesh/dual/build_dual.h"

namespace python {
namespace {

using agvd::Index;

agvd::PropagationOptions propagation_options(const std::string& engine,
                                             std::optional<double> max_error, int num_threads) {
    return {.engine = engine_of(engine), .max_error = max_error, .num_threads = num_threads};
}

// Values of the surface's vertices for those of the caller.
template <typename Value>
std::vector<Value> carry(const std::vector<Index>& places, const std::vector<Value>& values,
                         Value none) {
    std::vector<Value> result;
    result.reserve(places.size());
    for (const Index place : places) {
        result.push_back(place == agvd::no_index ? none : values[place]);
    }
    return result;
}

// The edges of a diagram as polylines in space: closed ones end with their first point.
struct Polylines {
    std::vector<agvd::Vec3> points;
    std::vector<double> distances;
    std::vector<Index> offsets;  // #edges + 1.
};

Polylines draw(const agvd::Diagram& diagram, const agvd::MeshView& mesh) {
    Polylines lines;
    lines.offsets.push_back(0);
    const auto add = [&](Index point) {
        lines.points.push_back(agvd::position(mesh, diagram.points[point]));
        lines.distances.push_back(diagram.point_distance[point]);
    };
    for (std::size_t e = 0; e < diagram.edges.size(); ++e) {
        const Index begin = diagram.edge_points[e], end = diagram.edge_points[e + 1];
        for (Index point = begin; point < end; ++point) add(point);
        if (diagram.edges[e].tail == agvd::no_index && begin < end) add(begin);
        lines.offsets.push_back(static_cast<Index>(lines.points.size()));
    }
    return lines;
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

// What a diagram is computed to: on the surface, and for the caller's vertices.
struct DrawnDiagram {
    agvd::Diagram diagram;
    double certified_error = 0;
    agvd::Cells cells;
    std::vector<agvd::Triangle> dual;
    Polylines lines;
    remesh::Lines arcs;  // Empty unless they are asked for.
    std::vector<agvd::Vec3> site_positions;
    std::vector<agvd::SiteId> labels;
    std::vector<double> distances;
};

DrawnDiagram compute(const agvd::MeshView& mesh, const std::vector<agvd::SurfacePoint>& given_sites,
                     const agvd::PropagationOptions& options, const agvd::DiagramOptions& drawing,
                     bool keep_slits, PythonProgress& progress) {
    const GivenSurface given(mesh, {.keep_slits = keep_slits, .num_threads = options.num_threads},
                             progress);
    const agvd::Surface& surface = given.surface();
    const std::vector<agvd::SurfacePoint> sites = given.to_surface(given_sites);
    cli::BasedDiagram based = cli::based_diagram(
        surface, sites, options, drawing, [&](const char* stage) { return progress.of(stage); });
    DrawnDiagram drawn;
    drawn.diagram = std::move(based.diagram);
    drawn.certified_error = based.certified_error;
    drawn.cells = agvd::build_cells(drawn.diagram);
    drawn.dual = remesh::build_dual(surface, drawn.diagram, progress.of("dual"));
    drawn.lines = draw(drawn.diagram, surface.mesh.view());
    if (drawing.with_arcs) drawn.arcs = cli::arc_lines(surface, drawn.diagram);
    for (const agvd::SurfacePoint& site : sites) {
        drawn.site_positions.push_back(agvd::position(surface.mesh.view(), site));
    }
    const std::vector<Index> places = given.vertices_of_least(drawn.diagram.nearest_distance);
    drawn.labels = carry(places, drawn.diagram.nearest_site, agvd::SiteId());
    drawn.distances = carry(places, drawn.diagram.nearest_distance, agvd::infinity);
    return drawn;
}

// The arcs' polylines and values.
py::dict to_dict(remesh::Lines lines) {
    py::dict result;
    result["points"] = to_array<double>(std::move(lines.points), 3);
    result["offsets"] = to_numbers(lines.offsets);
    for (remesh::Attribute& value : lines.of_lines) {
        result[value.name.c_str()] = to_array<double>(std::move(value.values));
    }
    return result;
}

py::dict run_voronoi(const Doubles& positions, const Indices& triangles, const Indices& faces,
                     const Doubles& barycentric, const std::string& engine,
                     std::optional<double> max_error, std::optional<double> tolerance, bool arcs,
                     bool keep_slits, int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    const agvd::DiagramOptions drawing{.with_arcs = arcs || tolerance,
                                       .tolerance = tolerance.value_or(agvd::infinity)};
    const agvd::PropagationOptions options = propagation_options(engine, max_error, num_threads);
    const std::vector<agvd::SurfacePoint> sites = points_of(faces, barycentric);
    PythonProgress progress(function,
                            {{"clean", 1}, {"propagate", 1}, {"diagram", 1}, {"dual", 1}});
    DrawnDiagram drawn =
        progress.run([&] { return compute(mesh, sites, options, drawing, keep_slits, progress); });
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
    if (arcs) result["arcs"] = to_dict(std::move(drawn.arcs));
    return result;
}

py::array_t<double> run_distances(const Doubles& positions, const Indices& triangles,
                                  const Indices& faces, const Doubles& barycentric,
                                  const std::string& engine, std::optional<double> max_error,
                                  bool keep_slits, int num_threads, const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    agvd::PropagationOptions options = propagation_options(engine, max_error, num_threads);
    const std::vector<agvd::SurfacePoint> given_sites = points_of(faces, barycentric);
    PythonProgress progress(function, {{"clean", 1}, {"propagate", 1}});
    options.progress = progress.of("propagate");
    return to_array<double>(progress.run([&] {
        const GivenSurface given(mesh, {.keep_slits = keep_slits, .num_threads = num_threads},
                                 progress);
        const std::vector<agvd::SurfacePoint> sites = given.to_surface(given_sites);
        const agvd::IntrinsicTriangulation base =
            cli::base_for(given.surface(), sites.size(), progress.of("clean"));
        const agvd::Propagation propagation =
            agvd::propagate(base.surface(), base.to_intrinsic(sites), options);
        // The base's vertices begin with those of the surface.
        return carry(given.vertices_of_least(propagation.vertex_distance),
                     propagation.vertex_distance, agvd::infinity);
    }));
}

}  // namespace

void bind_diagram(py::module_& module) {
    module.def("voronoi", &run_voronoi, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("faces").noconvert(),
               py::arg("barycentric").noconvert(), py::arg("engine"), py::arg("max_error"),
               py::arg("tolerance"), py::arg("arcs"), py::arg("keep_slits"), py::arg("num_threads"),
               py::arg("progress"));
    module.def("geodesic_distance", &run_distances, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("faces").noconvert(),
               py::arg("barycentric").noconvert(), py::arg("engine"), py::arg("max_error"),
               py::arg("keep_slits"), py::arg("num_threads"), py::arg("progress"));
}

}  // namespace python
