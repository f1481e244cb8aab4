#include "sizing_arguments.h"

#include <CLI/CLI.hpp>

#include "agvd/mesh/scale.h"
#include "help.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/solution_file.h"
#include "remesh/transfer/transfer.h"

namespace cli {
namespace {

// Checks the option; an empty text: valid.
std::string check_length(const std::string& text) {
    if (parse_amount(text)) return {};
    return "the length is " + text +
           "; use a number above 0, or a percentage of the diagonal of the mesh (such as 2%)";
}

std::string check_gradation(const std::string& text) {
    const std::optional<Amount> amount = parse_amount(text);
    if (amount && !amount->is_percent && amount->value >= 1) return {};
    return "the gradation is " + text + "; use a number of 1 or more (such as 1.3)";
}

// The last colon ends the value, which may have others.
std::optional<LabelLength> parse_label_length(const std::string& text) {
    const std::size_t equals = text.find('='), colon = text.rfind(':');
    if (equals == 0 || equals == std::string::npos || colon == std::string::npos) return {};
    if (colon <= equals + 1) return {};
    const std::optional<Amount> length = parse_amount(text.substr(colon + 1));
    if (!length) return {};
    return LabelLength{text.substr(0, equals), text.substr(equals + 1, colon - equals - 1),
                       *length};
}

// Checks the option; an empty text: valid.
std::string check_label_length(const std::string& text) {
    if (parse_label_length(text)) return {};
    return "the value is " + text +
           "; use NAME=VALUE:LENGTH, the length above 0 or a percentage of the diagonal of the "
           "mesh (such as material=steel:2%)";
}

// FILE:L or FILE:L:R. The file's name may have colons.
std::optional<PlaceLength> parse_place(const std::string& text) {
    const std::size_t last = text.rfind(':');
    if (last == 0 || last == std::string::npos) return {};
    const std::optional<Amount> end = parse_amount(text.substr(last + 1));
    if (!end) return {};
    const std::size_t before = text.rfind(':', last - 1);
    if (before != 0 && before != std::string::npos) {
        const auto length = parse_amount(text.substr(before + 1, last - before - 1));
        if (length) return PlaceLength{text.substr(0, before), *length, end};
    }
    return PlaceLength{text.substr(0, last), *end, {}};
}

// Checks the option; an empty text: valid.
std::string check_place(const std::string& text) {
    if (parse_place(text)) return {};
    return "the value is " + text +
           "; use FILE:LENGTH or FILE:LENGTH:RADIUS, both above 0 or a percentage of the diagonal "
           "of the mesh (such as ears.txt:0.5%:3%)";
}

constexpr const char* other_faces = "*";

// The number of a label by its name, or by its number where labels have no names.
// \param mesh  for errors.
double number_of_label(const remesh::Attribute& labels, const std::string& value,
                       const std::string& mesh) {
    const auto name = std::find(labels.names.begin(), labels.names.end(), value);
    if (name != labels.names.end()) return static_cast<double>(name - labels.names.begin());
    double number = 0;
    const auto& values = labels.values;
    if (labels.names.empty() && CLI::detail::lexical_cast(value, number) &&
        std::find(values.begin(), values.end(), number) != values.end()) {
        return number;
    }
    std::vector<std::string> names = labels.names;
    std::erase(names, "");
    throw agvd::InvalidOption(
        "--edge-length-of: no face of " + mesh + " has " + labels.name + " '" + value + "'; use " +
        (names.empty() ? "a value of this property" : CLI::detail::join(names, ", ")));
}

// For each face. Of several labels of a face the last one given counts.
template <typename InMeshUnits>
std::vector<double> lengths_by_label(const SizingArguments& arguments,
                                     const std::filesystem::path& path,
                                     const remesh::MeshFile& mesh,
                                     const InMeshUnits& in_mesh_units) {
    std::vector<double> lengths(mesh.mesh.triangles.size(), 0);
    double rest = arguments.edge ? in_mesh_units(*arguments.edge) : 0;
    for (const LabelLength& label : arguments.label_lengths) {
        const double length = in_mesh_units(label.length);
        const remesh::Attribute& labels = remesh::require_attribute(
            mesh.attributes.of_faces, label.name,
            "--edge-length-of: " + path.string() + " has no face property");
        if (label.value == other_faces) {
            rest = length;
            continue;
        }
        const double wanted = number_of_label(labels, label.value, path.string());
        for (std::size_t f = 0; f < lengths.size(); ++f) {
            if (labels.values[f] == wanted) lengths[f] = length;
        }
    }
    for (double& length : lengths) {
        if (length > 0) continue;
        if (rest > 0) {
            length = rest;
            continue;
        }
        throw agvd::InvalidOption("--edge-length-of: face " +
                                  std::to_string(&length - lengths.data()) + " of " +
                                  path.string() +
                                  " has none of these labels; give the length of all other faces "
                                  "by --edge-length, or by the value *");
    }
    return lengths;
}

bool has_file_of_lengths(const SizingArguments& arguments) {
    return remesh::is_solution_file(arguments.target_lengths);
}

}  // namespace

CLI::Option* add_length(CLI::App& app, const std::string& flag, const std::string& help,
                        std::optional<Amount>& length) {
    return app
        .add_option_function<std::string>(
            flag, [&length](const std::string& text) { length = parse_amount(text); }, help)
        ->check(CLI::Validator(check_length, ""))
        ->type_name("L|L%");
}

double length_of(const Amount& length, const agvd::MeshView& mesh) {
    if (!length.is_percent) return length.value;
    const auto [low, high] = agvd::box_of(mesh);
    return low.x() > high.x() ? 0 : length.value * (high - low).norm() / 100;
}

void add_sizing_options(CLI::App& app, SizingArguments& arguments) {
    start_group(app, heading::count);
    CLI::Option* const samples = app.get_option("--samples");
    CLI::Option* const sites = app.get_option("--sites");
    arguments.samples = samples;
    CLI::Option* const faces =
        add_count(app, "--faces", "Number of faces of the result, instead of --samples",
                  arguments.num_faces)
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
        app.add_flag("--adaptive", arguments.is_adaptive,
                     "Shorter edges where the surface is curved, longer ones elsewhere");
    CLI::Option* const lengths = app.add_option("--sizing", arguments.target_lengths,
                                                "Vertex property of IN, such as of PLY or VTK, "
                                                "that gives the length of the edges there, or a "
                                                "file of Medit with one number for each vertex of "
                                                "IN; with --samples or the like only relative to "
                                                "each other")
                                     ->type_name("NAME|FILE.sol")
                                     ->excludes(adaptive)
                                     ->excludes(distance);
    CLI::Option* const densities = app.add_option("--density", arguments.densities,
                                                  "Vertex property of IN, such as of PLY or VTK, "
                                                  "that gives vertices per area, in any unit")
                                       ->type_name("NAME")
                                       ->excludes(adaptive)
                                       ->excludes(distance)
                                       ->excludes(lengths);
    const auto take_labels = [&arguments](const std::vector<std::string>& texts) {
        for (const std::string& text : texts)
            arguments.label_lengths.push_back(parse_label_length(text).value());
    };
    app.add_option_function<std::vector<std::string>>(
           "--edge-length-of", take_labels,
           "Length of the edges on faces with this label, such as material=steel:2%; VALUE *: on "
           "all faces that no other names; --edge-length: likewise. Repeat it for more labels. "
           "With "
           "--samples or --faces lengths count only relative to each other")
        ->check(CLI::Validator(check_label_length, ""))
        ->type_name("NAME=VALUE:L|L%")
        ->allow_extra_args(false)
        ->excludes(adaptive)
        ->excludes(distance)
        ->excludes(lengths)
        ->excludes(densities);
    const auto take_places = [&arguments](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) arguments.places.push_back(parse_place(text).value());
    };
    app.add_option_function<std::vector<std::string>>(
           "--size-at", take_places,
           "Length L of the edges at the points, lines or faces that this file names as --sites "
           "does, and up to the distance R around them; from there edges grow by --gradation "
           "along the surface. Repeat it for more files")
        ->check(CLI::Validator(check_place, ""))
        ->type_name("FILE:L|L%[:R|R%]")
        ->allow_extra_args(false);
    add_length(app, "--min-edge,--hmin", "No edge is meant to be shorter", arguments.min_edge);
    add_length(app, "--max-edge,--hmax", "No edge is meant to be longer", arguments.max_edge);
    const auto take_gradation = [&arguments](const std::string& text) {
        arguments.gradation = parse_amount(text).value().value;
    };
    app.add_option_function<std::string>(
           "--gradation,--hgrad", take_gradation,
           "Largest ratio of edges next to each other; more precisely, over a distance "
           "d edges grow by at most d times its logarithm")
        ->check(CLI::Validator(check_gradation, ""))
        ->type_name("G")
        ->default_str("1.3");
    start_group(app, heading::promises);
    app.add_option("--min-angle", arguments.min_angle,
                   "No angle of a triangle is smaller, but for those that creases or corners of "
                   "the input force, which are told; exit code 5 if that cannot be")
        ->check(CLI::Range(0.0, 30.0).description(""))
        ->type_name("DEG")
        ->capture_default_str();
    app.add_option("--max-angle", arguments.max_angle, "No angle is larger, but for the same ones")
        ->check(CLI::Range(90.0, 180.0).description(""))
        ->type_name("DEG")
        ->capture_default_str();
    add_length(app, "--longest-edge",
               "No edge is longer; the result has as many more vertices as that takes",
               arguments.longest_edge);
}

