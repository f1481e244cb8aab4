//! \file
//! The command line that `remesh` and `agvd diagram` have in common: mesh, sites, propagation.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "agvd/propagation/propagate.h"
#include "cli.h"
#include "remesh/sampling/sample_sites.h"

namespace cli {

//! What the options say; everything has its documented range once run() calls the job.
struct DiagramArguments {
    std::filesystem::path input;
    std::filesystem::path sites;  //!< Empty: sample.
    remesh::SamplingOptions sampling;
    agvd::PropagationOptions propagation;
    bool force = false;
    CommonOptions common;
};

//! Every engine by its name on the command line.
[[nodiscard]] std::map<std::string, agvd::Engine> engines_by_name();

//! Adds IN, --samples, --init, --seed, --sites, --engine, --max-error, --steiner-points, --lambda,
//! --force and the common options.
void add_diagram_options(CLI::App& app, DiagramArguments& arguments);

//! "FILE: N vertices, M faces", for the log.
[[nodiscard]] std::string describe(const std::filesystem::path& path, const agvd::MeshView& mesh);

}  // namespace cli
