// Meshes and their values from files and to files; polygons as triangles.
#include <pybind11/stl.h>

#include "agvd/core/progress.h"
#include "binding/arrays.h"
#include "binding/bindings.h"
#include "binding/python_progress.h"
#include "choose.h"
#include "declined.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/mesh_file.h"

namespace python {
namespace {

using remesh::Attribute;
using remesh::MeshAttributes;
using remesh::NumberType;

// A type as NumPy calls it.
const char* type_name(NumberType type) {
    constexpr const char* names[] = {"int8",  "uint8",  "int16",   "uint16",
                                     "int32", "uint32", "float32", "float64"};
    return names[static_cast<std::size_t>(type)];
}

NumberType type_of(const std::string& name) {
    using enum NumberType;
    return cli::choose<NumberType>(
        "the type", name, {Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64}, type_name);
}

std::optional<std::string> name_of(const std::optional<NumberType>& type) {
    return type ? std::optional<std::string>(type_name(*type)) : std::nullopt;
}

std::optional<NumberType> type_of(const std::optional<std::string>& name) {
    return name ? std::optional<NumberType>(type_of(*name)) : std::nullopt;
}

// An attribute for Python: its name, type, values, names of labels, whether it is an intensity.
using Row = std::tuple<std::string, std::string, Doubles, std::vector<std::string>, bool>;

std::vector<Row> rows_of(std::vector<Attribute>& attributes) {
    std::vector<Row> rows;
    for (Attribute& one : attributes) {
        rows.emplace_back(one.name, type_name(one.type), to_array<double>(std::move(one.values)),
                          one.names, one.is_intensity);
    }
    return rows;
}

std::vector<Attribute> attributes_of(const std::vector<Row>& rows) {
    std::vector<Attribute> attributes;
    for (const auto& [name, type, values, names, is_intensity] : rows) {
        attributes.push_back({.name = name,
                              .type = type_of(type),
                              .values = vector_of(values),
                              .names = names,
                              .is_intensity = is_intensity});
    }
    return attributes;
}

// \return positions, triangles, attributes of vertices and of faces, texture coordinates (#F x 6,
// or none) and their type, the type of normals, files of materials, warnings.
py::tuple run_read(const std::string& path, const std::string& format, bool is_lenient,
                   const py::object& function) {
    PythonProgress progress(function, {{"read", 1}});
    remesh::MeshFile file = progress.run([&] {
        return remesh::read_mesh(path, {.is_lenient = is_lenient,
                                        .with_attributes = true,
                                        .format = format,
                                        .progress = progress.of("read")});
    });
    MeshAttributes& attributes = file.attributes;
    for (std::string& text : cli::describe(attributes.declined)) {
        file.warnings.push_back(path + ": " + text);
    }
    return py::make_tuple(to_array<double>(std::move(file.mesh.positions), 3),
                          to_array<agvd::Index>(std::move(file.mesh.triangles), 3),
                          rows_of(attributes.of_vertices), rows_of(attributes.of_faces),
                          to_array<double>(std::move(attributes.texture.corners), 6),
                          name_of(attributes.texture.type), name_of(attributes.normals),
                          attributes.material_files, file.warnings);
}

// \return what the file cannot hold.
std::vector<std::string> run_write(const std::string& path, const std::string& format,
                                   const Doubles& positions, const Indices& triangles,
                                   const std::vector<Row>& of_vertices,
                                   const std::vector<Row>& of_faces, const Doubles& corners,
                                   const std::optional<std::string>& corner_type,
                                   const std::optional<std::string>& normals,
                                   const std::vector<std::string>& material_files,
                                   const py::object& function) {
    const agvd::MeshView mesh = view_of(positions, triangles);
    MeshAttributes attributes{.of_vertices = attributes_of(of_vertices),
                              .of_faces = attributes_of(of_faces),
                              .normals = type_of(normals),
                              .material_files = material_files};
    attributes.texture.type = type_of(corner_type);
    const std::span<const remesh::CornerCoordinates> given = corners_of(corners);
    attributes.texture.corners.assign(given.begin(), given.end());
    if (!given.empty()) attributes.texture.seams = remesh::find_texture_seams(mesh, given);
    const remesh::MeshPath target{path, format};
    PythonProgress progress(function, {{"write", 1}});
    return progress.run([&] {
        const agvd::Progress writing = progress.of("write");
        cli::decline_unwritable(target, attributes);
        std::vector<std::string> warnings = cli::describe(attributes.declined);
        const std::string bytes = remesh::format_mesh(target, mesh, attributes, writing);
        const remesh::RoundingLoss loss = remesh::rounding_loss(target, mesh, writing);
        if (loss.matters()) warnings.push_back(remesh::describe(loss, target));
        remesh::write_file_atomically(path, bytes, writing);
        return warnings;
    });
}

// \param offsets  #polygons + 1: polygon i has the corners from offsets[i] to offsets[i + 1].
// \return triangles, and the polygon of each. Polygons of fewer than three corners have none.
py::tuple run_triangulate(const Doubles& positions, const Indices& corners,
                          const py::array_t<std::int64_t, py::array::c_style>& offsets) {
    const agvd::MeshView mesh = view_of(positions, Indices(std::vector<py::ssize_t>{0, 3}));
    const std::span<const agvd::Index> all(corners.data(),
                                           static_cast<std::size_t>(corners.size()));
    agvd::Ticker ticker;
    std::vector<agvd::Triangle> triangles;
    std::vector<std::int64_t> polygons;
    for (py::ssize_t i = 0; i + 1 < offsets.size(); ++i) {
        const auto begin = static_cast<std::size_t>(offsets.at(i));
        const std::size_t count = static_cast<std::size_t>(offsets.at(i + 1)) - begin;
        if (count < 3) continue;
        remesh::append_triangles(all.subspan(begin, count), mesh.positions, ticker, triangles);
        polygons.resize(triangles.size(), i);
    }
    return py::make_tuple(to_array<agvd::Index>(std::move(triangles), 3),
                          to_array<std::int64_t>(std::move(polygons)));
}

}  // namespace

void bind_files(py::module_& module) {
    module.def("read_mesh", &run_read, py::arg("path"), py::arg("format"), py::arg("is_lenient"),
               py::arg("progress"));
    module.def("write_mesh", &run_write, py::arg("path"), py::arg("format"),
               py::arg("positions").noconvert(), py::arg("triangles").noconvert(),
               py::arg("of_vertices"), py::arg("of_faces"), py::arg("corners").noconvert(),
               py::arg("corner_type"), py::arg("normals"), py::arg("material_files"),
               py::arg("progress"));
    module.def("triangulate", &run_triangulate, py::arg("positions").noconvert(),
               py::arg("corners").noconvert(), py::arg("offsets").noconvert());
}

}  // namespace python
