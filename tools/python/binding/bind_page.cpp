// Report pages of results.
#include <pybind11/stl.h>

#include "binding/arrays.h"
#include "binding/bindings.h"
#include "binding/python_progress.h"
#include "page/page.h"
#include "page/thin_mesh.h"
#include "page/viewer.h"
#include "page_cells.h"

namespace python {
namespace {

// What Python calls the parts of a page.
struct Texts {
    std::string report;
    std::string command;
    std::string original_name;
    std::string result_name;
    std::string label_name;
};

std::string run_page(const Doubles& positions, const Indices& triangles,
                     const Doubles& result_positions, const Indices& result_triangles,
                     const Made& made, const Texts& texts, const Doubles& labels,
                     const Doubles& result_labels, const py::object& function) {
    page::require_viewer("html()");
    page::Page page{.version = REMESH_VERSION,
                    .command = texts.command,
                    .report = texts.report,
                    .original_name = texts.original_name,
                    .result_name = texts.result_name,
                    .original = view_of(positions, triangles),
                    .result = view_of(result_positions, result_triangles),
                    .targets = made.targets,
                    .original_labels = {texts.label_name, vector_of(labels)},
                    .result_labels = {texts.label_name, vector_of(result_labels)},
                    .options = made.options};
    page.options.progress = {};
    page.options.cleaning.progress = {};
    PythonProgress progress(
        function, {{"clean", 1}, {"propagate", 3}, {"diagram", 2}, {"measure", 4}, {"page", 2}});
    return progress.run([&] {
        if (page.original.triangles.size() <= page::most_faces && !made.has_kept) {
            page.cells = cli::cells_for_page(page.original, made.sites, page.options,
                                             [&](const char* stage) { return progress.of(stage); });
        }
        page.evaluation = remesh::evaluate(
            page.original, page.result,
            {.num_threads = page.options.num_threads, .progress = progress.of("measure")});
        return page::format_page(page, progress.of("page"));
    });
}

}  // namespace

void bind_page(py::module_& module) {
    module.def(
        "page",
        [](const Doubles& positions, const Indices& triangles, const Doubles& result_positions,
           const Indices& result_triangles, const Made& made, const std::string& report,
           const std::string& command, const std::string& original_name,
           const std::string& result_name, const std::string& label_name, const Doubles& labels,
           const Doubles& result_labels, const py::object& progress) {
            return run_page(positions, triangles, result_positions, result_triangles, made,
                            {report, command, original_name, result_name, label_name}, labels,
                            result_labels, progress);
        },
        py::arg("positions").noconvert(), py::arg("triangles").noconvert(),
        py::arg("result_positions").noconvert(), py::arg("result_triangles").noconvert(),
        py::arg("made"), py::arg("report"), py::arg("command"), py::arg("original_name"),
        py::arg("result_name"), py::arg("label_name"), py::arg("labels").noconvert(),
        py::arg("result_labels").noconvert(), py::arg("progress"));
    module.def("has_viewer", [] { return !page::viewer().head.empty(); });
}

}  // namespace python
