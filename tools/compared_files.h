//! \file
//! Diagrams of files compared: of `agvd compare` and the Python module.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "paper/compare_diagrams.h"
#include "report/report.h"

namespace cli {

//! The name that stands for the exact diagram.
inline constexpr const char* exact_diagram = "exact";

//! What is compared, and how.
struct ComparedFiles {
    std::filesystem::path a;  //!< A .agvd file.
    std::filesystem::path b;  //!< Another one; or exact_diagram, of the mesh and the sites of `a`.
    agvd::DiagramCompareOptions options;  //!< Threads and progress are ignored.
    //! As agvd::BisectorErrorOptions::max_points; 0: |dA - dB| is not measured.
    agvd::Index points = agvd::BisectorErrorOptions().max_points;
};

//! \param progress_of  a callback for each of the stages read, propagate, diagram and compare.
//! \throw as remesh::read_diagram, agvd::compare_diagrams and based_diagram.
//! \throw agvd::InvalidInput  both are not of the same mesh and sites.
[[nodiscard]] remesh::Comparison compare_files(
    const ComparedFiles& files, int num_threads,
    const std::function<agvd::Progress(const char*)>& progress_of);

}  // namespace cli
