// `agvd diagram` writes geodesic Voronoi diagrams to files, drawn on the cleaned input.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>

#include "agvd/diagram/cut_cells.h"
#include "based_diagram.h"
#include "diagram_for_page.h"
#include "help.h"
#include "mesh_paths.h"
#include "page/viewer.h"
#include "page_outputs.h"
#include "picture.h"
#include "query.h"
#include "remesh/clean/carry.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/transfer/transfer.h"
#include "render/mesh_picture.h"
#include "report/report.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* diagram_footer =
    "Examples:\n"
    "  agvd diagram bunny.ply -n 100 -o cells.vtp -o labels.ply\n"
    "  agvd diagram bunny.ply --sites sites.txt -o edges.obj\n"
    "  agvd diagram bunny.ply -n 100 --html cells.html --picture cells.png\n"
    "  agvd diagram bunny.ply -n 100 -o cells.vtp --cells cut.ply\n"
    "  agvd diagram bunny.ply -n 100 --max-error 0 --chord 1e-5 -o arcs.vtp\n\n"
    "Behind a point of --sites may stand `site N`, the number of the site that it\n"
    "belongs to (several points may; on all lines or on none), and `start D`, a\n"
    "distance that counts from there on: an additive weight. A line of the file that\n"
    "reads `l VERTEX VERTEX ...` is a site along edges of the mesh, `r FACE FACE ...`\n"
    "a region of faces, at its start (or 0) inside; both may have `site` and `start`.\n\n"
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
void warn_of_empty_cells(const agvd::Diagram& diagram, Console& console) {
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
void check_has_positions(const QueryArguments& arguments) {
    if (arguments.edge_lengths.empty()) return;
    for (const fs::path& output : arguments.outputs) {
        if (!is_diagram_file(output)) continue;
        throw agvd::InvalidOption(output.string() +
                                  ": a .agvd file has positions only; with --edge-lengths write "
                                  ".vtp, .ply or .obj");
    }
}

struct DiagramRun : QueryArguments {
    fs::path cells;    // The cut mesh; empty: none.
    fs::path html;     // Empty: none.
    fs::path picture;  // Empty: none.
    std::array<double, 3> view = render::default_degrees;
    std::optional<double> chord;
    std::string command;  // The command line: see page::to_shell.
};

void check_cells(const fs::path& output) {
    const fs::path name = output.extension() == ".gz" ? output.stem() : output;
    const std::array known{".ply", ".vtp", ".vtk"};
    if (std::find(known.begin(), known.end(), name.extension()) != known.end()) return;
    throw agvd::IoError(output.string() +
                        ": cells are written to meshes with properties of faces; use .ply, "
                        ".vtp or .vtk");
}

// The outputs that -o does not name.
void check_other_outputs(const DiagramRun& arguments) {
    std::vector<fs::path> named = arguments.outputs;
    for (const fs::path& output : {arguments.cells, arguments.html, arguments.picture}) {
        if (output.empty()) continue;
        check_output(output,
                     {arguments.input, arguments.sites, arguments.barriers, arguments.edge_lengths},
                     arguments.force);
        for (const fs::path& other : named) {
            if (!is_same_file(other, output)) continue;
            throw agvd::InvalidOption(output.string() +
                                      " is named for two outputs; choose another file");
        }
        named.push_back(output);
    }
    if (named.empty()) {
        throw agvd::InvalidOption(
            "no output is asked for; add -o FILE, --cells FILE, --html FILE or --picture FILE");
    }
    if (!arguments.cells.empty()) check_cells(arguments.cells);
    if (!arguments.html.empty()) {
        check_page_option("--html", arguments.html);
        page::require_viewer("--html");
    }
    if (!arguments.picture.empty()) {
        check_page_option("--picture", arguments.picture);
        check_picture(arguments.picture);
    }
}

// The values of IN at vertices and faces of the cut mesh. Texture coordinates are left out, as most
// formats have no place for them.
remesh::MeshAttributes values_on_cells(const OpenedInput& input, const agvd::CutCells& cells) {
    const agvd::MeshView mesh = input.file.mesh.view();
    remesh::InputMap map{.vertices = remesh::to_original(cells.points, mesh, input.clean),
                         .faces = {}};
    const std::vector<agvd::Index>& origin = input.clean.face_origin;
    for (const agvd::Index face : cells.face_origin) {
        map.faces.emplace_back().fill(origin.empty() ? face : origin[face]);
    }
    remesh::MeshAttributes values = remesh::transfer_attributes(input.file, cells.mesh.view(), map);
    values.texture = {};
    return values;
}

// The triangles of the cells, each with its site and the values of IN.
std::string format_cells(const fs::path& path, const OpenedInput& input,
                         const agvd::CutCells& cells, const agvd::Progress& progress) {
    remesh::Attribute site{.name = "site", .type = remesh::NumberType::Int32};
    for (const agvd::SiteId s : cells.face_site) {
        site.values.push_back(s.is_valid() ? static_cast<double>(s.value()) : -1.0);
    }
    remesh::MeshAttributes attributes = values_on_cells(input, cells);
    std::erase_if(attributes.of_faces, [](const auto& other) { return other.name == "site"; });
    attributes.of_faces.insert(attributes.of_faces.begin(), std::move(site));
    return remesh::format_mesh({path}, cells.mesh.view(), attributes, progress);
}

void run_diagram(const DiagramRun& arguments, Console& console) {
    check_other_outputs(arguments);
    check_has_positions(arguments);
    check_outputs(arguments, {arguments.sites, arguments.barriers, arguments.edge_lengths},
                  remesh::check_diagram_extension);
    console.expect(stages_with_reading(arguments.input, arguments.sampling.num_samples));
    const OpenedInput input = open_input(
        arguments, console,
        [&](std::size_t num_faces) {
            return stages_of_diagram(num_faces, arguments.sampling.num_samples);
        },
        arguments.cells.empty() ? WithAttributes::No : WithAttributes::Yes);
    const agvd::Surface& surface = input.surface;
    const auto [sites, roles, shapes] = sites_on(input, arguments, console);
    agvd::PropagationOptions propagating = arguments.propagation;
    propagating.points = roles;
    propagating.shapes = shapes;
    propagating.num_threads = arguments.common.threads;
    const auto progress_of = [&](const char* stage) { return console.progress_of(stage); };
    const BasedDiagram based = naming_file(
        arguments.input,
        [&, &points = sites] {
            return based_diagram(surface, points, propagating, progress_of, arguments.chord);
        },
        arguments.sites);
    const agvd::Diagram& diagram = based.diagram;

    const agvd::Progress writing = console.progress_of("write");
    std::vector<remesh::FileContent> files;
    for (const fs::path& output : arguments.outputs) {
        files.push_back({output, remesh::format_diagram(output, surface, sites, diagram, writing,
                                                        roles, shapes)});
    }
    const auto unreached = std::count_if(diagram.nearest_site.begin(), diagram.nearest_site.end(),
                                         [](agvd::SiteId site) { return !site.is_valid(); });
    if (unreached > 0) {
        console.warn("no site reaches " + std::to_string(unreached) +
                     " vertices; place a site on every component");
    }
    warn_of_empty_cells(diagram, console);
    agvd::CutCells cells;
    if (!arguments.cells.empty() || !arguments.picture.empty()) {
        cells = agvd::cut_cells(surface, diagram, writing);
    }
    if (!arguments.cells.empty()) {
        files.push_back({arguments.cells, format_cells(arguments.cells, input, cells, writing)});
    }
    if (!arguments.html.empty() || !arguments.picture.empty()) {
        page::DiagramPage page = diagram_for_page(surface, sites, diagram, propagating,
                                                  based.certified_error, progress_of);
        page.version = REMESH_VERSION;
        page.command = arguments.command;
        page.name = arguments.input.filename().string();
        page.warnings = console.warnings();
        if (!arguments.html.empty()) {
            files.push_back(
                {arguments.html, page::format_page(page, diagram, console.progress_of("page"))});
        }
        if (!arguments.picture.empty()) {
            files.push_back({arguments.picture,
                             picture_of_diagram(arguments.picture, page, cells, arguments.view)});
        }
    }
    console.info(remesh::to_text(propagating.engine, based.certified_error));
    console.info(std::to_string(diagram.num_sites) + " sites, " +
                 std::to_string(diagram.vertices.size()) + " Voronoi vertices, " +
                 std::to_string(diagram.edges.size()) + " Voronoi edges");
    write_files(arguments, std::move(files), console);
}

}  // namespace

