//! \file
//! Progress of the libraries for Python: signals, the caller's function, and the limit of memory.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "agvd/core/progress.h"
#include "memory_limit.h"
#include "overall_progress.h"

namespace python {

namespace py = pybind11;

//! Lets a call that has released the interpreter end by Ctrl-C, by the caller's function, by an
//! exception in it, or above a limit of memory. It takes the interpreter at most every 50 ms, and
//! at the start of a stage if there is a function. It is made and destroyed by the thread that
//! makes the call.
class PythonProgress {
public:
    //! \param function  function(fraction, stage), None: no function. Its fractions are those of the
    //!                  whole call: they never fall, and the last one is 1. It ends the call if it
    //!                  returns something false other than None.
    //! \param stages    those of the call.
    PythonProgress(py::object function, std::vector<cli::ExpectedStage> stages,
                   const cli::MemoryLimit& limit = {}, cli::Runs runs = cli::Runs::One);

    //! For a stage. This outlives it.
    [[nodiscard]] agvd::Progress of(const char* stage) {
        return [this, stage](double fraction) { return goes_on(stage, fraction); };
    }
    //! The interpreter is released.
    [[nodiscard]] bool goes_on(const char* stage, double fraction);

    //! See MemoryGuard::require.
    void require_memory(const char* stage, std::size_t bytes) { memory_.require(stage, bytes); }

    //! Runs work() without the interpreter.
    //! \throw py::error_already_set  KeyboardInterrupt, or what the function raised.
    //! \throw agvd::Cancelled        the function ended the call.
    //! \throw cli::OutOfMemory       the limit was reached, or the system has no more memory.
    template <typename Work>
    auto run(const Work& work) {
        try {
            auto result = [&] {
                const py::gil_scoped_release release;
                return work();
            }();
            finish();
            return result;
        } catch (const agvd::Cancelled&) {
            if (error_) throw py::error_already_set(*error_);
            if (memory_.is_over()) throw memory_.error(stage_);
            throw;
        } catch (const std::bad_alloc&) {
            throw memory_.error(stage_);
        }
    }

private:
    using Clock = std::chrono::steady_clock;

    [[nodiscard]] bool ask(double fraction);
    // Tells that all is done.
    void finish();

    py::object function_;
    std::optional<py::error_already_set> error_;
    cli::OverallProgress overall_;
    cli::MemoryGuard memory_;
    std::string stage_;  // The last one.
    Clock::time_point next_look_, next_call_;
};

}  // namespace python
