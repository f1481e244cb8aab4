//! \file
//! Options of `remesh` for what the input carries: colours, labels and other properties.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/mesh_file.h"
#include "report/report.h"

namespace cli {

struct AttributeArguments {
    std::string transfer = "all";  //!< "all", "none", or names with commas.
    std::filesystem::path map;     //!< Empty: none.
    std::string keep_labels;       //!< Empty: no; "*": the labels of the file; or a name.
};

//! Adds --transfer, --map and --keep-labels.
void add_attribute_options(CLI::App& app, AttributeArguments& arguments);

//! Whether the input must be read with its attributes.
[[nodiscard]] bool wants_attributes(const AttributeArguments& arguments);

//! Call before outputs are checked: "--keep-labels material" names an output, not labels.
//! \throw agvd::InvalidOption  after --keep-labels without a name an output has no known format.
void check_no_label(const AttributeArguments& arguments,
                    const std::vector<std::filesystem::path>& outputs);

//! Labels for RemeshOptions::face_labels, as --keep-labels wants them; empty without it.
//! \throw agvd::InvalidOption  there are no such labels, or several; the text lists them.
[[nodiscard]] std::vector<agvd::Index> labels_to_keep(const AttributeArguments& arguments,
                                                      const std::filesystem::path& input,
                                                      const remesh::MeshAttributes& attributes);

//! Removes the attributes that the output will not have, and warns of those that it should have:
//! they cannot be carried over, or the format of the output cannot hold them.
//! \throw agvd::InvalidOption  --transfer names one that does not exist; the text lists those that
//!        do.
[[nodiscard]] remesh::AttributeReport select_attributes(const AttributeArguments& arguments,
                                                        const std::filesystem::path& input,
                                                        const remesh::MeshPath& output,
                                                        remesh::MeshAttributes& attributes,
                                                        Console& console);

//! Whether the result must be mapped to the input, which then must stay in memory.
[[nodiscard]] bool needs_map(const AttributeArguments& arguments,
                             const remesh::MeshAttributes& attributes);

//! The attributes of the result. Appends the file of --map to `files`.
[[nodiscard]] remesh::MeshAttributes carry_attributes(const AttributeArguments& arguments,
                                                      const remesh::MeshFile& input,
                                                      const remesh::RemeshResult& result,
                                                      int num_threads,
                                                      const agvd::Progress& progress,
                                                      std::vector<remesh::FileContent>& files);

}  // namespace cli
