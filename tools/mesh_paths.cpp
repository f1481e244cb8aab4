#include "mesh_paths.h"

#include <CLI/CLI.hpp>

#include "agvd/core/error.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/system_file.h"

namespace cli {

namespace fs = std::filesystem;

namespace {

constexpr const char* input_stream = "/dev/stdin";
constexpr const char* output_stream = "/dev/stdout";

// \tparam Paths  a path, or a vector of these.
template <typename Paths>
CLI::Option* add_mesh_path(CLI::App& app, const std::string& name, const std::string& help,
                           const char* stream, Paths& path) {
    const auto name_stream = [stream](std::string& text) {
        if (text == "-") text = stream;
        return std::string();
    };
    return add_file(app, name, path, help)->transform(CLI::Validator(name_stream, ""));
}

}  // namespace

CLI::Option* add_file(CLI::App& app, const std::string& name, std::filesystem::path& path,
                      const std::string& help) {
    const auto take = [&path](const std::string& text) { path = remesh::path_of(text); };
    return app.add_option_function<std::string>(name, take, help);
}

CLI::Option* add_file(CLI::App& app, const std::string& name,
                      std::vector<std::filesystem::path>& paths, const std::string& help) {
    const auto take = [&paths](const std::vector<std::string>& texts) {
        paths.clear();
        for (const std::string& text : texts) paths.push_back(remesh::path_of(text));
    };
    return app.add_option_function<std::vector<std::string>>(name, take, help);
}

std::string mesh_extensions() { return remesh::mesh_formats("."); }

CLI::Option* add_mesh_input(CLI::App& app, const std::string& name, const std::string& help,
                            std::filesystem::path& path) {
    return add_mesh_path(app, name, help, input_stream, path);
}

CLI::Option* add_mesh_output(CLI::App& app, const std::string& name, const std::string& help,
                             std::filesystem::path& path) {
    return add_mesh_path(app, name, help, output_stream, path);
}

CLI::Option* add_mesh_outputs(CLI::App& app, const std::string& name, const std::string& help,
                              std::vector<std::filesystem::path>& paths) {
    return add_mesh_path(app, name, help, output_stream, paths);
}

CLI::Option* add_format_option(CLI::App& app, const std::string& name, const std::string& help,
                               std::string& format) {
    const auto check = [](std::string& text) {
        for (char& c : text) c = 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        if (remesh::is_known_mesh_format({.path = {}, .format = text})) return std::string();
        return "unknown format '" + text + "'; use " + remesh::mesh_formats();
    };
    return app.add_option(name, format, help)
        ->transform(CLI::Validator(check, ""))
        ->type_name("FORMAT");
}

void add_ascii(CLI::App& app, bool& ascii) {
    app.add_flag("--ascii", ascii, "Write .ply as text, for programs that read no other");
}

void check_format(const remesh::MeshPath& output) {
    const std::string format = remesh::mesh_format(output);
    const fs::path& path = output.path;
    if (output.format.empty() || !remesh::is_known_mesh_extension(path)) return;
    const bool is_packed = path.extension() == ".gz", wants_packed = output.format.ends_with(".gz");
    if (remesh::mesh_format({path}) == format && is_packed == wants_packed) return;
    throw agvd::InvalidOption("--to " + output.format + " does not fit the name of the output, " +
                              path.string() + "; leave out --to, or name the output ." +
                              output.format);
}

bool is_standard_input(const std::filesystem::path& path) { return path == input_stream; }

bool is_standard_stream(const std::filesystem::path& path) {
    return path == input_stream || path == output_stream;
}

void check_one_on_stdout(const std::filesystem::path& mesh, const std::filesystem::path& other,
                         const char* option) {
    if (mesh != output_stream || (other != "-" && other != output_stream)) return;
    throw agvd::InvalidOption(
        std::string("the mesh and ") + option +
        " cannot both go to the standard output; write one of them to a file");
}

}  // namespace cli
