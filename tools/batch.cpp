// Runs the meshes of --out-dir. All that can be wrong with the names of the files is found before
// the first mesh is read.
#include "batch.h"

#include <map>
#include <system_error>

#include "mesh_paths.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/mesh_file.h"
#include "system/same_place.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

// Outputs, by place, and what is written there.
using Places = std::map<std::string, std::string>;

void add_output(const fs::path& output, const std::string& name, Places& places) {
    const auto [at, is_new] = places.emplace(place_of(output), name);
    if (is_new) return;
    throw agvd::InvalidOption(at->second + " and " + name + " would be written to the same file, " +
                              output.string() +
                              "; rename one, or run them with different --out-dir");
}

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder)) {
        throw agvd::IoError(folder.string() + ": cannot be made: " +
                            (error ? error.message() : "it is not a folder") +
                            "; choose another --out-dir");
    }
    remesh::require_writable(folder / "mesh");
}

// One line that begins with the name of the file.
std::string describe(const BatchMesh& mesh, const Failure& failure) {
    const std::string name = mesh.input.string();
    const std::string text =
        failure.text.starts_with(name) ? failure.text : name + ": " + failure.text;
    return text + " (exit code " + std::to_string(failure.exit_code) + ")";
}

// Not stopped by an interruption: what is finished is told.
void write_reports(const fs::path& path, const std::vector<std::string>& reports) {
    if (path.empty()) return;
    if (path == "-") {
        print(to_array(reports));
    } else {
        remesh::write_file_atomically(path, to_array(reports));
    }
}

}  // namespace

fs::path only_output(std::span<const fs::path> outputs) {
    if (outputs.size() == 1) return outputs[0];
    if (outputs.empty()) {
        throw agvd::InvalidOption(
            "no file to write is named; name one after the input, or a "
            "folder by --out-dir");
    }
    throw agvd::InvalidOption(std::to_string(outputs.size()) +
                              " files are named besides the input, but one mesh becomes one file; "
                              "to remesh several meshes, name a folder for the results by "
                              "--out-dir");
}

fs::path output_in(const fs::path& folder, const fs::path& input, const std::string& format) {
    fs::path output = folder / input.filename();
    if (format.empty() && remesh::is_known_mesh_extension(output)) return output;
    if (output.extension() == ".gz") output.replace_extension();
    output.replace_extension(format.empty() ? "ply" : format);
    return output;
}

std::string to_array(std::span<const std::string> objects) {
    std::string text;
    for (const std::string& object : objects) text += (text.empty() ? "[\n" : ",\n") + object;
    return text.empty() ? "[]\n" : text + "]\n";
}

std::vector<BatchMesh> plan_batch(const BatchArguments& arguments) {
    std::vector<BatchMesh> meshes;
    Places places;
    for (const fs::path& input : arguments.inputs) {
        if (!input.has_filename() || is_standard_stream(input)) {
            const std::string name = input.string();
            throw agvd::InvalidOption("'" + name +
                                      "' gives no name for a file in --out-dir; name a file");
        }
        meshes.push_back({input, output_in(arguments.folder, input, arguments.to)});
        for (const fs::path& file : level_paths(arguments.levels, meshes.back().output)) {
            add_output(file, input.string(), places);
        }
    }
    if (!arguments.report.empty() && arguments.report != "-") {
        add_output(arguments.report, "--report", places);
    }
    for (const fs::path& input : arguments.inputs) {
        if (arguments.force || !places.contains(place_of(input))) continue;
        throw agvd::InvalidOption(input.string() +
                                  " would be overwritten by an output; choose another folder or "
                                  "file, or use --force");
    }
    return meshes;
}

void run_batch(const BatchArguments& arguments, std::span<const BatchMesh> meshes,
               const std::function<MeshOutcome(const BatchMesh&)>& run_mesh, Console& console) {
    make_folder(arguments.folder);
    if (!arguments.report.empty() && arguments.report != "-") {
        remesh::require_writable(arguments.report);
    }
    std::vector<std::string> reports, failures;
    std::size_t num_finished = 0, num_skipped = 0;
    for (const BatchMesh& mesh : meshes) {
        console.info("mesh " + std::to_string(num_finished + 1) + " of " +
                     std::to_string(meshes.size()) + ": " + mesh.input.string());
        const MeshOutcome outcome = run_mesh(mesh);
        if (outcome.failure && interrupted()) break;
        ++num_finished;
        reports.insert(reports.end(), outcome.reports.begin(), outcome.reports.end());
        if (outcome.is_skipped) ++num_skipped;
        if (outcome.failure) {
            failures.push_back(describe(mesh, *outcome.failure));
            console.error(failures.back());
        }
        if (interrupted()) break;
    }
    write_reports(arguments.report, reports);
    std::string summary = std::to_string(num_finished - failures.size() - num_skipped) + " done, " +
                          std::to_string(failures.size()) + " failed";
    if (num_skipped > 0) summary += ", " + std::to_string(num_skipped) + " skipped";
    const bool is_cut_off = num_finished < meshes.size();
    if (is_cut_off) {
        summary = "interrupted: " + summary + ", " + std::to_string(meshes.size() - num_finished) +
                  " not finished";
    }
    if (failures.empty() && !is_cut_off) return console.info(summary);
    for (const std::string& failure : failures) summary += "\n  " + failure;
    throw PartlyDone(
        {is_cut_off ? interruption_code() : static_cast<int>(ExitCode::Batch), summary});
}

}  // namespace cli
