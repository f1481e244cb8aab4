#include "binding/python_progress.h"

#include <utility>

namespace python {
namespace {

constexpr std::chrono::milliseconds between_looks{5}, between_calls{50};

}  // namespace

PythonProgress::PythonProgress(py::object function, std::vector<cli::ExpectedStage> stages,
                               const cli::MemoryLimit& limit, cli::Runs runs)
    : function_(std::move(function)), memory_(limit), next_call_(Clock::now() + between_calls) {
    overall_.expect(std::move(stages), runs);
}

bool PythonProgress::goes_on(const char* stage, double fraction) {
    const auto now = Clock::now();
    const bool is_new = stage != stage_;
    if (!is_new && now < next_look_) return !memory_.is_over();
    next_look_ = now + between_looks;
    stage_ = stage;
    overall_.update(stage, fraction);
    if (memory_.check()) return false;
    if (now < next_call_ && (!is_new || function_.is_none())) return true;
    const py::gil_scoped_acquire acquire;
    const bool result = ask(overall_.fraction());
    next_call_ = Clock::now() + between_calls;  // The function may take long.
    return result;
}

bool PythonProgress::ask(double fraction) {
    try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (function_.is_none()) return true;
        const py::object answer = function_(fraction, stage_);
        const int is_true = answer.is_none() ? 1 : PyObject_IsTrue(answer.ptr());
        if (is_true < 0) throw py::error_already_set();
        return is_true != 0;
    } catch (const py::error_already_set& error) {
        error_.emplace(error);
        return false;
    }
}

void PythonProgress::finish() {
    if (!function_.is_none() && !ask(1)) throw agvd::Cancelled();
}

}  // namespace python
