// `agvd compare` measures the difference of two diagrams.
#include <CLI/CLI.hpp>
#include <memory>

#include "compared_files.h"
#include "expected_stages.h"
#include "help.h"
#include "mesh_paths.h"
#include "query.h"
#include "report/report.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* compare_footer =
    "Examples:\n"
    "  agvd diagram bunny.ply -n 100 --engine steiner -o a.agvd\n"
    "  agvd compare a.agvd exact\n"
    "  agvd compare a.agvd b.agvd --report - | jq .frechet.delta\n\n"
    "Both diagrams must be of the same mesh and sites: write them with the same\n"
    "IN and --sites (or --samples, --init, --seed). `exact` builds the exact\n"
    "diagram of A's mesh and sites; a file of that name is ./exact.\n\n"
    "Figures:\n"
    "  Frechet sum  over all cells and their boundary loops, the discrete Frechet\n"
    "               distance of A's and B's loop, measured in space; loops of a\n"
    "               cell are matched nearest first, and a loop without a partner\n"
    "               counts as its diameter\n"
    "  delta        1 - exp(-F / 10^2), F being that sum in mean cell radii\n"
    "               sqrt(area / (pi sites))\n"
    "  |dA - dB|    at points of the bisectors, difference of the exact distances\n"
    "               from the two sites of the bisector\n\n";

struct CompareArguments : ComparedFiles {
    fs::path report;  // Empty: none; "-": stdout, and no text.
    CommonOptions common;
};

void run_compare(const CompareArguments& arguments, Console& console) {
    const bool is_json_on_stdout = arguments.report == "-";
    const bool is_exact = arguments.b == exact_diagram;
    if (!arguments.report.empty() && !is_json_on_stdout) {
        check_output(arguments.report, {arguments.a, is_exact ? fs::path() : arguments.b});
    }
    console.expect(stages_of_comparison(is_exact));
    const remesh::Comparison comparison =
        compare_files(arguments, arguments.common.threads,
                      [&](const char* stage) { return console.progress_of(stage); });
    const remesh::ComparisonInfo info{
        .version = REMESH_VERSION, .a = arguments.a.string(), .b = arguments.b.string()};
    if (!arguments.report.empty()) write_text(arguments.report, to_json(comparison, info));
    if (!is_json_on_stdout) print(to_text(comparison, info) + '\n');
}

}  // namespace

Query add_compare(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "compare", "Measure the difference of a diagram from another one, or from the exact one");
    const auto arguments = std::make_shared<CompareArguments>();
    start_group(*command, heading::files);
    add_file(*command, "A", arguments->a, "Diagram to measure: a .agvd file of `agvd diagram`")
        ->required();
    add_file(*command, "B", arguments->b, "Diagram to compare A with: a .agvd file, or `exact`")
        ->required();
    add_file(*command, "--report,--json", arguments->report,
             "Write the figures as JSON; - writes them to stdout")
        ->type_name("FILE|-");
    start_group(*command, heading::accuracy);
    command
        ->add_option(
            "--spacing", arguments->options.spacing,
            "Distance between points of a loop, in mean cell radii; a smaller one costs more")
        ->check(CLI::Range(1e-6, 10.0).description(""))
        ->type_name("H")
        ->capture_default_str();
    add_count(*command, "--samples", "Number of points at which cells are compared",
              arguments->options.area_samples)
        ->default_str(std::to_string(arguments->options.area_samples));
    command
        ->add_option("--points", arguments->points,
                     "Largest number of points of each diagram's bisectors at which |dA - dB| is "
                     "measured; use fewer, or 0, if the mesh has extreme slivers, as measuring "
                     "then takes long and needs gigabytes")
        ->check(CLI::Range(agvd::Index{0}, agvd::Index{1'000'000'000}).description(""))
        ->type_name("N")
        ->capture_default_str();
    add_common_options(*command, arguments->common);
    command->footer(std::string(compare_footer) + exit_code_help);
    return {command, [arguments] {
                Console console(arguments->common);
                console.run([&] { run_compare(*arguments, console); });
            }};
}

}  // namespace cli
