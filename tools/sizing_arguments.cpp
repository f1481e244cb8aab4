#include "sizing_arguments.h"

#include <CLI/CLI.hpp>

#include "agvd/mesh/scale.h"
#include "help.h"
#include "remesh/io/transfer_attributes.h"

namespace cli {
namespace {

// Checks the option; an empty text: valid.
std::string check_length(const std::string& text) {
    if (parse_amount(text)) return {};
    return "the length is " + text +
           "; use a number above 0, or a percentage of the diagonal of the mesh (such as 2%)";
}

// Checks the option; an empty text: valid.
std::string check_faces(const std::string& text) {
    const std::optional<Amount> amount = parse_amount(text);
    if (amount && !amount->is_percent && amount->value >= 1 && amount->value < agvd::no_index) {
        return {};
    }
    return "the number of faces is " + text + "; use a whole number of 1 or more";
}

std::string check_gradation(const std::string& text) {
    const std::optional<Amount> amount = parse_amount(text);
    if (amount && !amount->is_percent && amount->value >= 1) return {};
    return "the gradation is " + text + "; use a number of 1 or more (such as 1.3)";
}

CLI::Option* add_length(CLI::App& app, const std::string& flag, const std::string& help,
                        std::optional<Amount>& length) {
    return app
        .add_option_function<std::string>(
            flag, [&length](const std::string& text) { length = parse_amount(text); }, help)
        ->check(CLI::Validator(check_length, ""))
        ->type_name("L|L%");
}

}  // namespace

void add_sizing_options(CLI::App& app, SizingArguments& arguments) {
    start_group(app, heading::count);
    remesh::Sizing& sizing = arguments.sizing;
    CLI::Option* const samples = app.get_option("--samples");
    CLI::Option* const sites = app.get_option("--sites");
    arguments.samples = samples;
    const auto take_faces = [&sizing](const std::string& text) {
        sizing.num_faces = static_cast<agvd::Index>(parse_amount(text).value().value);
    };
    CLI::Option* const faces =
        app.add_option_function<std::string>("--faces", take_faces,
                                             "Number of faces of the result, instead of --samples")
            ->check(CLI::Validator(check_faces, ""))
            ->type_name("N")
            ->excludes(samples)
            ->excludes(sites);
    CLI::Option* const edge =
        add_length(app, "--edge-length,--hsiz",
                   "Mean edge of the result, in mesh units or percent of the diagonal, instead of "
                   "--samples",
                   arguments.edge)
            ->excludes(samples)
            ->excludes(sites)
            ->excludes(faces);
    CLI::Option* const distance = add_length(
        app, "--max-distance,--hausd",
        "Largest distance between result and input, in mesh units or percent of the "
        "diagonal, instead of --samples; edges are adaptive, and the exit code is 5 if it "
        "cannot be met",
        arguments.max_distance);
    distance->excludes(samples)->excludes(sites)->excludes(faces)->excludes(edge);
    start_group(app, heading::place);
    CLI::Option* const adaptive =
        app.add_flag("--adaptive", sizing.is_adaptive,
                     "Shorter edges where the surface is curved, longer ones elsewhere");
    CLI::Option* const lengths =
        app.add_option("--sizing", arguments.target_lengths,
                       "Vertex property of IN (PLY) that gives the length of the edges there; with "
                       "--samples or the like only relative to each other")
            ->type_name("NAME")
            ->excludes(adaptive)
            ->excludes(distance);
    app.add_option("--density", arguments.densities,
                   "Vertex property of IN (PLY) that gives vertices per area, in any unit")
        ->type_name("NAME")
        ->excludes(adaptive)
        ->excludes(distance)
        ->excludes(lengths);
    add_length(app, "--min-edge,--hmin", "No edge is meant to be shorter", arguments.min_edge);
    add_length(app, "--max-edge,--hmax", "No edge is meant to be longer", arguments.max_edge);
    const auto take_gradation = [&arguments](const std::string& text) {
        arguments.sizing.gradation = parse_amount(text).value().value;
        arguments.has_gradation = true;
    };
    app.add_option_function<std::string>(
           "--gradation,--hgrad", take_gradation,
           "Largest ratio of edges next to each other; more precisely, over a distance "
           "d edges grow by at most d times its logarithm")
        ->check(CLI::Validator(check_gradation, ""))
        ->type_name("G")
        ->default_str("1.3");
}

bool has_count(const SizingArguments& arguments) {
    return arguments.samples->count() > 0 || arguments.edge || arguments.max_distance ||
           arguments.sizing.num_faces > 0;
}

bool wants_attributes(const SizingArguments& arguments) {
    return !arguments.target_lengths.empty() || !arguments.densities.empty();
}

remesh::Sizing sizing_for(const SizingArguments& arguments, const std::filesystem::path& path,
                          const remesh::MeshFile& mesh) {
    remesh::Sizing sizing = arguments.sizing;
    const auto values_of = [&](const std::string& name) {
        if (name.empty()) return std::vector<double>();
        return remesh::require_attribute(mesh.attributes.of_vertices, name,
                                         path.string() + " has no vertex property")
            .values;
    };
    const bool is_even = !sizing.is_adaptive && !arguments.max_distance &&
                         arguments.target_lengths.empty() && arguments.densities.empty();
    if (is_even && (arguments.min_edge || arguments.max_edge || arguments.has_gradation)) {
        throw agvd::InvalidOption(
            "--min-edge, --max-edge and --gradation bound edges that differ; add --adaptive, "
            "--max-distance, --sizing or --density, or leave them out");
    }
    sizing.target_lengths = values_of(arguments.target_lengths);
    sizing.densities = values_of(arguments.densities);
    sizing.gives_count = !sizing.target_lengths.empty() && !has_count(arguments);
    const auto [low, high] = agvd::box_of(mesh.mesh.view());
    const double percent = low.x() > high.x() ? 0 : (high - low).norm() / 100;
    const auto take = [&](const std::optional<Amount>& amount, double& length) {
        if (amount) length = amount->value * (amount->is_percent ? percent : 1);
    };
    take(arguments.edge, sizing.edge_length);
    take(arguments.max_distance, sizing.max_distance);
    take(arguments.min_edge, sizing.min_edge);
    take(arguments.max_edge, sizing.max_edge);
    return sizing;
}

}  // namespace cli
