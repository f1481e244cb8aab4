// The options that `remesh` and `agvd diagram` share: how they are declared, checked and explained.
// Checks of values that CLI11 would let through (NaN, percentages, suffixes) return the text of the
// error, as CLI11's validators do.
#include "arguments.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string>

#include "help.h"
#include "mesh_paths.h"
#include "remesh/meshfile/mesh_file.h"

namespace cli {
namespace {

std::string max_error_help() {
    std::ostringstream text;
    text << "Largest error of the distances, as a share of the exact ones: 0 (exact) to below 1. "
            "Default: "
         << agvd::default_max_error << " for the window engine, no limit for the Steiner engine";
    return text.str();
}

// Checks the option; an empty text: valid.
std::string check_max_error(const std::string& text) {
    double error = 0;
    if (CLI::detail::lexical_cast(text, error) && error >= 0 && error < 1) return {};
    return "the maximal error is " + text + "; use a number from 0 (exact) to below 1";
}

// Checks the option; an empty text: valid.
std::string check_memory_limit(const std::string& text) {
    if (parse_bytes(text)) return {};
    return "the memory limit is " + text +
           "; use a number of bytes above 0 (such as 500M or 2G) or a percentage (such as 50%)";
}

// Checks the option; an empty text: valid. Others would wrap around.
std::string check_seed(const std::string& text) {
    std::uint64_t seed = 0;
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, seed);
    if (error == std::errc{} && last == end) return {};
    return "the seed is " + text + "; use a whole number from 0 to 18446744073709551615";
}

// CLI::Range lets NaN through.
std::string check_lambda(const std::string& text) {
    double lambda = 0;
    if (CLI::detail::lexical_cast(text, lambda) && lambda > 0 && std::isfinite(lambda)) return {};
    return "lambda is " + text + "; use a number above 0";
}

// Checks the option; an empty text: valid.
std::string check_samples(const std::string& text) {
    if (is_number_of_samples(text)) return {};
    return "the number of samples is " + text +
           "; use a whole number from 1 to 4294967294 (such as 2000 or 1e4), or a percentage of "
           "the input's vertices (such as 10%)";
}

std::map<std::string, remesh::Init> inits_by_name() {
    return by_name({remesh::Init::Random, remesh::Init::BlueNoise, remesh::Init::Farthest},
                   remesh::init_name);
}

void add_site_options(CLI::App& app, DiagramArguments& arguments) {
    remesh::SamplingOptions& sampling = arguments.sampling;
    const auto take_samples = [&arguments](const std::string& text) {
        const Amount amount = parse_amount(text).value();
        arguments.sample_percent = amount.is_percent ? amount.value : 0;
        if (!amount.is_percent) {
            arguments.sampling.num_samples = static_cast<agvd::Index>(amount.value);
        }
    };
    start_group(app, heading::count);
    auto* samples =
        app.add_option_function<std::string>(
               "-n,--samples,--vertices", take_samples,
               "Number of sites, or a percentage of the input's vertices; remesh makes a vertex "
               "of each")
            ->check(CLI::Validator(check_samples, ""))
            ->type_name("N|N%")
            ->default_str(std::to_string(sampling.num_samples));
    start_group(app, heading::place);
    auto* init = add_choice(
        app,
        {"--init", names_of(inits_by_name()), remesh::init_name(sampling.init),
         "How sites are placed: blue-noise (even), farthest (no large gap) or random (by "
         "area)"},
        [&sampling](const std::string& name) { sampling.init = inits_by_name().at(name); });
    app.add_option("--seed", sampling.seed,
                   "Seed of random numbers; the same seed gives the same bytes, whatever --threads")
        ->check(CLI::Validator(check_seed, ""))
        ->type_name("S")
        ->capture_default_str();
    add_file(app, "--sites", arguments.sites,
             "Sites to use instead of --samples and --init: lines `v VERTEX`, `f FACE B0 B1 B2` or "
             "`p X Y Z`")
        ->excludes(samples)
        ->excludes(init)
        ->type_name("FILE");
}

void add_max_error(CLI::App& app, const std::string& help, agvd::PropagationOptions& propagation) {
    app.add_option("--max-error", propagation.max_error, help)
        ->check(CLI::Validator(check_max_error, ""))
        ->type_name("E");
}

void add_propagation_options(CLI::App& app, agvd::PropagationOptions& propagation) {
    start_group(app, heading::geodesics);
    add_choice(
        app,
        {"--engine", names_of(engines_by_name()), agvd::engine_name(propagation.engine),
         "How distances are computed: window (quickest for every error) or steiner (as in the "
         "paper)"},
        [&propagation](const std::string& name) {
            propagation.engine = engines_by_name().at(name);
        });
    add_max_error(app, max_error_help(), propagation);
    const CLI::Option* const steiner_points =
        app.add_option("--steiner-points", propagation.steiner_points,
                       "Steiner engine: points on each edge; more points are more exact and slower")
            ->check(CLI::Range(0, 1000).description(""))
            ->type_name("M")
            ->capture_default_str();
    const CLI::Option* const lambda =
        app.add_option("--lambda", propagation.lambda,
                       "Steiner engine: triangles retire every L * #faces pops; a larger L takes "
                       "more memory")
            ->check(CLI::Validator(check_lambda, ""))
            ->type_name("L")
            ->capture_default_str();
    app.parse_complete_callback([steiner_points, lambda, &propagation] {
        if (propagation.engine == agvd::Engine::Steiner) return;
        for (const CLI::Option* option : {steiner_points, lambda}) {
            if (option->count() == 0) continue;
            throw CLI::ValidationError(
                option->get_name(),
                "only the Steiner engine has it; add --engine steiner, or leave it out");
        }
    });
}

void add_input_options(CLI::App& app, DiagramArguments& arguments) {
    start_group(app, heading::files);
    add_mesh_input(app, "IN",
                   "Mesh to read: " + mesh_extensions() + "; - reads standard input, with --from",
                   arguments.input)
        ->required();
    add_format_option(app, "--from",
                      "Format of IN where no extension names it: " + remesh::mesh_formats(),
                      arguments.from);
}

void add_running_options(CLI::App& app, DiagramArguments& arguments) {
    arguments.memory_limit = machine_memory() / 4 * 3;
    start_group(app, heading::running);
    app.add_option_function<std::string>(
           "--memory-limit",
           [&arguments](const std::string& text) {
               arguments.memory_limit = parse_bytes(text).value();
           },
           "Stop if more memory is used: bytes (also with K, M, G or T), or a percentage of the "
           "machine's memory")
        ->check(CLI::Validator(check_memory_limit, ""))
        ->type_name("BYTES")
        ->default_str("75%");
    start_group(app, heading::files);
    app.add_flag("--force", arguments.force, "Allow an output to overwrite an input");
    app.add_flag(
        "--lenient", arguments.is_lenient,
        "Read a file that does not fit its header, and warn: of more elements those announced; PLY "
        "with values left over on a line or header lines without a keyword; STL that announces 0");
    app.add_flag("--keep-slits", arguments.cleaning.keep_slits,
                 "Leave edges open that lie at one place, such as the two sides of a slit; by "
                 "default they are welded");
    add_common_options(app, arguments.common);
}

}  // namespace

