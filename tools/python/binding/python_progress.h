//! \file
//! Progress of the libraries for Python: signals, and the caller's function.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>

#include "agvd/core/progress.h"

namespace python {

namespace py = pybind11;

//! Lets a call that has released the interpreter end by Ctrl-C, by the caller's function, or by an
//! exception in it. It takes the interpreter at most every 50 ms, and at the start of a stage if
//! there is a function. It is made and destroyed by the thread that makes the call.
class PythonProgress {
public:
    //! \param function  function(fraction, stage), None: no function. It ends the call if it
    //!                  returns something false other than None.
    explicit PythonProgress(py::object function) : function_(std::move(function)) {}

    //! For a stage. This outlives it.
    [[nodiscard]] agvd::Progress of(const char* stage) {
        return [this, stage](double fraction) { return goes_on(stage, fraction); };
    }
    //! The interpreter is released.
    //! \param stage  lives as long as this.
    [[nodiscard]] bool goes_on(const char* stage, double fraction);

    //! Runs work() without the interpreter.
    //! \throw py::error_already_set  KeyboardInterrupt, or what the function raised.
    //! \throw agvd::Cancelled        the function ended the call.
    template <typename Work>
    auto run(const Work& work) {
        try {
            const py::gil_scoped_release release;
            return work();
        } catch (const agvd::Cancelled&) {
            if (error_) throw py::error_already_set(*error_);
            throw;
        }
    }

private:
    [[nodiscard]] bool ask(const char* stage, double fraction);

    py::object function_;
    std::optional<py::error_already_set> error_;
    const char* stage_ = nullptr;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace python
