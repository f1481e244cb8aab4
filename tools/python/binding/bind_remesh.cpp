// RemeshOptions as a class of properties, and remesh() on arrays.
#include <pybind11/stl.h>

#include "binding/arrays.h"
#include "binding/bindings.h"
#include "binding/python_progress.h"
#include "binding/python_terms.h"
#include "choices.h"
#include "expected_stages.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/transfer/transfer.h"
#include "report/report.h"
#include "shortfalls.h"

namespace python {
namespace {

using remesh::RemeshOptions;
using remesh::Sizing;
using OptionsClass = py::class_<RemeshOptions>;

const char* vertex_count_name(remesh::VertexCount count) {
    return count == remesh::VertexCount::Add ? "add" : "exact";
}

// Adds a property that takes the name of a choice.
template <typename Choice>
void add_choice(OptionsClass& options, const char* name, Choice RemeshOptions::*field,
                const std::vector<Choice>& choices, const char* (*name_of)(Choice)) {
    options.def_property(
        name, [=](const RemeshOptions& self) { return std::string(name_of(self.*field)); },
        [=](RemeshOptions& self, const std::string& value) {
            self.*field = cli::choose(name, value, choices, name_of);
        });
}

// Adds a property for a field of sizing.
template <typename Value>
void add_sizing(OptionsClass& options, const char* name, Value Sizing::*field) {
    options.def_property(
        name, [=](const RemeshOptions& self) { return self.sizing.*field; },
        [=](RemeshOptions& self, Value value) { self.sizing.*field = std::move(value); });
}

// Adds a property for a bound of all triangles.
void add_bound(OptionsClass& options, const char* name, double remesh::ShapeBounds::*bound) {
    options.def_property(
        name, [=](const RemeshOptions& self) { return self.bounds.*bound; },
        [=](RemeshOptions& self, double value) { self.bounds.*bound = value; });
}

// Adds a method that sets what gives the number of vertices.
template <typename Value, typename Count>
void add_count(OptionsClass& options, const char* name, Count (*count_of)(Value)) {
    options.def(name,
                [=](RemeshOptions& self, Value value) { self.sizing.count = count_of(value); });
}

void add_choices(OptionsClass& options) {
    using remesh::Boundary;
    using remesh::Delaunay;
    using remesh::Features;
    using remesh::Init;
    using remesh::Junctions;
    using remesh::VertexCount;
    add_choice(options, "topology", &RemeshOptions::vertex_count,
               {VertexCount::Exact, VertexCount::Add}, vertex_count_name);
    add_choice(options, "boundary", &RemeshOptions::boundary, {Boundary::Keep, Boundary::Free},
               cli::boundary_name);
    add_choice(options, "init", &RemeshOptions::init,
               {Init::BlueNoise, Init::Farthest, Init::Random}, remesh::init_name);
    add_choice(options, "features", &RemeshOptions::features,
               {Features::Auto, Features::Angle, Features::Off}, remesh::features_name);
    add_choice(options, "junctions", &RemeshOptions::junctions, {Junctions::Apart, Junctions::Keep},
               remesh::junctions_name);
    add_choice(options, "delaunay", &RemeshOptions::delaunay,
               {Delaunay::Intrinsic, Delaunay::Extrinsic, Delaunay::Off}, remesh::delaunay_name);
}

void add_propagation(OptionsClass& options) {
    options.def_property(
        "engine",
        [](const RemeshOptions& self) {
            return std::string(agvd::engine_name(self.propagation.engine));
        },
        [](RemeshOptions& self, const std::string& name) {
            self.propagation.engine = cli::engine_of(name);
        });
    options.def_property(
        "max_error", [](const RemeshOptions& self) { return self.propagation.max_error; },
        [](RemeshOptions& self, std::optional<double> error) {
            self.propagation.max_error = error;
        });
    options.def_property(
        "steiner_points", [](const RemeshOptions& self) { return self.propagation.steiner_points; },
        [](RemeshOptions& self, int count) { self.propagation.steiner_points = count; });
}

// \param text  as --memory-limit takes it; empty: no limit.
cli::MemoryLimit memory_limit(const std::string& text, agvd::Engine engine) {
    if (text.empty()) return {};
    const std::optional<std::size_t> bytes = cli::parse_bytes(text);
    if (bytes) return {*bytes, engine};
    throw agvd::InvalidOption("memory_limit is '" + text +
                              "'; use a number of bytes above 0, such as '500M' or '3G', a "
                              "percentage of what the machine has, such as '50%', or None");
}

// Those of the program, and what it says in its summary of the result.
std::vector<std::string> warnings_of(const remesh::RemeshResult& result,
                                     const RemeshOptions& options, bool strict) {
    std::vector<std::string> warnings = cli::shortfalls_of(result, options, strict);
    if (std::string text = cli::coarseness_text(result); !text.empty()) warnings.push_back(text);
    if (result.cleaned.split_edges > 0) warnings.push_back(remesh::to_text(result.cleaned));
    for (std::string& text : warnings) text = in_terms_of_python(std::move(text));
    return warnings;
}

// \param limit  see memory_limit.
// \return positions, triangles, faces and coordinates of the vertices on the input, the samples of
// faces on the input (#F x 16, or none), the vertices and the faces that were kept, the report,
// and what a page needs besides.
py::tuple run_remesh(const Doubles& positions, const Indices& triangles, RemeshOptions options,
                     bool with_faces, bool strict, const std::string& limit,
                     const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    const std::size_t num_faces = mesh.triangles.size();
    const std::size_t num_samples = cli::estimated_samples(options, mesh);
    PythonProgress progress(function, cli::stages_of_remesh(num_faces, num_samples, true, options),
                            memory_limit(limit, options.propagation.engine),
                            cli::runs_of_remesh(options));
    progress.require_memory("sample", cli::least_memory(num_faces, num_samples));
    options.progress = [&](remesh::Stage stage, double fraction) {
        return progress.goes_on(remesh::stage_name(stage), fraction);
    };
    remesh::InputMap map;
    std::string report;
    remesh::RemeshResult result = progress.run([&] {
        remesh::RemeshResult made = remesh::remesh(mesh, options);
        remesh::MeshFigures output =
            remesh::measure_figures(made.mesh.view(), agvd::within(progress.of("check"), 1, 1));
        map = remesh::map_to_input(mesh, made.mesh.view(), made.sites,
                                   {.with_faces = with_faces,
                                    .num_threads = options.num_threads,
                                    .progress = progress.of("transfer")});
        report = remesh::to_json(made, {.version = REMESH_VERSION,
                                        .options = options,
                                        .output = std::move(output),
                                        .warnings = warnings_of(made, options, strict)});
        return made;
    });
    const py::tuple places = to_arrays(map.vertices);
    return py::make_tuple(to_array<double>(std::move(result.mesh.positions), 3),
                          to_array<agvd::Index>(std::move(result.mesh.triangles), 3), places[0],
                          places[1], to_array<agvd::Index>(std::move(map.faces), 16),
                          to_numbers(result.kept.vertices), to_numbers(result.kept.faces), report,
                          Made{.options = std::move(options),
                               .sites = std::move(result.sites),
                               .targets = std::move(result.sizing.targets),
                               .has_kept = !result.kept.faces.empty()});
}

}  // namespace

void bind_remesh(py::module_& module) {
    py::class_<Made>(module, "Made");
    OptionsClass options(module, "Options");
    options.def(py::init<>());
    options.def_readwrite("num_samples", &RemeshOptions::num_samples);
    options.def_property(
        "keep_slits", [](const RemeshOptions& self) { return self.cleaning.keep_slits; },
        [](RemeshOptions& self, bool keeps) { self.cleaning.keep_slits = keeps; });
    options.def_readwrite("drop_components", &RemeshOptions::drop_components);
    options.def_readwrite("lock_boundary", &RemeshOptions::lock_boundary);
    options.def_property(
        "weld", [](const RemeshOptions& self) { return self.cleaning.weld; },
        [](RemeshOptions& self, double length) { self.cleaning.weld = length; });
    options.def_property(
        "fill_holes", [](const RemeshOptions& self) { return self.cleaning.fill_holes; },
        [](RemeshOptions& self, agvd::Index edges) { self.cleaning.fill_holes = edges; });
    options.def_readwrite("wrap", &RemeshOptions::wrap);
    options.def_readwrite("feature_angle", &RemeshOptions::feature_angle);
    options.def_readwrite("feature_edges", &RemeshOptions::feature_edges);
    options.def_readwrite("texture_seams", &RemeshOptions::texture_seams);
    options.def_readwrite("seed", &RemeshOptions::seed);
    options.def_readwrite("relax_steps", &RemeshOptions::relax_steps);
    options.def_readwrite("samples_per_tile", &RemeshOptions::samples_per_tile);
    options.def_readwrite("keep_sites", &RemeshOptions::keep_sites);
    options.def_readwrite("fit", &RemeshOptions::fit);
    options.def_readwrite("num_threads", &RemeshOptions::num_threads);
    options.def(
        "set_sites",
        [](RemeshOptions& self, const Indices& faces, const Doubles& places) {
            self.sites = points_of(faces, places);
        },
        py::arg("faces").noconvert(), py::arg("barycentric").noconvert());
    options.def(
        "set_face_labels",
        [](RemeshOptions& self, const Indices& labels) { self.face_labels = vector_of(labels); },
        py::arg("labels").noconvert());
    options.def(
        "set_region",
        [](RemeshOptions& self, const Flags& flags) { self.region = vector_of(flags); },
        py::arg("flags").noconvert());
    options.def(
        "set_locked",
        [](RemeshOptions& self, const Indices& vertices) { self.locked = vector_of(vertices); },
        py::arg("vertices").noconvert());
    options.def(
        "set_target_lengths",
        [](RemeshOptions& self, const Doubles& values) {
            self.sizing.edges = remesh::VertexLengths{vector_of(values)};
        },
        py::arg("values").noconvert());
    options.def(
        "set_face_lengths",
        [](RemeshOptions& self, const Doubles& values) {
            self.sizing.edges = remesh::FaceLengths{vector_of(values)};
        },
        py::arg("values").noconvert());
    options.def(
        "add_place",
        [](RemeshOptions& self, const Indices& faces, const Doubles& places,
           const std::vector<Indices>& lines, const std::vector<Indices>& regions, double length,
           double radius) {
            remesh::SizedPlace place{
                .points = points_of(faces, places), .length = length, .radius = radius};
            for (const remesh::GivenShape& shape : shapes_of(lines, regions, 0)) {
                place.edges.insert(place.edges.end(), shape.edges.begin(), shape.edges.end());
                place.faces.insert(place.faces.end(), shape.faces.begin(), shape.faces.end());
            }
            self.sizing.places.push_back(std::move(place));
        },
        py::arg("faces").noconvert(), py::arg("barycentric").noconvert(), py::arg("lines"),
        py::arg("regions"), py::arg("length"), py::arg("radius"));
    options.def(
        "set_densities",
        [](RemeshOptions& self, const Doubles& values) {
            self.sizing.edges = remesh::VertexDensities{vector_of(values)};
        },
        py::arg("values").noconvert());
    add_choices(options);
    add_propagation(options);
    add_sizing(options, "min_edge", &Sizing::min_edge);
    add_sizing(options, "max_edge", &Sizing::max_edge);
    add_sizing(options, "gradation", &Sizing::gradation);
    add_bound(options, "min_angle", &remesh::ShapeBounds::min_angle);
    add_bound(options, "max_angle", &remesh::ShapeBounds::max_angle);
    add_bound(options, "longest_edge", &remesh::ShapeBounds::longest_edge);
    options.def("set_adaptive",
                [](RemeshOptions& self) { self.sizing.edges = remesh::AdaptiveEdges{}; });
    add_count(
        options, "set_edge_length", +[](double length) { return remesh::MeanEdge{length}; });
    add_count(
        options, "set_num_faces", +[](agvd::Index number) { return remesh::NumFaces{number}; });
    add_count(
        options, "set_max_distance",
        +[](double distance) { return remesh::MaxDistance{distance}; });
    options.def("set_count_of_lengths",
                [](RemeshOptions& self) { self.sizing.count = remesh::CountOfLengths{}; });
    module.def("remesh", &run_remesh, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("options"), py::arg("with_faces"),
               py::arg("strict"), py::arg("memory_limit"), py::arg("progress"));
}

}  // namespace python
