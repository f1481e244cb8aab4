//! \file
//! Runs the work for one mesh, alone or in a batch: checks, writes what was made, and reports.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "batch.h"
#include "cli.h"
#include "remesh/meshfile/atomic_file.h"

namespace cli {

//! What is to be written for a mesh.
struct Products {
    std::vector<remesh::FileContent> files;
    std::vector<std::string> reports;  //!< JSON objects, one for each result; or not asked for.
    std::string text;                  //!< For people.
};

struct MeshRun {
    std::filesystem::path input, output;  //!< The output of level 0.
    std::filesystem::path report;         //!< Empty: none; "-": stdout.
    bool has_levels = false;              //!< The report is an array.
    bool no_clobber = false;
    std::function<void()> check_outputs;  //!< What it refuses gets no report.
    std::function<Products()> make;       //!< All the work but writing.
};

//! Writes all files and the report, or none of them. If the work fails, only the report is written;
//! after an interruption nothing is.
//! \throw what check_outputs, the work and writing throw.
void run_alone(const MeshRun& run, Console& console);

//! Writes all files or none. With no_clobber nothing is done if the output exists.
[[nodiscard]] MeshOutcome run_in_batch(const MeshRun& run, Console& console);

}  // namespace cli
