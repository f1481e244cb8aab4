// Values at the vertices and faces of an input for those of its remesh.
#include <pybind11/stl.h>

#include "agvd/mesh/mesh.h"
#include "binding/arrays.h"
#include "binding/bindings.h"
#include "remesh/transfer/transfer.h"

namespace python {
namespace {

remesh::ValueKind kind_of(bool is_label) {
    return is_label ? remesh::ValueKind::Label : remesh::ValueKind::Number;
}

std::span<const double> span_of(const Doubles& values) {
    return {values.data(), static_cast<std::size_t>(values.size())};
}

py::array_t<double> run_vertex_values(const Doubles& values, const Doubles& positions,
                                      const Indices& triangles, const Indices& faces,
                                      const Doubles& barycentric, bool is_label) {
    const std::vector<agvd::SurfacePoint> places = points_of(faces, barycentric);
    return to_array<double>(remesh::transfer_vertex_values(
        span_of(values), view_of(positions, triangles), places, kind_of(is_label)));
}

//! \param samples  #F x 16
py::array_t<double> run_face_values(const Doubles& values, const Indices& samples, bool is_label) {
    static_assert(sizeof(remesh::FaceSamples) == 16 * sizeof(agvd::Index));
    const std::span<const remesh::FaceSamples> rows(
        reinterpret_cast<const remesh::FaceSamples*>(samples.data()),
        static_cast<std::size_t>(samples.size()) / 16);
    return to_array<double>(remesh::transfer_face_values(span_of(values), rows, kind_of(is_label)));
}

std::vector<std::array<agvd::Index, 2>> run_texture_seams(const Doubles& values,
                                                          const Doubles& positions,
                                                          const Indices& triangles) {
    return remesh::find_texture_seams(view_of(positions, triangles), corners_of(values));
}

//! \return #F of the result x 6
py::array_t<double> run_corner_values(const Doubles& values, const Doubles& positions,
                                      const Indices& triangles, const Doubles& result_positions,
                                      const Indices& result_triangles, const Indices& faces,
                                      const Doubles& barycentric, int num_threads) {
    const std::vector<agvd::SurfacePoint> places = points_of(faces, barycentric);
    std::vector<remesh::CornerCoordinates> carried;
    {
        const py::gil_scoped_release release;
        carried = remesh::transfer_corner_values(corners_of(values), view_of(positions, triangles),
                                                 view_of(result_positions, result_triangles),
                                                 places, {.num_threads = num_threads});
    }
    return to_array<double>(std::move(carried), 6);
}

py::array_t<double> run_normals(const Doubles& positions, const Indices& triangles) {
    return to_array<double>(remesh::vertex_normals(view_of(positions, triangles)), 3);
}

}  // namespace

void bind_transfer(py::module_& module) {
    module.def("transfer_vertex_values", &run_vertex_values, py::arg("values").noconvert(),
               py::arg("positions").noconvert(), py::arg("triangles").noconvert(),
               py::arg("faces").noconvert(), py::arg("barycentric").noconvert(),
               py::arg("is_label"));
    module.def("transfer_face_values", &run_face_values, py::arg("values").noconvert(),
               py::arg("samples").noconvert(), py::arg("is_label"));
    module.def("texture_seams", &run_texture_seams, py::arg("values").noconvert(),
               py::arg("positions").noconvert(), py::arg("triangles").noconvert());
    module.def("transfer_corner_values", &run_corner_values, py::arg("values").noconvert(),
               py::arg("positions").noconvert(), py::arg("triangles").noconvert(),
               py::arg("result_positions").noconvert(), py::arg("result_triangles").noconvert(),
               py::arg("faces").noconvert(), py::arg("barycentric").noconvert(),
               py::arg("num_threads"));
    module.def("vertex_normals", &run_normals, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert());
}

}  // namespace python
