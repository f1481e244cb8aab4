#include "binding/errors.h"

#include "agvd/core/error.h"
#include "binding/python_terms.h"
#include "memory_limit.h"

namespace python {
namespace {

namespace py = pybind11;

// They live as long as the process: a translator of exceptions cannot own what is freed earlier.
struct Classes {
    PyObject* error = nullptr;
    PyObject* invalid_option = nullptr;
    PyObject* invalid_input = nullptr;
    PyObject* invalid_sites = nullptr;
    PyObject* constraint_unmet = nullptr;
    PyObject* cancelled = nullptr;
    PyObject* out_of_memory = nullptr;
    PyObject* io_error = nullptr;
};

const Classes& classes(const Classes& made = {}) {
    static const Classes kept = made;
    return kept;
}

PyObject* add_class(py::module_& module, const char* name, const char* text,
                    const py::tuple& bases) {
    const std::string full_name = std::string("remesh.") + name;
    PyObject* const made = PyErr_NewExceptionWithDoc(full_name.c_str(), text, bases.ptr(), nullptr);
    if (made == nullptr) throw py::error_already_set();
    module.add_object(name, made);
    return made;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): the type that pybind11 asks for.
void translate(std::exception_ptr thrown) {
    const auto raise = [](PyObject* type, const std::exception& error) {
        PyErr_SetString(type, in_terms_of_python(error.what()).c_str());
    };
    try {
        if (thrown) std::rethrow_exception(thrown);
    } catch (const agvd::InvalidOption& error) {
        raise(classes().invalid_option, error);
    } catch (const agvd::InvalidSites& error) {
        raise(classes().invalid_sites, error);
    } catch (const agvd::InvalidInput& error) {
        raise(classes().invalid_input, error);
    } catch (const agvd::ConstraintUnmet& error) {
        raise(classes().constraint_unmet, error);
    } catch (const agvd::Cancelled& error) {
        raise(classes().cancelled, error);
    } catch (const agvd::IoError& error) {
        raise(classes().io_error, error);
    } catch (const cli::OutOfMemory& error) {
        raise(classes().out_of_memory, error);
    } catch (const agvd::Error& error) {
        raise(classes().error, error);
    }
}

}  // namespace

void bind_errors(py::module_& module) {
    Classes made;
    made.error = add_class(module, "Error", "Base of all errors that this package raises.",
                           py::make_tuple(py::handle(PyExc_Exception)));
    const py::handle error(made.error);
    const py::tuple bad_value = py::make_tuple(error, py::handle(PyExc_ValueError));
    made.invalid_option =
        add_class(module, "InvalidOption", "An option is out of its range.", bad_value);
    made.invalid_input = add_class(
        module, "InvalidInput",
        "The mesh or another input cannot be used: not finite, not orientable, ...", bad_value);
    made.invalid_sites =
        add_class(module, "InvalidSites", "Given sites cannot be used on this mesh.",
                  py::make_tuple(py::handle(made.invalid_input)));
    made.constraint_unmet =
        add_class(module, "ConstraintUnmet",
                  "What was asked for cannot be had on this input; nothing was made.",
                  py::make_tuple(error, py::handle(PyExc_RuntimeError)));
    made.cancelled = add_class(module, "Cancelled", "The progress function returned False.",
                               py::make_tuple(error));
    made.out_of_memory =
        add_class(module, "OutOfMemory", "More memory than memory_limit, or than the system gives.",
                  py::make_tuple(error, py::handle(PyExc_MemoryError)));
    made.io_error = add_class(module, "FileError", "A file cannot be read or written.",
                              py::make_tuple(error, py::handle(PyExc_OSError)));
    classes(made);
    py::register_exception_translator(&translate);
}

}  // namespace python
