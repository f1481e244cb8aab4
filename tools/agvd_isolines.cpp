// `agvd isolines` writes the lines of equal distance from the sites.
#include <CLI/CLI.hpp>
#include <memory>

#include "agvd/paths/isolines.h"
#include "help.h"
#include "query.h"
#include "report/report.h"

namespace cli {
namespace {

constexpr const char* isolines_footer =
    "Examples:\n"
    "  agvd isolines bunny.ply --sites sites.txt --every 0.01 -o lines.vtp\n"
    "  agvd isolines part.stl -n 20 --levels 1,2.5,4 --tolerance 0.01 -o lines.obj\n\n"
    "In each face a line is made of arcs of circles, and is straight in front of\n"
    "edges of lines and regions. Points of the output lie on them: at their level up\n"
    "to 1e-9 of it, if the distances are exact. A level that meets the distance of a\n"
    "vertex is raised by 2e-10 of it.\n\n"
    "Output (.gz behind the extension: compressed):\n"
    "  .vtp   VTK PolyData for ParaView: a polyline for each line, a closed one comes\n"
    "         back to its first point; cell data line (its number) and level\n"
    "  .obj   v and l lines; before each l a comment with these values\n"
    "  .ply   the vertices with these values, and faces of two vertices\n\n";

// Share of the bounding box's diagonal.
constexpr double default_tolerance = 1e-4;

struct IsolineArguments : QueryArguments {
    std::vector<double> levels;
    double step = 0;       // 0: levels.
    double tolerance = 0;  // 0: default_tolerance.
};

double diagonal_of(const agvd::MeshView& mesh) {
    Eigen::AlignedBox3d box;
    for (const agvd::Vec3& p : mesh.positions) box.extend(p);
    return box.diagonal().norm();
}

remesh::Lines to_lines(const agvd::Surface& surface, const agvd::Isolines& isolines,
                       std::span<const double> levels, double tolerance) {
    const agvd::DrawnIsolines drawn = agvd::draw_isolines(surface, isolines, tolerance);
    remesh::Lines lines;
    for (const agvd::SurfacePoint& point : drawn.points) {
        lines.points.push_back(agvd::position(surface.mesh.view(), point));
    }
    lines.offsets = drawn.offsets;
    lines.of_lines.push_back({.name = "level"});
    for (const agvd::Isoline& line : isolines.lines) {
        lines.of_lines[0].values.push_back(levels[line.level]);
    }
    return lines;
}

void run_isolines(const IsolineArguments& arguments, Console& console) {
    if (arguments.levels.empty() && arguments.step == 0) {
        throw agvd::InvalidOption("no level is asked for; add --levels L,L,... or --every D");
    }
    check_outputs(arguments, {arguments.sites}, remesh::check_lines_extension);
    console.expect(stages_with_reading(arguments.input, arguments.sampling.num_samples));
    const OpenedInput input = open_input(arguments, console, [](std::size_t num_faces) {
        return stages_of_query(num_faces, "isolines");
    });
    const agvd::SurfaceSites sites = sites_on(input, arguments, console);
    agvd::Propagation propagation = propagate_on(input, arguments, sites, {}, console);
    const std::vector<double> levels = arguments.levels.empty()
                                           ? agvd::levels_every(propagation, arguments.step)
                                           : arguments.levels;
    propagation = propagate_on(input, arguments, sites,
                               agvd::faces_at_levels(input.surface, propagation, levels), console);
    console.info(remesh::to_text(arguments.propagation.engine, propagation.certified_error));
    const agvd::Isolines isolines = agvd::build_isolines(
        input.surface, propagation, levels,
        {.num_threads = arguments.common.threads, .progress = console.progress_of("isolines")});
    const double tolerance = arguments.tolerance > 0
                                 ? arguments.tolerance
                                 : default_tolerance * diagonal_of(input.surface.mesh.view());
    write_lines(arguments, to_lines(input.surface, isolines, levels, tolerance), console);
    console.info(std::to_string(isolines.lines.size()) + " lines at " +
                 std::to_string(levels.size()) + " levels");
}

}  // namespace

Query add_isolines(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "isolines", "Write the lines of equal distance from the sites on a mesh");
    const auto arguments = std::make_shared<IsolineArguments>();
    add_query_options(*command, *arguments);
    add_barriers(*command, *arguments);
    start_group(*command, heading::count);
    const CLI::Validator length(
        [](const std::string& text) { return check_length("length", text); }, "");
    auto* const levels =
        command->add_option("--levels", arguments->levels, "Distances of the lines, in mesh units");
    levels->delimiter(',')->check(length)->type_name("L,L,...")->allow_extra_args(false);
    command
        ->add_option("--every", arguments->step,
                     "A line at each multiple of this distance, in mesh units, up to the largest "
                     "distance of a vertex")
        ->check(length)
        ->excludes(levels)
        ->type_name("D");
    start_group(*command, heading::accuracy);
    command
        ->add_option("--tolerance", arguments->tolerance,
                     "Largest distance of the polylines from the arcs, in mesh units. Default: "
                     "0.0001 of the bounding box's diagonal")
        ->check(length)
        ->type_name("D");
    add_outputs(*command, *arguments)->required();
    command->footer(std::string(isolines_footer) + exit_code_help);
    return make_query(command, arguments, run_isolines);
}

}  // namespace cli
