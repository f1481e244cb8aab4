//! \file
//! What the files bind_*.cpp add to the module.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "remesh/pipeline/remesh.h"

namespace python {

//! What a page tells of a result besides its arrays and its report. Opaque to Python.
struct Made {
    remesh::RemeshOptions options;
    std::vector<agvd::SurfacePoint> sites;  //!< On the input.
    std::vector<double> targets;            //!< See page::Page.
    bool has_kept = false;                  //!< Faces of the input stayed.
};

void bind_remesh(pybind11::module_& module);     //!< Options and remesh.
void bind_diagram(pybind11::module_& module);    //!< Diagrams and distances.
void bind_distances(pybind11::module_& module);  //!< Distances of points and of k sites.
void bind_isolines(pybind11::module_& module);   //!< Lines of equal distance.
void bind_page(pybind11::module_& module);       //!< Report pages.
void bind_paths(pybind11::module_& module);      //!< Shortest paths.
void bind_stages(pybind11::module_& module);     //!< Cleaning, sampling, relaxation.
void bind_transfer(pybind11::module_& module);   //!< Values of the input for the result.
void bind_files(pybind11::module_& module);      //!< Files, and polygons.
void bind_tiles(pybind11::module_& module);      //!< Meshes larger than memory.
void bind_evaluate(pybind11::module_& module);   //!< Measures.

}  // namespace python
