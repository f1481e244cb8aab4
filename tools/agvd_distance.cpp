// `agvd distance` writes distances along the surface: of the vertices, or of given points.
#include <CLI/CLI.hpp>
#include <memory>
#include <sstream>

#include "agvd/paths/distances.h"
#include "given_surface.h"
#include "help.h"
#include "mesh_paths.h"
#include "query.h"
#include "remesh/meshfile/atomic_file.h"
#include "report/report.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* distance_footer =
    "Examples:\n"
    "  agvd distance bunny.ply --sites sites.txt -o distances.ply\n"
    "  agvd distance bunny.ply --sites sites.txt --radius 0.02 -o near.vtp\n"
    "  agvd distance bunny.ply -n 100 --nearest 4 -o ranks.ply\n"
    "  agvd distance bunny.ply --sites sites.txt --targets points.txt -o table.csv\n\n"
    "FILE has a point on each line: `v VERTEX`, `f FACE B0 B1 B2` or `p X Y Z`; for\n"
    "--sites also `site N` behind it, the site that it belongs to, and `start D`, the\n"
    "distance that it starts with. A line `l VERTEX VERTEX ...` is a site along edges\n"
    "of the mesh, `r FACE FACE ...` a region, at its start (or 0) inside; `site` and\n"
    "`start` may stand behind these, too.\n\n"
    "Output (.gz behind the extension: compressed):\n"
    "  .ply, .vtp, .vtk   the mesh of IN, its polygons as triangles, with the vertex\n"
    "         properties site (-1: none) and distance (infinity: not reached), as of\n"
    "         vertices in no face; with --nearest also site_2, distance_2 and so on of\n"
    "         the second nearest site. Of a vertex on barriers the nearest side counts\n"
    "  .csv   with --targets: a line SITE,DISTANCE for each of them, behind a header\n\n";

struct DistanceArguments : QueryArguments {
    fs::path targets;         // Empty: the vertices.
    double radius = 0;        // 0: none.
    agvd::Index nearest = 1;  // Sites of each vertex.
};

void check_table_extension(const fs::path& path) {
    if (path.extension() == ".csv") return;
    throw agvd::IoError(path.string() + ": targets are written to a table; use .csv");
}

void check_mesh_extension(const fs::path& path) {
    const fs::path name = path.extension() == ".gz" ? path.stem() : path;
    for (const char* extension : {".ply", ".vtp", ".vtk"}) {
        if (name.extension() == extension) return check_format({path});
    }
    throw agvd::IoError(path.string() +
                        ": distances of vertices are written to meshes with properties; use "
                        ".ply, .vtp or .vtk, or add --targets for a .csv");
}

double number_of(agvd::SiteId site) { return site.is_valid() ? site.value() : -1.0; }

// Every format_double reads back as the same number.
std::string to_table(const agvd::Distances& distances) {
    std::ostringstream table;
    table.imbue(std::locale::classic());
    table.precision(17);
    table << "site,distance\n";
    for (std::size_t i = 0; i < distances.point_site.size(); ++i) {
        table << number_of(distances.point_site[i]) << ',' << distances.point_distance[i] << '\n';
    }
    return table.str();
}

// The columns of sites and distances of the surface's vertices, the nearest first.
std::vector<remesh::Attribute> columns(agvd::Index num_vertices, agvd::Index k) {
    std::vector<remesh::Attribute> result;
    for (agvd::Index i = 1; i <= k; ++i) {
        const std::string rank = i == 1 ? "" : '_' + std::to_string(i);
        result.push_back({.name = "site" + rank, .type = remesh::NumberType::Int32});
        result.back().values.assign(num_vertices, -1);
        result.push_back({.name = "distance" + rank});
        result.back().values.assign(num_vertices, agvd::infinity);
    }
    return result;
}

std::vector<remesh::Attribute> columns_of(const agvd::Surface& surface,
                                          const agvd::Distances& distances) {
    std::vector<remesh::Attribute> result = columns(surface.num_vertices(), 1);
    for (std::size_t i = 0; i < distances.vertices.size(); ++i) {
        result[0].values[distances.vertices[i]] = number_of(distances.vertex_site[i]);
        result[1].values[distances.vertices[i]] = distances.vertex_distance[i];
    }
    return result;
}

std::vector<remesh::Attribute> columns_of(const agvd::Surface& surface,
                                          const agvd::KNearest& ranks) {
    std::vector<remesh::Attribute> result = columns(surface.num_vertices(), ranks.k);
    for (std::size_t i = 0; i < ranks.site.size(); ++i) {
        const std::size_t vertex = i / ranks.k, column = 2 * (i % ranks.k);
        result[column].values[vertex] = number_of(ranks.site[i]);
        result[column + 1].values[vertex] = ranks.distance[i];
    }
    return result;
}

