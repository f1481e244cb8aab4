//! \file
//! Meshes on the command line: `-` for a standard stream, and formats that no extension names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "remesh/meshfile/mesh_file.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace cli {

//! ".ply, .obj, .off or .stl"
[[nodiscard]] std::string mesh_extensions();

//! Adds an option or positional argument for a file or folder, whose name is in UTF-8.
CLI::Option* add_file(CLI::App& app, const std::string& name, std::filesystem::path& path,
                      const std::string& help);
//! The same for several.
CLI::Option* add_file(CLI::App& app, const std::string& name,
                      std::vector<std::filesystem::path>& paths, const std::string& help);

//! Adds a positional argument for a mesh to read; `-` becomes /dev/stdin.
CLI::Option* add_mesh_input(CLI::App& app, const std::string& name, const std::string& help,
                            std::filesystem::path& path);
//! Adds an option or positional argument for a mesh to write; `-` becomes /dev/stdout.
CLI::Option* add_mesh_output(CLI::App& app, const std::string& name, const std::string& help,
                             std::filesystem::path& path);

//! The same for several.
CLI::Option* add_mesh_outputs(CLI::App& app, const std::string& name, const std::string& help,
                              std::vector<std::filesystem::path>& paths);

//! Adds --from or --to: the name of a format, in any case.
CLI::Option* add_format_option(CLI::App& app, const std::string& name, const std::string& help,
                               std::string& format);

//! Adds --ascii, for ply_as_text().
void add_ascii(CLI::App& app, bool& ascii);

//! \throw agvd::IoError  the format is unknown.
//! \throw agvd::InvalidOption  the extension names another format than --to.
void check_format(const remesh::MeshPath& output);

[[nodiscard]] bool is_standard_input(const std::filesystem::path& path);
//! The input or the output.
[[nodiscard]] bool is_standard_stream(const std::filesystem::path& path);

//! \throw agvd::InvalidOption  both are the standard output: the mesh and the file of `option`,
//!        which may be empty or `-`.
void check_one_on_stdout(const std::filesystem::path& mesh, const std::filesystem::path& other,
                         const char* option);

}  // namespace cli