bool has_count(const SizingArguments& arguments) {
    const bool has_mean_edge = arguments.edge && arguments.label_lengths.empty();
    return arguments.samples->count() > 0 || has_mean_edge || arguments.max_distance ||
           arguments.num_faces > 0;
}

bool wants_attributes(const SizingArguments& arguments) {
    const bool has_name = !arguments.target_lengths.empty() && !has_file_of_lengths(arguments);
    return has_name || !arguments.densities.empty() || !arguments.label_lengths.empty();
}

remesh::Sizing sizing_for(const SizingArguments& arguments, const std::filesystem::path& path,
                          const remesh::MeshFile& mesh, const agvd::Progress& progress) {
    const auto values_of = [&](const char* option, const std::string& name) {
        return remesh::require_attribute(mesh.attributes.of_vertices, name,
                                         option + path.string() + " has no vertex property")
            .values;
    };
    const bool is_even = !arguments.is_adaptive && !arguments.max_distance &&
                         arguments.target_lengths.empty() && arguments.places.empty() &&
                         !wants_attributes(arguments);
    if (is_even && (arguments.min_edge || arguments.max_edge || arguments.gradation)) {
        throw agvd::InvalidOption(
            "--min-edge, --max-edge and --gradation bound edges that differ; add --adaptive, "
            "--max-distance, --sizing, --size-at, --edge-length-of or --density, or leave them "
            "out");
    }
    const auto in_mesh_units = [&](const Amount& amount) {
        return length_of(amount, mesh.mesh.view());
    };
    remesh::Sizing sizing;
    sizing.gradation = arguments.gradation.value_or(sizing.gradation);
    if (arguments.min_edge) sizing.min_edge = in_mesh_units(*arguments.min_edge);
    if (arguments.max_edge) sizing.max_edge = in_mesh_units(*arguments.max_edge);
    const bool is_by_label = !arguments.label_lengths.empty();
    if (arguments.is_adaptive) {
        sizing.edges = remesh::AdaptiveEdges{};
    } else if (is_by_label) {
        sizing.edges = remesh::FaceLengths{lengths_by_label(arguments, path, mesh, in_mesh_units)};
    } else if (has_file_of_lengths(arguments)) {
        sizing.edges = remesh::VertexLengths{
            remesh::read_lengths(arguments.target_lengths, mesh.mesh.positions.size(), progress)};
    } else if (!arguments.target_lengths.empty()) {
        sizing.edges = remesh::VertexLengths{values_of("--sizing: ", arguments.target_lengths)};
    } else if (!arguments.densities.empty()) {
        sizing.edges = remesh::VertexDensities{values_of("--density: ", arguments.densities)};
    }
    for (const PlaceLength& place : arguments.places) {
        remesh::SitesFile file = remesh::read_sites(place.file, mesh.mesh.view(), progress,
                                                    remesh::Repeats::Allowed, mesh.face_polygon);
        remesh::SizedPlace made{.points = std::move(file.sites),
                                .length = in_mesh_units(place.length),
                                .radius = place.radius ? in_mesh_units(*place.radius) : 0};
        for (const remesh::GivenShape& shape : file.shapes) {
            made.edges.insert(made.edges.end(), shape.edges.begin(), shape.edges.end());
            made.faces.insert(made.faces.end(), shape.faces.begin(), shape.faces.end());
        }
        if (made.length > 0) sizing.places.push_back(std::move(made));
    }
    // Of a mesh without extent a percentage is 0, and no length is asked for.
    const auto take = [&](const std::optional<Amount>& amount, auto count) {
        const double length = amount ? in_mesh_units(*amount) : 0;
        if (length > 0) sizing.count = decltype(count){length};
    };
    if (arguments.num_faces > 0) sizing.count = remesh::NumFaces{arguments.num_faces};
    if (!is_by_label) take(arguments.edge, remesh::MeanEdge{});
    take(arguments.max_distance, remesh::MaxDistance{});
    if (!has_count(arguments) && (is_by_label || !arguments.target_lengths.empty())) {
        sizing.count = remesh::CountOfLengths{};
    }
    return sizing;
}

remesh::ShapeBounds bounds_for(const SizingArguments& arguments, const agvd::MeshView& mesh) {
    remesh::ShapeBounds bounds{.min_angle = arguments.min_angle, .max_angle = arguments.max_angle};
    const double length = arguments.longest_edge ? length_of(*arguments.longest_edge, mesh) : 0;
    if (length > 0) bounds.longest_edge = length;
    return bounds;
}

}  // namespace cli
