// Compares a remeshed surface with the original.
#include <CLI/CLI.hpp>

#include "arguments.h"
#include "cli.h"
#include "help.h"
#include "mesh_paths.h"
#include "page_outputs.h"
#include "remesh/meshfile/mesh_file.h"
#include "report/report.h"
#include "system/process.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* footer =
    "Examples:\n"
    "  remesh-eval bunny.ply out.obj\n"
    "  remesh-eval bunny.ply out.obj --report - | jq .distance.two_sided\n\n"
    "ORIGINAL is cleaned first, as remesh does; the report counts the repairs.\n"
    "RESULT is measured as it is. Distances are in percent of the diagonal of\n"
    "ORIGINAL's bounding box; two-sided is the larger of both directions.\n"
    "Q = 6 / sqrt(3) * area / (half perimeter * longest edge).\n"
    "An edge is sharp if its faces turn by more than 40 degrees. A sharp edge of\n"
    "ORIGINAL is covered where RESULT has an edge of more than 25 degrees nearby.\n"
    "A sharp edge of RESULT is false where it is farther than .1 % from all such\n"
    "edges and the boundary of ORIGINAL.\n\n";

struct Arguments {
    fs::path original;
    fs::path result;
    std::string from;  // Format of the one that comes from standard input.
    fs::path report;   // Empty: none; "-": stdout, and no text.
    cli::PageArguments page;
    remesh::EvaluationOptions options;
};

// \throw agvd::InvalidOption  an output is one of the inputs, or another output.
void check_outputs(const Arguments& arguments) {
    cli::check_page_options(arguments.page);
    std::vector<fs::path> checked;
    for (const fs::path& output : {arguments.report, arguments.page.html, arguments.page.picture}) {
        if (output.empty() || output == "-") continue;
        cli::check_output(output, {arguments.original, arguments.result});
        for (const fs::path& other : checked) {
            if (!cli::is_same_file(output, other)) continue;
            throw agvd::InvalidOption(output.string() +
                                      " is named for two outputs; choose another file");
        }
        checked.push_back(output);
    }
}

page::Page page_of(const Arguments& arguments, const remesh::MeshFile& original,
                   const remesh::MeshFile& result, const remesh::Evaluation& evaluation) {
    return {.original_name = arguments.original.filename().string(),
            .result_name = arguments.result.filename().string(),
            .original = original.mesh.view(),
            .result = result.mesh.view(),
            .evaluation = evaluation,
            .original_labels = cli::labels_for_page(original.attributes),
            .result_labels = cli::labels_for_page(result.attributes),
            .original_colors = cli::colors_for_page(original.attributes),
            .result_colors = cli::colors_for_page(result.attributes),
            .options = {.num_threads = arguments.options.num_threads}};
}

void run_job(Arguments& arguments, cli::Console& console) {
    const bool is_json_on_stdout = arguments.report == "-";
    check_outputs(arguments);
    const auto read = [&](const fs::path& path) {
        const bool is_stream = cli::is_standard_input(path);
        return remesh::read_mesh(
            path, remesh::ReadOptions{.with_attributes = !arguments.page.html.empty(),
                                      .format = is_stream ? arguments.from : std::string(),
                                      .progress = console.progress_of("read")});
    };
    if (cli::is_standard_input(arguments.original) && cli::is_standard_input(arguments.result)) {
        throw agvd::InvalidOption(
            "ORIGINAL and RESULT cannot both be the standard input; name a file for one of them");
    }
    const remesh::MeshFile original = read(arguments.original);
    const remesh::MeshFile result = read(arguments.result);
    arguments.options.progress = console.progress_of("measure");
    const std::string both =
        "comparing " + arguments.original.string() + " with " + arguments.result.string();
    const remesh::Evaluation evaluation = cli::naming_file(both, [&] {
        return remesh::evaluate(original.mesh.view(), result.mesh.view(), arguments.options);
    });
    const remesh::EvaluationInfo info{.version = REMESH_VERSION,
                                      .original_path = arguments.original.string(),
                                      .result_path = arguments.result.string()};
    std::vector<remesh::FileContent> files =
        cli::make_pages(arguments.page, page_of(arguments, original, result, evaluation),
                        console.progress_of("page"));
    if (!arguments.report.empty() && !is_json_on_stdout) {
        files.push_back({arguments.report, to_json(evaluation, info)});
    }
    remesh::write_files_atomically(files, console.progress_of("write"));
    cli::print(is_json_on_stdout ? to_json(evaluation, info) : to_text(evaluation, info) + '\n');
}

}  // namespace

int main(int argc, char** argv) {
    cli::begin_process(argc, argv);
    CLI::App app("Measures a remeshed surface and its distance to the original.", "remesh-eval");
    Arguments arguments;
    cli::start_group(app, cli::heading::files);
    cli::add_mesh_input(app, "ORIGINAL", "Mesh that was remeshed", arguments.original)->required();
    cli::add_mesh_input(app, "RESULT", "Mesh to measure", arguments.result)->required();
    cli::add_format_option(
        app, "--from",
        "Format of the one of them that is -, standard input: " + remesh::mesh_formats(),
        arguments.from);
    cli::add_file(app, "--report,--json", arguments.report,
                  "Write the figures as JSON; - writes them to stdout")
        ->type_name("FILE|-");
    cli::add_page_options(app, arguments.page);
    cli::start_group(app, cli::heading::accuracy);
    cli::add_count(app, "--samples", "Number of points to measure on each surface",
                   arguments.options.samples)
        ->default_str(std::to_string(arguments.options.samples));
    cli::start_group(app, cli::heading::running);
    app.add_option("-t,--threads", arguments.options.num_threads, "Number of threads; 0: all cores")
        ->check(CLI::Range(0, 4096).description(""))
        ->type_name("N")
        ->capture_default_str();
    app.footer(std::string(footer) + cli::exit_code_help);
    arguments.page.command = page::to_shell(argc, argv, "remesh-eval");
    return cli::run(app, argc, argv, [&] {
        const cli::CommonOptions quietly{.quiet = true};  // It has no such option.
        cli::Console console(quietly);
        console.run([&] { run_job(arguments, console); });
    });
}