std::map<std::string, agvd::Engine> engines_by_name() {
    return by_name({agvd::Engine::Window, agvd::Engine::Steiner}, agvd::engine_name);
}

CLI::Option* add_choice(CLI::App& app, const Choice& choice,
                        const std::function<void(const std::string& name)>& take) {
    return app.add_option_function<std::string>(choice.flag, take, choice.help)
        ->check(CLI::IsMember(choice.names).description(""))
        ->type_name(CLI::detail::join(choice.names, "|"))
        ->default_str(choice.default_name);
}

std::optional<Amount> parse_amount(std::string_view text) {
    Amount amount;
    amount.is_percent = text.ends_with('%');
    if (amount.is_percent) text.remove_suffix(1);
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, amount.value);
    if (error != std::errc{} || last != end) return std::nullopt;
    if (!(amount.value > 0 && std::isfinite(amount.value))) return std::nullopt;
    return amount;
}

bool is_number_of_samples(const std::string& text) {
    const std::optional<Amount> amount = parse_amount(text);
    return amount && (amount->is_percent || parse_count(text));
}

std::optional<agvd::Index> parse_count(std::string_view text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || last != end || value != std::floor(value)) return std::nullopt;
    if (!(value >= 0 && value < agvd::no_index)) return std::nullopt;
    return static_cast<agvd::Index>(value);
}

