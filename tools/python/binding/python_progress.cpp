#include "binding/python_progress.h"

#include <utility>

namespace python {
namespace {

constexpr std::chrono::milliseconds interval(50);

}  // namespace

bool PythonProgress::goes_on(const char* stage, double fraction) {
    const auto now = std::chrono::steady_clock::now();
    const bool is_new = !function_.is_none() && stage != stage_;
    if (!is_new && now - last_ < interval) return true;
    stage_ = stage;
    const py::gil_scoped_acquire acquire;
    const bool result = ask(stage, fraction);
    last_ = std::chrono::steady_clock::now();  // The function may take long.
    return result;
}

bool PythonProgress::ask(const char* stage, double fraction) {
    try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (function_.is_none()) return true;
        const py::object answer = function_(fraction, stage);
        const int is_true = answer.is_none() ? 1 : PyObject_IsTrue(answer.ptr());
        if (is_true < 0) throw py::error_already_set();
        return is_true != 0;
    } catch (const py::error_already_set& error) {
        error_.emplace(error);
        return false;
    }
}

}  // namespace python
