#include "query.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "agvd/mesh/cut_surface.h"
#include "given_surface.h"
#include "help.h"
#include "mesh_paths.h"
#include "remesh/clean/carry.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/sites/prepared_surface.h"
#include "report/report.h"
#include "shortfalls.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using agvd::SurfacePoint;

// Edges of IN that cleaning split are no barriers any more: that would leave gaps.
void cut_along_barriers(const DiagramArguments& arguments, Console& console, OpenedInput& input) {
    const auto edges = remesh::read_edges(arguments.barriers, console.progress_of("read"));
    const std::vector<std::uint8_t> is_cut = naming_file(arguments.barriers, [&] {
        return remesh::carry_edges(edges, input.file.mesh.view(), input.clean, input.surface);
    });
    input.whole = std::move(input.surface);
    input.surface = agvd::cut_along(*input.whole, is_cut, arguments.common.threads,
                                    console.progress_of("clean"))
                        .surface;
}

// What cleaning repairs is an error here: lengths belong to the edges that are there.
void connect_by_lengths(const DiagramArguments& arguments, Console& console, OpenedInput& input) {
    if (arguments.sites.empty()) {
        throw agvd::InvalidOption(
            "--edge-lengths needs --sites, as sites are sampled in space; name the sites");
    }
    const agvd::MeshView mesh = input.file.mesh.view();
    const std::vector<double> lengths =
        remesh::read_edge_lengths(arguments.edge_lengths, mesh, console.progress_of("read"));
    input.surface = naming_file(arguments.edge_lengths, [&] {
        return agvd::build_surface(mesh, lengths, arguments.common.threads,
                                   console.progress_of("clean"));
    });
    input.clean.mesh = input.file.mesh;
}

std::vector<SurfacePoint> on_surface(const OpenedInput& input,
                                     const std::vector<SurfacePoint>& given) {
    if (input.surface.has_own_lengths) return given;
    return remesh::to_cleaned(given, input.file.mesh.view(), input.clean);
}

std::vector<SurfacePoint> sample(const DiagramArguments& arguments, const agvd::Surface& surface,
                                 Console& console) {
    remesh::SamplingOptions sampling = arguments.sampling;
    sampling.num_samples = num_samples_for(arguments, surface.num_vertices());
    sampling.num_threads = arguments.common.threads;
    sampling.progress = console.progress_of("sample");
    return naming_file(arguments.input, [&] { return remesh::sample_sites(surface, sampling); });
}

}  // namespace

std::string check_length(const char* name, const std::string& text) {
    const std::optional<Amount> amount = parse_amount(text);
    if (amount && !amount->is_percent) return {};
    return "the " + std::string(name) + " is " + text + "; use a number above 0";
}

void add_barriers(CLI::App& app, DiagramArguments& arguments) {
    start_group(app, heading::geodesics);
    add_file(app, "--barriers", arguments.barriers,
             "Edges that no path crosses: lines of two vertices, counted from 0. The mesh is "
             "cut along them: their vertices come once for each side, and sites "
             "on them count on both")
        ->type_name("FILE");
}

void add_edge_lengths(CLI::App& app, DiagramArguments& arguments) {
    start_group(app, heading::geodesics);
    add_file(app, "--edge-lengths", arguments.edge_lengths,
             "Lengths of the edges in place of those between positions: lines of two "
             "vertices, counted from 0, and a length. The mesh is not cleaned, and its "
             "positions are for drawing")
        ->excludes(app.get_option("--barriers"))
        ->type_name("FILE");
}

CLI::Option* add_outputs(CLI::App& app, QueryArguments& arguments) {
    start_group(app, heading::files);
    add_ascii(app, arguments.ascii);
    return add_file(app, "-o,--output", arguments.outputs,
                    "File to write; repeat the option to write more files")
        ->type_name("FILE")
        ->allow_extra_args(false);
}

void check_outputs(const QueryArguments& arguments, std::initializer_list<fs::path> inputs,
                   void (*check_extension)(const fs::path&)) {
    for (const fs::path& output : arguments.outputs) {
        check_extension(output);
        check_output(output, {arguments.input}, arguments.force);
        check_output(output, inputs, arguments.force);
        const auto same =
            std::count_if(arguments.outputs.begin(), arguments.outputs.end(),
                          [&](const fs::path& other) { return is_same_file(output, other); });
        if (same > 1) {
            throw agvd::InvalidOption(output.string() +
                                      " is named twice as an output; choose another file");
        }
    }
}

