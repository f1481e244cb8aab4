// Measures of one mesh against another, and of one by itself.
#include "agvd/mesh/scale.h"
#include "binding/arrays.h"
#include "binding/bindings.h"
#include "binding/python_progress.h"
#include "remesh/quality/evaluate.h"
#include "report/report.h"

namespace python {
namespace {

// \return the report as JSON.
std::string run_evaluate(const Doubles& positions, const Indices& triangles,
                         const Doubles& result_positions, const Indices& result_triangles,
                         agvd::Index samples, int num_threads, const py::object& function) {
    const agvd::MeshView original = view_of(positions, triangles);
    const agvd::MeshView result = view_of(result_positions, result_triangles);
    PythonProgress progress(function, {{"measure", 1}});
    return progress.run([&] {
        return remesh::to_json(remesh::evaluate(original, result,
                                                {.samples = samples,
                                                 .num_threads = num_threads,
                                                 .progress = progress.of("measure")}),
                               {.version = REMESH_VERSION});
    });
}

// The diagonal of the box of the faces' corners.
double diagonal(const Doubles& positions, const Indices& triangles) {
    const agvd::MeshBox box = agvd::box_of(view_of(positions, triangles));
    return box.is_empty() ? 0 : (box.high - box.low).norm();
}

}  // namespace

void bind_evaluate(py::module_& module) {
    module.def("evaluate", &run_evaluate, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert(), py::arg("result_positions").noconvert(),
               py::arg("result_triangles").noconvert(), py::arg("samples"), py::arg("num_threads"),
               py::arg("progress"));
    module.def("diagonal", &diagonal, py::arg("positions").noconvert(),
               py::arg("triangles").noconvert());
}

}  // namespace python
