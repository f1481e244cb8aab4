//! \file
//! The exceptions of the libraries as classes of Python.
#pragma once

#include <pybind11/pybind11.h>

namespace python {

//! Adds Error, InvalidOption, InvalidInput, InvalidSites, ConstraintUnmet, Cancelled, OutOfMemory
//! and FileError to the module, and has agvd's exceptions raised as these, with their texts.
void bind_errors(pybind11::module_& module);

}  // namespace python
