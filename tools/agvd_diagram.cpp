// `agvd diagram` writes geodesic Voronoi diagrams to files. They are drawn on the cleaned input.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "based_diagram.h"
#include "diagram_lines.h"
#include "help.h"
#include "query.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/sites/prepared_surface.h"
#include "report/report.h"
#include "shortfalls.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* diagram_footer =
    "Examples:\n"
    "  agvd diagram bunny.ply -n 100 -o cells.vtp -o labels.ply\n"
    "  agvd diagram bunny.ply --sites sites.txt -o edges.obj\n"
    "  agvd diagram part.stl -n 20 --tolerance 0.001 --arcs arcs.vtp\n\n"
    "Output (.gz behind the extension: compressed):\n"
    "  .vtp   VTK PolyData for ParaView: the cleaned mesh, the Voronoi edges and\n"
    "         boundary arcs as polylines, the sites as vertices; point data site and\n"
    "         distance, cell data site_left and site_right of the polylines\n"
    "  .ply   the cleaned mesh with the vertex properties site (-1: no site) and\n"
    "         distance\n"
    "  .obj   the polylines as v and l lines\n"
    "  .agvd  everything, exactly: what `agvd compare` reads\n\n"
    "In each face a bisector is made of arcs of hyperbolas, or straight. The points\n"
    "of the polylines lie on the arcs. --arcs writes them one by one:\n"
    "  .vtp, .obj, .ply   a polyline for each arc, as `agvd isolines` writes them;\n"
    "         edge (the number of its Voronoi edge), site_left, site_right, face,\n"
    "         kind (0: straight, 1: hyperbola, 2: straight for want of a better one,\n"
    "         where distances with errors contradict each other), focus_left_x, _y,\n"
    "         _z, weight_left, and the same on the right: |p - focus| + weight is the\n"
    "         distance of its points p from both sites. The foci lie in the plane of\n"
    "         the face\n\n";

struct DiagramOutputs : QueryArguments {
    double tolerance = 0;  // 0: only the diagram's own measure.
    fs::path arcs;         // Empty: none.
};

// All that are asked for.
std::vector<remesh::FileContent> format_files(const DiagramOutputs& arguments,
                                              const agvd::Surface& surface,
                                              std::span<const agvd::SurfacePoint> sites,
                                              const agvd::Diagram& diagram,
                                              const agvd::Progress& writing) {
    std::vector<remesh::FileContent> files;
    for (const fs::path& output : arguments.outputs) {
        files.push_back({output, remesh::format_diagram(output, surface, sites, diagram, writing)});
    }
    if (!arguments.arcs.empty()) {
        files.push_back(
            {arguments.arcs,
             remesh::format_lines(arguments.arcs, arc_lines(surface, diagram), writing)});
    }
    return files;
}

void check_all_outputs(const DiagramOutputs& arguments) {
    check_outputs(arguments, {arguments.sites}, remesh::check_diagram_extension);
    std::vector<fs::path> all = arguments.outputs;
    if (!arguments.arcs.empty()) {
        remesh::check_lines_extension(arguments.arcs);
        check_output(arguments.arcs, {arguments.input}, arguments.force);
        check_output(arguments.arcs, {arguments.sites}, arguments.force);
        all.push_back(arguments.arcs);
    }
    if (all.empty()) {
        throw agvd::InvalidOption("no output is named; add -o FILE, or --arcs FILE");
    }
    check_distinct(all);
}

bool wants_arcs(const DiagramOutputs& arguments) {
    const auto is_whole = [](const fs::path& path) { return remesh::is_whole_diagram(path); };
    return arguments.tolerance > 0 || !arguments.arcs.empty() ||
           std::any_of(arguments.outputs.begin(), arguments.outputs.end(), is_whole);
}

void run_diagram(const DiagramOutputs& arguments, Console& console) {
    check_all_outputs(arguments);
    console.expect(stages_with_reading(arguments.input, arguments.sampling.num_samples));
    const OpenedInput input = open_input(arguments, console, [&](std::size_t num_faces) {
        return stages_of_diagram(num_faces, arguments.sampling.num_samples);
    });
    const remesh::CleanResult& clean = input.clean;
    const agvd::Surface& surface = input.surface;
    const std::vector<agvd::SurfacePoint> sites = sites_on(input, arguments, console);
    const double spacing = remesh::mean_spacing(surface, sites.size());
    if (clean.slit_length > spacing) console.warn(welded_slit_text(clean.slit_length));
    agvd::PropagationOptions propagating = arguments.propagation;
    propagating.num_threads = arguments.common.threads;
    const agvd::DiagramOptions drawing{
        .with_arcs = wants_arcs(arguments),
        .tolerance = arguments.tolerance > 0 ? arguments.tolerance : agvd::infinity};
    const auto [diagram, certified_error] = naming_file(
        arguments.input,
        [&] {
            return based_diagram(surface, sites, propagating, drawing,
                                 [&](const char* stage) { return console.progress_of(stage); });
        },
        arguments.sites);

    const agvd::Progress writing = console.progress_of("write");
    remesh::write_files_atomically(format_files(arguments, surface, sites, diagram, writing),
                                   writing);
    const auto unreached = std::count_if(diagram.nearest_site.begin(), diagram.nearest_site.end(),
                                         [](agvd::SiteId site) { return !site.is_valid(); });
    if (unreached > 0) {
        console.warn("no site reaches " + std::to_string(unreached) +
                     " vertices; place a site on every component");
    }
    console.info(remesh::to_text(propagating.engine, certified_error));
    console.info(std::to_string(sites.size()) + " sites, " +
                 std::to_string(diagram.vertices.size()) + " Voronoi vertices, " +
                 std::to_string(diagram.edges.size()) + " Voronoi edges");
}

}  // namespace

Query add_diagram(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "diagram", "Compute the diagram of sites on a mesh and write it to files");
    const auto arguments = std::make_shared<DiagramOutputs>();
    add_diagram_options(*command, *arguments);
    start_group(*command, heading::accuracy);
    add_tolerance(*command, arguments->tolerance, "0.01 of each arc's chord, which always holds");
    add_outputs(*command, arguments->outputs)->required(false);
    command
        ->add_option("--arcs", arguments->arcs,
                     "File to write the arcs of the bisectors to, with their foci")
        ->type_name("FILE");
    command->footer(std::string(diagram_footer) + exit_code_help);
    return make_query(command, arguments, run_diagram);
}

}  // namespace cli