void check(const DistanceArguments& arguments) {
    const bool has_targets = !arguments.targets.empty();
    check_outputs(arguments,
                  {arguments.sites, arguments.targets, arguments.barriers, arguments.edge_lengths},
                  has_targets ? check_table_extension : check_mesh_extension);
    if (arguments.nearest > 1 && (has_targets || arguments.radius > 0)) {
        throw agvd::InvalidOption(
            "--nearest is for all vertices; leave out --targets and --radius");
    }
}

void write(const DistanceArguments& arguments,
           const std::function<std::string(const fs::path&)>& format, Console& console) {
    std::vector<remesh::FileContent> files;
    for (const fs::path& output : arguments.outputs) files.push_back({output, format(output)});
    write_files(arguments, std::move(files), console);
}

// The mesh as it was given; a vertex at which nothing is left has no site.
void write_mesh(const DistanceArguments& arguments, const OpenedInput& input,
                std::vector<remesh::Attribute> columns, Console& console) {
    const agvd::MeshView mesh = input.file.mesh.view();
    const std::vector<agvd::Index> places =
        vertices_of_least(mesh, input.clean, input.surface, columns[1].values);
    for (remesh::Attribute& column : columns) {
        std::vector<double> values(places.size(),
                                   column.type == remesh::NumberType::Int32 ? -1 : agvd::infinity);
        for (std::size_t v = 0; v < places.size(); ++v) {
            if (places[v] != agvd::no_index) values[v] = column.values[places[v]];
        }
        column.values = std::move(values);
    }
    const remesh::MeshAttributes attributes{.of_vertices = std::move(columns)};
    write(
        arguments,
        [&](const fs::path& output) {
            return remesh::format_mesh({output}, mesh, attributes, console.progress_of("write"));
        },
        console);
}

void run_distance(const DistanceArguments& arguments, Console& console) {
    check(arguments);
    console.expect(stages_with_reading(arguments.input, arguments.sampling.num_samples));
    const OpenedInput input = open_input(arguments, console, [](std::size_t num_faces) {
        return stages_of_query(num_faces, "write");
    });
    const agvd::Surface& surface = input.surface;
    const agvd::SurfaceSites sites = sites_on(input, arguments, console);
    const double max_error = arguments.propagation.max_error.value_or(0);
    const int threads = arguments.common.threads;
    if (arguments.nearest > 1) {
        const agvd::KNearest ranks =
            agvd::k_nearest_sites(surface, sites.points, arguments.nearest,
                                  {.points = sites.roles,
                                   .shapes = sites.shapes,
                                   .max_error = max_error,
                                   .num_threads = threads,
                                   .progress = console.progress_of("propagate")});
        console.info(remesh::to_text(agvd::Engine::Window, ranks.certified_error));
        return write_mesh(arguments, input, columns_of(surface, ranks), console);
    }
    std::vector<agvd::SurfacePoint> targets;
    if (!arguments.targets.empty()) targets = points_on(input, arguments.targets, console);
    const agvd::Distances distances = agvd::find_distances(
        surface, sites.points, targets,
        {.points = sites.roles,
         .shapes = sites.shapes,
         .max_distance = arguments.radius > 0 ? arguments.radius : agvd::infinity,
         .max_error = max_error,
         .num_threads = threads,
         .progress = console.progress_of("propagate")});
    console.info(remesh::to_text(agvd::Engine::Window, distances.certified_error));
    console.info(std::to_string(distances.vertices.size()) + " of " +
                 std::to_string(surface.num_vertices()) + " vertices reached");
    if (arguments.targets.empty()) {
        return write_mesh(arguments, input, columns_of(surface, distances), console);
    }
    write(
        arguments, [&](const fs::path&) { return to_table(distances); }, console);
}

}  // namespace

Query add_distance(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "distance", "Write the distances of vertices or points from the nearest sites");
    const auto arguments = std::make_shared<DistanceArguments>();
    add_query_options(*command, *arguments);
    add_barriers(*command, *arguments);
    add_edge_lengths(*command, *arguments);
    start_group(*command, heading::count);
    add_count(*command, "--nearest",
              "Number of sites of each vertex, the nearest first. Not with --targets, --radius",
              arguments->nearest)
        ->type_name("K")
        ->default_str("1");
    start_group(*command, heading::place);
    add_file(*command, "--targets", arguments->targets,
             "Points whose distances are written, in place of the vertices")
        ->type_name("FILE");
    command
        ->add_option("--radius", arguments->radius,
                     "Largest distance, in mesh units; only faces so near to a site are looked at")
        ->check(CLI::Validator([](const std::string& text) { return check_length("radius", text); },
                               ""))
        ->type_name("R");
    add_outputs(*command, *arguments)->required();
    command->footer(std::string(distance_footer) + exit_code_help);
    return make_query(command, arguments, run_distance);
}

}  // namespace cli