CLI::Option* add_count(CLI::App& app, const std::string& flag, const std::string& help,
                       agvd::Index& count) {
    const auto check = [](const std::string& text) {
        if (parse_count(text).value_or(0) > 0) return std::string();
        return "the number is " + text + "; use a whole number above 0, such as 2000 or 1e4";
    };
    return app
        .add_option_function<std::string>(
            flag, [&count](const std::string& text) { count = parse_count(text).value(); }, help)
        ->check(CLI::Validator(check, ""))
        ->type_name("N");
}

agvd::Index num_samples_for(const DiagramArguments& arguments, std::size_t num_vertices) {
    if (arguments.sample_percent == 0) return arguments.sampling.num_samples;
    return num_samples_for(Amount{arguments.sample_percent, true}, num_vertices);
}

agvd::Index num_samples_for(const Amount& samples, std::size_t num_vertices) {
    if (!samples.is_percent) return static_cast<agvd::Index>(samples.value);
    const double count = std::round(samples.value / 100 * static_cast<double>(num_vertices));
    if (count < agvd::no_index) return static_cast<agvd::Index>(std::max(count, 1.0));
    throw agvd::InvalidOption("the number of samples is " + std::to_string(samples.value) +
                              " % of " + std::to_string(num_vertices) +
                              " vertices, which is too many; use another percentage or a number");
}

void add_diagram_options(CLI::App& app, DiagramArguments& arguments) {
    add_input_options(app, arguments);
    add_site_options(app, arguments);
    add_propagation_options(app, arguments.propagation);
    add_running_options(app, arguments);
}

void add_query_options(CLI::App& app, DiagramArguments& arguments) {
    add_input_options(app, arguments);
    add_site_options(app, arguments);
    arguments.propagation.max_error = 0;
    start_group(app, heading::geodesics);
    add_max_error(
        app,
        "Largest error of the distances, as a share of the exact ones: 0 (exact) to below "
        "1. Default: 0",
        arguments.propagation);
    add_running_options(app, arguments);
}

MemoryLimit limit_of(const DiagramArguments& arguments) {
    return {.bytes = arguments.memory_limit, .engine = arguments.propagation.engine};
}

remesh::MeshFile read_input(const DiagramArguments& arguments, Console& console,
                            WithAttributes attributes) {
    std::error_code none;  // Reading will tell what is wrong.
    const std::uintmax_t size = std::filesystem::file_size(arguments.input, none);
    console.require_memory("read", none ? 0 : static_cast<std::size_t>(size));
    remesh::MeshFile file = remesh::read_mesh(
        arguments.input, remesh::ReadOptions{.is_lenient = arguments.is_lenient,
                                             .with_attributes = attributes == WithAttributes::Yes,
                                             .format = arguments.from,
                                             .progress = console.progress_of("read")});
    for (const std::string& warning : file.warnings) console.warn(warning);
    return file;
}

remesh::SitesFile read_given_sites(const DiagramArguments& arguments, const remesh::MeshFile& mesh,
                                   Console& console) {
    remesh::SitesFile file =
        remesh::read_sites(arguments.sites, mesh.mesh.view(), console.progress_of("read"),
                           remesh::Repeats::Told, mesh.face_polygon);
    for (const std::string& warning : file.warnings) console.warn(warning);
    return file;
}

void require_plain_points(const std::filesystem::path& path, const agvd::SitePoints& points,
                          std::size_t num_shapes, const char* what) {
    if (num_shapes > 0) {
        throw agvd::InvalidInput(path.string() + ": " + what +
                                 " points; remove the lines that begin with l or r, or use `agvd "
                                 "diagram` or `agvd distance`");
    }
    if (points.site.empty() && points.start.empty()) return;
    throw agvd::InvalidInput(path.string() + ": " + what +
                             " points without `site` and `start`; remove these words, or use "
                             "`agvd diagram` or `agvd distance`");
}

std::vector<agvd::SurfacePoint> read_points(const std::filesystem::path& path,
                                            const remesh::MeshFile& mesh, Console& console) {
    remesh::SitesFile file = remesh::read_sites(path, mesh.mesh.view(), console.progress_of("read"),
                                                remesh::Repeats::Allowed, mesh.face_polygon);
    for (const std::string& warning : file.warnings) console.warn(warning);
    require_plain_points(path, file.points, file.shapes.size(), "targets are");
    return std::move(file.sites);
}

std::string describe(const std::filesystem::path& path, const agvd::MeshView& mesh) {
    return path.string() + ": " + std::to_string(mesh.positions.size()) + " vertices, " +
           std::to_string(mesh.triangles.size()) + " faces";
}

}  // namespace cli