Query add_diagram(CLI::App& app, const std::string& command_line) {
    CLI::App* command = app.add_subcommand(
        "diagram", "Compute the diagram of sites on a mesh and write it to files");
    const auto arguments = std::make_shared<DiagramRun>();
    arguments->command = command_line;
    add_diagram_options(*command, *arguments);
    add_barriers(*command, *arguments);
    add_edge_lengths(*command, *arguments);
    add_outputs(*command, *arguments);
    add_file(*command, "--cells", arguments->cells,
             "Also write the mesh cut along the bisectors: triangles with the property "
             "site and the values of IN, but for texture coordinates (.ply, .vtp or .vtk)")
        ->type_name("FILE");
    add_file(*command, "--html", arguments->html,
             "Write a page that shows cells, bisectors, sites and lines of equal distance: "
             "one file for any browser, which needs no network")
        ->type_name("FILE");
    add_file(*command, "--picture", arguments->picture,
             "Write a picture of the same as .png, or as .svg with bisectors, lines and "
             "sites as curves over a picture of the cells")
        ->type_name("FILE");
    command
        ->add_option("--view", arguments->view,
                     "How the mesh is turned in the picture: degrees about x, y and z, y first")
        ->delimiter(',')
        ->needs("--picture")
        ->type_name("X,Y,Z")
        ->default_str("15,-30,0");
    start_group(*command, heading::accuracy);
    command
        ->add_option("--chord", arguments->chord,
                     "Draw bisectors within this distance of their arcs, in mesh units, and write "
                     "the arcs; by default within a hundredth of each chord's length")
        ->check(
            CLI::Validator([](const std::string& text) { return check_length("chord", text); }, ""))
        ->type_name("LENGTH");
    command->footer(std::string(diagram_footer) + exit_code_help);
    return make_query(command, arguments, run_diagram);
}

}  // namespace cli
