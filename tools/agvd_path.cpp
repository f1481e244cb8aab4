// `agvd path` writes shortest paths: from points to their nearest sites, or between pairs.
#include <CLI/CLI.hpp>
#include <memory>

#include "agvd/paths/geodesic_path.h"
#include "help.h"
#include "mesh_paths.h"
#include "query.h"
#include "report/report.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* path_footer =
    "Examples:\n"
    "  agvd path bunny.ply --sites sites.txt --targets points.txt -o paths.vtp\n"
    "  agvd path bunny.ply --pairs pairs.txt -o paths.obj -o paths.ply\n\n"
    "FILE has a point on each line: `v VERTEX`, `f FACE B0 B1 B2` or `p X Y Z`.\n"
    "Of --pairs two lines in a row are a pair. --sites may have lines, regions,\n"
    "`site N` and `start D` as for `agvd distance`: paths end at the nearest point of\n"
    "a line, or at the rim of a region. Each piece of a path lies in one face of the\n"
    "cleaned mesh.\n\n"
    "Output (.gz behind the extension: compressed):\n"
    "  .vtp   VTK PolyData for ParaView: a polyline for each path; cell data line,\n"
    "         the number of its point or pair, length and site (of --targets)\n"
    "  .obj   v and l lines; before each l a comment with these values\n"
    "  .ply   the vertices with these values, and faces of two vertices\n"
    "A point that no site reaches has no path; the numbers of others stay.\n\n";

struct PathArguments : QueryArguments {
    fs::path targets, pairs;  // One of them is empty.
};

void check(const PathArguments& arguments) {
    if (arguments.targets.empty() && arguments.pairs.empty()) {
        throw agvd::InvalidOption(
            "no path is asked for; add --targets FILE for paths to the nearest sites, or --pairs "
            "FILE");
    }
    check_outputs(arguments, {arguments.sites, arguments.targets, arguments.pairs},
                  remesh::check_lines_extension);
}

std::vector<agvd::SitePath> paths_to_sites(const PathArguments& arguments, const OpenedInput& input,
                                           Console& console) {
    const agvd::SurfaceSites sites = sites_on(input, arguments, console);
    const std::vector<agvd::SurfacePoint> targets = points_on(input, arguments.targets, console);
    const agvd::Propagation propagation =
        propagate_on(input, arguments, sites, agvd::all_faces(input.surface), console);
    console.info(remesh::to_text(arguments.propagation.engine, propagation.certified_error));
    return agvd::paths_to_sites(
        input.surface, sites.points, propagation, targets,
        {.num_threads = arguments.common.threads, .progress = console.progress_of("paths")});
}

// \throw agvd::InvalidInput  a point has no partner.
std::vector<agvd::GeodesicPath> paths_of_pairs(const PathArguments& arguments,
                                               const OpenedInput& input, Console& console) {
    const std::vector<agvd::SurfacePoint> points = points_on(input, arguments.pairs, console);
    if (points.size() % 2 != 0) {
        throw agvd::InvalidInput(arguments.pairs.string() + ": the last of " +
                                 std::to_string(points.size()) +
                                 " points has no partner; write two lines for each pair");
    }
    std::vector<agvd::PointPair> pairs;
    for (std::size_t i = 0; i < points.size(); i += 2) {
        pairs.push_back({points[i], points[i + 1]});
    }
    return naming_file(arguments.pairs, [&] {
        return agvd::shortest_paths(input.surface, pairs,
                                    {.max_error = arguments.propagation.max_error.value_or(0),
                                     .num_threads = arguments.common.threads,
                                     .progress = console.progress_of("paths")});
    });
}

void append(const agvd::Surface& surface, const agvd::GeodesicPath& path, remesh::Lines& lines) {
    for (const agvd::SurfacePoint& point : path.points) {
        lines.points.push_back(agvd::position(surface.mesh.view(), point));
    }
    lines.offsets.push_back(static_cast<agvd::Index>(lines.points.size()));
    lines.of_lines[0].values.push_back(path.length);
}

void run_path(const PathArguments& arguments, Console& console) {
    check(arguments);
    console.expect(stages_with_reading(arguments.input, arguments.sampling.num_samples));
    const OpenedInput input = open_input(arguments, console, [](std::size_t num_faces) {
        return stages_of_query(num_faces, "paths");
    });
    remesh::Lines lines;
    lines.of_lines.push_back({.name = "length"});
    std::size_t num_unreached = 0;
    if (arguments.pairs.empty()) {
        lines.of_lines.push_back({.name = "site", .type = remesh::NumberType::Int32});
        for (const agvd::SitePath& to_site : paths_to_sites(arguments, input, console)) {
            append(input.surface, to_site.path, lines);
            const bool is_reached = to_site.site.is_valid();
            lines.of_lines[1].values.push_back(is_reached ? to_site.site.value() : -1.0);
            num_unreached += is_reached ? 0 : 1;
        }
    } else {
        for (const agvd::GeodesicPath& path : paths_of_pairs(arguments, input, console)) {
            append(input.surface, path, lines);
        }
    }
    write_lines(arguments, lines, console);
    if (num_unreached > 0) {
        console.warn("no site reaches " + std::to_string(num_unreached) +
                     " targets; place a site on every component");
    }
    console.info(std::to_string(lines.offsets.size() - 1) + " paths");
}

}  // namespace

Query add_path(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "path", "Write the shortest paths from points to their sites, or between pairs of points");
    const auto arguments = std::make_shared<PathArguments>();
    add_query_options(*command, *arguments);
    add_barriers(*command, *arguments);
    start_group(*command, heading::place);
    auto* const targets = add_file(*command, "--targets", arguments->targets,
                                   "Points from which paths lead to the nearest site");
    targets->type_name("FILE");
    add_file(*command, "--pairs", arguments->pairs, "Points of which two in a row are a pair")
        ->excludes(targets)
        ->excludes(command->get_option("--sites"))
        ->excludes(command->get_option("--samples"))
        ->type_name("FILE");
    add_outputs(*command, *arguments)->required();
    command->footer(std::string(path_footer) + exit_code_help);
    return make_query(command, arguments, run_path);
}

}  // namespace cli
