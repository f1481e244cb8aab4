#include "query.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "help.h"
#include "remesh/clean/carry.h"
#include "remesh/meshfile/atomic_file.h"
#include "report/report.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using agvd::SurfacePoint;

std::vector<SurfacePoint> sample(const DiagramArguments& arguments, const agvd::Surface& surface,
                                 Console& console) {
    remesh::SamplingOptions sampling = arguments.sampling;
    sampling.num_samples = num_samples_for(arguments, surface.num_vertices());
    sampling.num_threads = arguments.common.threads;
    sampling.progress = console.progress_of("sample");
    return naming_file(arguments.input, [&] { return remesh::sample_sites(surface, sampling); });
}

}  // namespace

std::string check_length(const char* name, const std::string& text) {
    const std::optional<Amount> amount = parse_amount(text);
    if (amount && !amount->is_percent) return {};
    return "the " + std::string(name) + " is " + text + "; use a number above 0";
}

CLI::Option* add_outputs(CLI::App& app, std::vector<fs::path>& outputs) {
    start_group(app, heading::files);
    return app
        .add_option("-o,--output", outputs, "File to write; repeat the option to write more files")
        ->type_name("FILE")
        ->allow_extra_args(false);
}

void check_outputs(const QueryArguments& arguments, std::initializer_list<fs::path> inputs,
                   void (*check_extension)(const fs::path&)) {
    for (const fs::path& output : arguments.outputs) {
        check_extension(output);
        check_output(output, {arguments.input}, arguments.force);
        check_output(output, inputs, arguments.force);
        const auto same =
            std::count_if(arguments.outputs.begin(), arguments.outputs.end(),
                          [&](const fs::path& other) { return is_same_file(output, other); });
        if (same > 1) {
            throw agvd::InvalidOption(output.string() +
                                      " is named twice as an output; choose another file");
        }
    }
}

OpenedInput open_input(const DiagramArguments& arguments, Console& console,
                       const std::function<std::vector<ExpectedStage>(std::size_t)>& stages) {
    OpenedInput input{read_input(arguments, console), {}, {}};
    const agvd::MeshView mesh = input.file.mesh.view();
    console.info(describe(arguments.input, mesh));
    console.expect(stages(mesh.triangles.size()));
    remesh::CleanOptions cleaning = arguments.cleaning;
    cleaning.num_threads = arguments.common.threads;
    cleaning.progress = console.progress_of("clean");
    input.clean = naming_file(arguments.input, [&] { return remesh::clean_input(mesh, cleaning); });
    console.info(remesh::to_text(input.clean.counts));
    input.surface = agvd::build_surface(input.clean.mesh.view(), arguments.common.threads,
                                        console.progress_of("clean"));
    return input;
}

std::vector<SurfacePoint> sites_on(const OpenedInput& input, const DiagramArguments& arguments,
                                   Console& console) {
    if (arguments.sites.empty()) return sample(arguments, input.surface, console);
    const agvd::MeshView mesh = input.file.mesh.view();
    const std::vector<SurfacePoint> given = read_given_sites(arguments, mesh, console);
    return naming_file(arguments.sites,
                       [&] { return remesh::to_cleaned(given, mesh, input.clean); });
}

std::vector<SurfacePoint> points_on(const OpenedInput& input, const fs::path& path,
                                    Console& console) {
    const agvd::MeshView mesh = input.file.mesh.view();
    const std::vector<SurfacePoint> given = read_points(path, mesh, console);
    return naming_file(path, [&] { return remesh::to_cleaned(given, mesh, input.clean); });
}

void write_lines(const QueryArguments& arguments, const remesh::Lines& lines, Console& console) {
    const agvd::Progress writing = console.progress_of("write");
    std::vector<remesh::FileContent> files;
    for (const fs::path& output : arguments.outputs) {
        files.push_back({output, remesh::format_lines(output, lines, writing)});
    }
    remesh::write_files_atomically(files, writing);
}

}  // namespace cli