OpenedInput open_input(const DiagramArguments& arguments, Console& console,
                       const std::function<std::vector<ExpectedStage>(std::size_t)>& stages,
                       WithAttributes attributes) {
    OpenedInput input{read_input(arguments, console, attributes), {}, {}};
    const agvd::MeshView mesh = input.file.mesh.view();
    console.info(describe(arguments.input, mesh));
    console.expect(stages(mesh.triangles.size()));
    if (!arguments.edge_lengths.empty()) {
        connect_by_lengths(arguments, console, input);
        return input;
    }
    remesh::CleanOptions cleaning = arguments.cleaning;
    cleaning.num_threads = arguments.common.threads;
    cleaning.progress = console.progress_of("clean");
    input.clean = naming_file(arguments.input, [&] { return remesh::clean_input(mesh, cleaning); });
    console.info(remesh::to_text(input.clean.counts));
    input.surface = agvd::build_surface(input.clean.mesh.view(), arguments.common.threads,
                                        console.progress_of("clean"));
    if (!arguments.barriers.empty()) cut_along_barriers(arguments, console, input);
    return input;
}

agvd::SurfaceSites sites_on(const OpenedInput& input, const DiagramArguments& arguments,
                            Console& console) {
    agvd::SurfaceSites sites;
    if (arguments.sites.empty()) {
        sites.points = sample(arguments, input.surface, console);
    } else {
        remesh::SitesFile given = read_given_sites(arguments, input.file, console);
        sites.points = naming_file(arguments.sites, [&] { return on_surface(input, given.sites); });
        sites.roles = std::move(given.points);
        sites.shapes = naming_file(arguments.sites, [&] {
            return carry_shapes(given.shapes, input.file.mesh.view(), input.clean, input.surface);
        });
    }
    const double slit = input.clean.slit_length;
    if (slit > remesh::mean_spacing(input.surface, sites.points.size() + sites.shapes.size())) {
        console.warn(welded_slit_text(slit));
    }
    if (input.clean.loose_vertices > 0) {
        console.warn(loose_vertices_text(input.clean.loose_vertices));
    }
    if (!input.whole) return sites;
    const std::size_t num_points = sites.points.size();
    sites = agvd::on_all_sides(*input.whole, input.surface, std::move(sites));
    if (sites.points.size() > num_points) {
        console.info("sites on barriers count on both sides of these");
    }
    return sites;
}

agvd::Propagation propagate_on(const OpenedInput& input, const DiagramArguments& arguments,
                               const agvd::SurfaceSites& sites,
                               std::vector<agvd::Index> relay_faces, Console& console) {
    agvd::PropagationOptions propagating = arguments.propagation;
    propagating.points = sites.roles;
    propagating.shapes = sites.shapes;
    propagating.relay_faces = std::move(relay_faces);
    propagating.num_threads = arguments.common.threads;
    propagating.progress = console.progress_of("propagate");
    return naming_file(
        arguments.input, [&] { return agvd::propagate(input.surface, sites.points, propagating); },
        arguments.sites);
}

std::vector<SurfacePoint> points_on(const OpenedInput& input, const fs::path& path,
                                    Console& console) {
    const std::vector<SurfacePoint> given = read_points(path, input.file, console);
    return naming_file(path, [&] { return on_surface(input, given); });
}

void write_files(const QueryArguments& arguments, std::vector<remesh::FileContent> files,
                 Console& console) {
    for (remesh::FileContent& file : files) {
        if (!arguments.ascii || file.path.extension() != ".ply") continue;
        file.bytes = remesh::ply_as_text(std::move(file.bytes));
    }
    remesh::write_files_atomically(files, console.progress_of("write"));
    for (const remesh::FileContent& file : files) {
        console.info("written: " + file.path.string());
    }
}

void write_lines(const QueryArguments& arguments, const remesh::Lines& lines, Console& console) {
    const agvd::Progress writing = console.progress_of("write");
    std::vector<remesh::FileContent> files;
    for (const fs::path& output : arguments.outputs) {
        files.push_back({output, remesh::format_lines(output, lines, writing)});
    }
    write_files(arguments, std::move(files), console);
}

}  // namespace cli
