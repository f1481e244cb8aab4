// The extension module remesh._remesh: the libraries over NumPy arrays. The Python files of the
// package check and convert what users pass, and document it.
#include "binding/bindings.h"
#include "binding/errors.h"

PYBIND11_MODULE(_remesh, module) {
    module.attr("version") = REMESH_VERSION;
    python::bind_errors(module);
    python::bind_remesh(module);
    python::bind_page(module);
    python::bind_diagram(module);
    python::bind_distances(module);
    python::bind_paths(module);
    python::bind_isolines(module);
    python::bind_stages(module);
    python::bind_transfer(module);
    python::bind_evaluate(module);
    python::bind_files(module);
    python::bind_tiles(module);
}
