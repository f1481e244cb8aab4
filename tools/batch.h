//! \file
//! Which file each mesh becomes, in runs of one or many; what follows a failure, and the summary.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli.h"
#include "levels.h"

namespace cli {

//! A mesh to read and the file that it becomes; with levels several, see level_paths.
struct BatchMesh {
    std::filesystem::path input, output;
};

//! What a batch is to do.
struct BatchArguments {
    std::vector<std::filesystem::path> inputs;
    std::filesystem::path folder;  //!< Of the outputs; made if it does not exist.
    std::string to;                //!< Format of the outputs; empty: by the inputs' names.
    LevelArguments levels = {};    //!< Of each mesh.
    std::filesystem::path report;  //!< Empty: none; "-": stdout.
    bool force = false;            //!< Outputs may replace inputs.
};

//! The output of a run without a folder.
//! \throw agvd::InvalidOption  there is not exactly one; the text tells of --out-dir.
[[nodiscard]] std::filesystem::path only_output(std::span<const std::filesystem::path> outputs);

//! The file of the same name in `folder`. Its extension is that of the format; without one, .ply
//! takes the place of an extension that cannot be written.
//! \param format  "ply", "obj.gz", ...; empty: none.
[[nodiscard]] std::filesystem::path output_in(const std::filesystem::path& folder,
                                              const std::filesystem::path& input,
                                              const std::string& format = {});

//! Text of a JSON array.
[[nodiscard]] std::string to_array(std::span<const std::string> objects);

//! The outputs of all inputs, in their order. Nothing is read or written.
//! \throw agvd::InvalidOption  two files would be written to the same place, or, without `force`,
//!        over an input.
[[nodiscard]] std::vector<BatchMesh> plan_batch(const BatchArguments& arguments);

//! What became of a mesh.
struct MeshOutcome {
    std::vector<std::string> reports;  //!< JSON objects; with levels one for each.
    bool is_skipped = false;
    std::optional<Failure> failure;
};

//! Makes the folder and calls run_mesh for one mesh after the other. A failure does not stop the
//! rest; an interruption does. Writes the reports of the meshes as a JSON array at the end, also
//! after an interruption, with those that were finished before.
//! \param run_mesh  catches what its work throws.
//! \throw PartlyDone     some meshes failed (ExitCode::Batch), or the batch was interrupted; the
//!        text is the summary.
//! \throw agvd::IoError  the folder or the report cannot be written.
void run_batch(const BatchArguments& arguments, std::span<const BatchMesh> meshes,
               const std::function<MeshOutcome(const BatchMesh&)>& run_mesh, Console& console);

}  // namespace cli
