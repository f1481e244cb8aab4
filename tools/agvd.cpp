// `agvd diagram` writes geodesic Voronoi diagrams to files, `agvd compare` measures their
// difference. The queries are files of their own: agvd_path.cpp, ... Diagrams are drawn on the
// cleaned input.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "agvd/diagram/cut_cells.h"
#include "arguments.h"
#include "based_diagram.h"
#include "diagram_for_page.h"
#include "expected_stages.h"
#include "help.h"
#include "mesh_paths.h"
#include "page/viewer.h"
#include "page_outputs.h"
#include "paper/compare_diagrams.h"
#include "query.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/sites/prepared_surface.h"
#include "report/report.h"
#include "shortfalls.h"

namespace fs = std::filesystem;

namespace {

cli::BasedDiagram build(const agvd::Surface& surface, const std::vector<agvd::SurfacePoint>& sites,
                        const agvd::PropagationOptions& options, cli::Console& console,
                        std::optional<double> chord = {}) {
    return cli::based_diagram(
        surface, sites, options, [&](const char* stage) { return console.progress_of(stage); },
        chord);
}

constexpr const char* diagram_footer =
    "Examples:\n"
    "  agvd diagram bunny.ply -n 100 -o cells.vtp -o labels.ply\n"
    "  agvd diagram bunny.ply --sites sites.txt -o edges.obj\n"
    "  agvd diagram bunny.ply -n 100 --html cells.html\n"
    "  agvd diagram bunny.ply -n 100 -o cells.vtp --cells cut.ply\n"
    "  agvd diagram bunny.ply -n 100 --max-error 0 --chord 1e-5 -o arcs.vtp\n\n"
    "Behind a point of --sites may stand `site N`, the number of the site that it\n"
    "belongs to (several points may; on all lines or on none), and `start D`, a\n"
    "distance that counts from there on: an additive weight. A line of the file that\n"
    "reads `l VERTEX VERTEX ...` is a site along edges of the mesh, `r FACE FACE ...`\n"
    "a region of faces, with distance 0 inside.\n\n"
    "Output (.gz behind the extension: compressed):\n"
    "  .vtp   VTK PolyData for ParaView: the cleaned mesh, the Voronoi edges and\n"
    "         boundary arcs as polylines, the sites as vertices; point data site and\n"
    "         distance, cell data site_left and site_right of the polylines\n"
    "  .ply   the cleaned mesh with the vertex properties site (-1: no site) and\n"
    "         distance\n"
    "  .obj   the polylines as v and l lines\n"
    "  .agvd  everything, exactly: what `agvd compare` reads\n\n"
    "With --chord a bisector is made of arcs, each with one kind in one face: the\n"
    "points p with |p - focus_left| + weight_left = |p - focus_right| +\n"
    "weight_right, their distance from both sites. In .vtp each arc is a polyline\n"
    "with the cell data edge, kind (0: line, 1: hyperbola, 2: chord without foci),\n"
    "foci and weights; .ply and .agvd have an element arc.\n\n";

// Names the first sites that own nothing: others are nearer everywhere.
void warn_of_empty_cells(const agvd::Diagram& diagram, cli::Console& console) {
    constexpr std::size_t most_named = 10;
    std::string names;
    std::size_t count = 0;
    for (std::size_t s = 0; s < diagram.num_sites; ++s) {
        if (diagram.cell_area[s] != 0 || diagram.cell_euler[s] != 0) continue;
        if (++count <= most_named) names += (count == 1 ? " " : ", ") + std::to_string(s);
    }
    if (count == 0) return;
    console.warn((count == 1 ? "a site owns" : std::to_string(count) + " sites own") +
                 " nothing, as others are nearer everywhere:" + names +
                 (count > most_named ? ", ..." : ""));
}

// A file for `agvd compare`.
bool is_diagram_file(const fs::path& output) {
    const fs::path name = output.extension() == ".gz" ? output.stem() : output;
    return name.extension() == ".agvd";
}

// It has no room for lengths.
void check_has_positions(const cli::QueryArguments& arguments) {
    if (arguments.edge_lengths.empty()) return;
    for (const fs::path& output : arguments.outputs) {
        if (!is_diagram_file(output)) continue;
        throw agvd::InvalidOption(output.string() +
                                  ": a .agvd file has positions only; with --edge-lengths write "
                                  ".vtp, .ply or .obj");
    }
}

// Nor for sites that are no points.
void check_has_points_only(const cli::QueryArguments& arguments,
                           const std::vector<agvd::SiteShape>& shapes) {
    if (shapes.empty()) return;
    for (const fs::path& output : arguments.outputs) {
        if (!is_diagram_file(output)) continue;
        throw agvd::InvalidOption(output.string() +
                                  ": a .agvd file has points as sites; with lines or regions write "
                                  ".vtp, .ply or .obj");
    }
}

struct DiagramRun : cli::QueryArguments {
    fs::path cells;  // The cut mesh; empty: none.
    fs::path html;   // Empty: none.
    std::optional<double> chord;
    std::string command;  // The command line: see page::to_shell.
};

void check_page(const DiagramRun& arguments) {
    if (arguments.html.empty()) {
        if (!arguments.outputs.empty() || !arguments.cells.empty()) return;
        throw agvd::InvalidOption(
            "no output is asked for; add -o FILE, --cells FILE or --html FILE");
    }
    cli::check_page_option("--html", arguments.html);
    page::require_viewer("--html");
    cli::check_output(
        arguments.html,
        {arguments.input, arguments.sites, arguments.barriers, arguments.edge_lengths},
        arguments.force);
    std::vector<fs::path> others = arguments.outputs;
    if (!arguments.cells.empty()) others.push_back(arguments.cells);
    for (const fs::path& other : others) {
        if (!cli::is_same_file(other, arguments.html)) continue;
        throw agvd::InvalidOption(other.string() +
                                  " is named for two outputs; choose another file");
    }
}

void check_cells(const DiagramRun& arguments) {
    if (arguments.cells.empty()) return;
    const fs::path& output = arguments.cells;
    const fs::path name = output.extension() == ".gz" ? output.stem() : output;
    const std::array known{".ply", ".vtp", ".vtk"};
    if (std::find(known.begin(), known.end(), name.extension()) == known.end()) {
        throw agvd::IoError(output.string() +
                            ": cells are written to meshes with properties of faces; use .ply, "
                            ".vtp or .vtk");
    }
    cli::check_output(
        output, {arguments.input, arguments.sites, arguments.barriers, arguments.edge_lengths},
        arguments.force);
    for (const fs::path& other : arguments.outputs) {
        if (!cli::is_same_file(output, other)) continue;
        throw agvd::InvalidOption(output.string() +
                                  " is named twice as an output; choose another file");
    }
}

// The mesh cut along the bisectors, each face with its cell.
std::string format_cells(const fs::path& path, const agvd::Surface& surface,
                         const agvd::Diagram& diagram, const agvd::Progress& progress) {
    const agvd::CutCells cells = agvd::cut_cells(surface, diagram, progress);
    remesh::Attribute site{.name = "site", .type = remesh::NumberType::Int32};
    for (const agvd::SiteId s : cells.face_site) {
        site.values.push_back(s.is_valid() ? static_cast<double>(s.value()) : -1.0);
    }
    return remesh::format_mesh({path}, cells.mesh.view(), {.of_faces = {std::move(site)}},
                               progress);
}

std::string page_of(const DiagramRun& arguments, const agvd::Surface& surface,
                    const std::vector<agvd::SurfacePoint>& sites,
                    const agvd::PropagationOptions& propagating, const cli::BasedDiagram& based,
                    cli::Console& console) {
    page::DiagramPage page =
        cli::diagram_for_page(surface, sites, based.diagram, propagating, based.certified_error,
                              [&](const char* stage) { return console.progress_of(stage); });
    page.version = REMESH_VERSION;
    page.command = arguments.command;
    page.name = arguments.input.filename().string();
    page.warnings = console.warnings();
    return page::format_page(page, based.diagram, console.progress_of("page"));
}

void run_diagram(const DiagramRun& arguments, cli::Console& console) {
    check_cells(arguments);
    check_page(arguments);
    check_has_positions(arguments);
    cli::check_outputs(arguments, {arguments.sites, arguments.barriers, arguments.edge_lengths},
                       remesh::check_diagram_extension);
    console.expect(cli::stages_with_reading(arguments.input, arguments.sampling.num_samples));
    const cli::OpenedInput input = cli::open_input(arguments, console, [&](std::size_t num_faces) {
        return cli::stages_of_diagram(num_faces, arguments.sampling.num_samples);
    });
    const agvd::Surface& surface = input.surface;
    const auto [sites, roles, shapes] = cli::sites_on(input, arguments, console);
    if (!arguments.html.empty()) {
        cli::require_plain_points(arguments.sites, roles, shapes.size(), "--html draws cells of");
    }
    check_has_points_only(arguments, shapes);
    agvd::PropagationOptions propagating = arguments.propagation;
    propagating.points = roles;
    propagating.shapes = shapes;
    propagating.num_threads = arguments.common.threads;
    const cli::BasedDiagram based = cli::naming_file(
        arguments.input,
        [&, &points = sites] {
            return build(surface, points, propagating, console, arguments.chord);
        },
        arguments.sites);
    const agvd::Diagram& diagram = based.diagram;

    const agvd::Progress writing = console.progress_of("write");
    std::vector<remesh::FileContent> files;
    for (const fs::path& output : arguments.outputs) {
        files.push_back(
            {output, remesh::format_diagram(output, surface, sites, diagram, writing, roles)});
    }
    if (!arguments.cells.empty()) {
        files.push_back(
            {arguments.cells, format_cells(arguments.cells, surface, diagram, writing)});
    }
    const auto unreached = std::count_if(diagram.nearest_site.begin(), diagram.nearest_site.end(),
                                         [](agvd::SiteId site) { return !site.is_valid(); });
    if (unreached > 0) {
        console.warn("no site reaches " + std::to_string(unreached) +
                     " vertices; place a site on every component");
    }
    warn_of_empty_cells(diagram, console);
    if (!arguments.html.empty()) {
        files.push_back(
            {arguments.html, page_of(arguments, surface, sites, propagating, based, console)});
    }
    remesh::write_files_atomically(files, writing);
    console.info(remesh::to_text(propagating.engine, based.certified_error));
    console.info(std::to_string(diagram.num_sites) + " sites, " +
                 std::to_string(diagram.vertices.size()) + " Voronoi vertices, " +
                 std::to_string(diagram.edges.size()) + " Voronoi edges");
}

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

struct CompareArguments {
    fs::path a;
    std::string b;    // Path, or "exact".
    fs::path report;  // Empty: none; "-": stdout, and no text.
    agvd::DiagramCompareOptions options;
    agvd::Index points = agvd::BisectorErrorOptions().max_points;
    cli::CommonOptions common;
};

// \throw agvd::InvalidInput  b is not of the same mesh and sites.
void check_same_input(const CompareArguments& arguments, const remesh::DiagramFile& a,
                      const remesh::DiagramFile& b) {
    const std::string both = arguments.a.string() + " and " + arguments.b;
    if (a.mesh.positions != b.mesh.positions || a.mesh.triangles != b.mesh.triangles) {
        throw agvd::InvalidInput(
            both + " have different meshes (" + std::to_string(a.mesh.triangles.size()) + " and " +
            std::to_string(b.mesh.triangles.size()) + " faces); compare diagrams of the same mesh");
    }
    const auto [in_a, in_b] =
        std::mismatch(a.sites.begin(), a.sites.end(), b.sites.begin(), b.sites.end());
    if (in_a != a.sites.end() || in_b != b.sites.end()) {
        throw agvd::InvalidInput(both + " have different sites (" + std::to_string(a.sites.size()) +
                                 " and " + std::to_string(b.sites.size()) +
                                 " sites, which first differ at site " +
                                 std::to_string(in_a - a.sites.begin()) +
                                 "); write both with the same --sites, or the same --samples, "
                                 "--init and --seed");
    }
    if (a.points != b.points) {
        throw agvd::InvalidInput(both +
                                 " group their points differently, or start them at different "
                                 "distances; write both with the same --sites");
    }
}

void run_compare(const CompareArguments& arguments, cli::Console& console) {
    const bool is_json_on_stdout = arguments.report == "-";
    const bool is_exact = arguments.b == "exact";
    if (!arguments.report.empty() && !is_json_on_stdout) {
        cli::check_output(arguments.report,
                          {arguments.a, is_exact ? fs::path() : fs::path(arguments.b)});
    }
    console.expect(cli::stages_of_comparison(is_exact));
    const remesh::DiagramFile a = remesh::read_diagram(arguments.a, console.progress_of("read"));
    const int threads = arguments.common.threads;
    const agvd::Surface surface = cli::naming_file(arguments.a, [&] {
        return agvd::build_surface(a.mesh.view(), threads, console.progress_of("read"));
    });
    agvd::Diagram b;
    if (is_exact) {
        const agvd::PropagationOptions exact{
            .points = a.points, .max_error = 0, .num_threads = threads};
        b = cli::naming_file(arguments.a,
                             [&] { return build(surface, a.sites, exact, console).diagram; });
    } else {
        remesh::DiagramFile file = remesh::read_diagram(arguments.b, console.progress_of("read"));
        check_same_input(arguments, a, file);
        b = std::move(file.diagram);
    }
    agvd::DiagramCompareOptions options = arguments.options;
    options.num_threads = threads;
    options.progress = console.progress_of("compare");
    remesh::Comparison comparison;
    comparison.sites = a.diagram.num_sites;
    comparison.difference = agvd::compare_diagrams(surface, a.diagram, b, options);
    if (arguments.points > 0) {
        const std::array<const agvd::Diagram*, 2> diagrams{&a.diagram, &b};
        const auto errors =
            agvd::exact_bisector_errors(surface, a.sites, diagrams,
                                        {.points = a.points,
                                         .max_points = arguments.points,
                                         .num_threads = threads,
                                         .progress = console.progress_of("compare")});
        comparison.bisectors_a = errors[0];
        comparison.bisectors_b = errors[1];
    }
    const remesh::ComparisonInfo info{
        .version = REMESH_VERSION, .a = arguments.a.string(), .b = arguments.b};
    if (!arguments.report.empty()) cli::write_text(arguments.report, to_json(comparison, info));
    if (!is_json_on_stdout) cli::print(to_text(comparison, info) + '\n');
}

CLI::App* add_diagram(CLI::App& app, DiagramRun& arguments) {
    CLI::App* command = app.add_subcommand(
        "diagram", "Compute the diagram of sites on a mesh and write it to files");
    cli::add_diagram_options(*command, arguments);
    cli::add_barriers(*command, arguments);
    cli::add_edge_lengths(*command, arguments);
    cli::add_outputs(*command, arguments.outputs);
    command
        ->add_option("--cells", arguments.cells,
                     "Also write the mesh cut along the bisectors: triangles with the property "
                     "site (.ply, .vtp or .vtk)")
        ->type_name("FILE");
    command
        ->add_option("--html", arguments.html,
                     "Write a page that shows cells, bisectors, sites and lines of equal distance: "
                     "one file for any browser, which needs no network")
        ->type_name("FILE");
    cli::start_group(*command, cli::heading::accuracy);
    command
        ->add_option("--chord", arguments.chord,
                     "Draw bisectors within this distance of their arcs, in mesh units, and write "
                     "the arcs; by default within a hundredth of each chord's length")
        ->check(CLI::Validator(
            [](const std::string& text) { return cli::check_length("chord", text); }, ""))
        ->type_name("LENGTH");
    command->footer(std::string(diagram_footer) + cli::exit_code_help);
    return command;
}

void add_compare(CLI::App& app, CompareArguments& arguments) {
    CLI::App* command = app.add_subcommand(
        "compare", "Measure the difference of a diagram from another one, or from the exact one");
    cli::start_group(*command, cli::heading::files);
    command->add_option("A", arguments.a, "Diagram to measure: a .agvd file of `agvd diagram`")
        ->required();
    command->add_option("B", arguments.b, "Diagram to compare A with: a .agvd file, or `exact`")
        ->required();
    command
        ->add_option("--report,--json", arguments.report,
                     "Write the figures as JSON; - writes them to stdout")
        ->type_name("FILE|-");
    cli::start_group(*command, cli::heading::accuracy);
    command
        ->add_option(
            "--spacing", arguments.options.spacing,
            "Distance between points of a loop, in mean cell radii; a smaller one costs more")
        ->check(CLI::Range(1e-6, 10.0).description(""))
        ->type_name("H")
        ->capture_default_str();
    cli::add_count(*command, "--samples", "Number of points at which cells are compared",
                   arguments.options.area_samples)
        ->default_str(std::to_string(arguments.options.area_samples));
    command
        ->add_option("--points", arguments.points,
                     "Largest number of points of each diagram's bisectors at which |dA - dB| is "
                     "measured; use fewer, or 0, if the mesh has extreme slivers, as measuring "
                     "then takes long and needs gigabytes")
        ->check(CLI::Range(agvd::Index{0}, agvd::Index{1'000'000'000}).description(""))
        ->type_name("N")
        ->capture_default_str();
    cli::add_common_options(*command, arguments.common);
    command->footer(std::string(compare_footer) + cli::exit_code_help);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Geodesic Voronoi diagrams of triangle meshes.", "agvd");
    app.require_subcommand(1);
    app.footer(cli::exit_code_help);
    DiagramRun for_diagram;
    for_diagram.command = page::to_shell(argc, argv, "agvd");
    CompareArguments for_compare;
    const CLI::App* diagram = add_diagram(app, for_diagram);
    const std::array queries{cli::add_distance(app), cli::add_path(app), cli::add_isolines(app)};
    add_compare(app, for_compare);
    return cli::run(app, argc, argv, [&] {
        for (const cli::Query& query : queries) {
            if (query.command->parsed()) return query.run();
        }
        if (diagram->parsed()) {
            cli::Console console(for_diagram.common, cli::limit_of(for_diagram));
            console.run([&] { run_diagram(for_diagram, console); });
        } else {
            cli::Console console(for_compare.common);
            console.run([&] { run_compare(for_compare, console); });
        }
    });
}
