// Geodesic Voronoi diagrams as files: `agvd diagram`.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "agvd/diagram/diagram.h"
#include "arguments.h"
#include "remesh/io/read_mesh.h"
#include "remesh/io/read_sites.h"
#include "remesh/io/report.h"
#include "remesh/io/write_diagram.h"
#include "remesh/repair/carry_sites.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* footer =
    "Examples:\n"
    "  agvd diagram bunny.ply -n 100 -o cells.vtp -o labels.ply\n"
    "  agvd diagram bunny.ply --sites sites.txt -o edges.obj\n\n"
    "Output:\n"
    "  .vtp  VTK PolyData: Voronoi edges and boundary arcs as polylines with the cell data\n"
    "        site_left, site_right (-1: outside) and the point data distance\n"
    "  .obj  the same polylines as v and l lines\n"
    "  .ply  the cleaned mesh with the vertex properties site (-1: none reaches) and distance\n\n";

struct Arguments : cli::DiagramArguments {
    std::vector<fs::path> outputs;
};

void check_outputs(const Arguments& arguments) {
    for (const fs::path& output : arguments.outputs) {
        if (!remesh::is_known_diagram_extension(output)) {
            throw agvd::IoError(output.string() + ": unknown extension; use .vtp, .obj or .ply");
        }
        cli::check_output(output, {arguments.input, arguments.sites}, arguments.force);
    }
}

void run_diagram(const Arguments& arguments) {
    cli::Console console(arguments.common);
    check_outputs(arguments);
    const remesh::MeshFile input = remesh::read_mesh(arguments.input);
    const agvd::MeshView mesh = input.mesh.view();
    console.info(cli::describe(arguments.input, mesh));
    const remesh::CleanResult clean =
        cli::naming_file(arguments.input, [&] { return remesh::clean_input(mesh); });
    console.info(remesh::to_text(clean.counts));
    const agvd::Surface surface = agvd::build_surface(clean.mesh.view());

    const auto progress_of = [&](const char* stage) {
        return [&console, stage](double fraction) { return console.progress(stage, fraction); };
    };
    remesh::SamplingOptions sampling = arguments.sampling;
    sampling.num_threads = arguments.common.threads;
    sampling.progress = progress_of("sample");
    const std::vector<agvd::SurfacePoint> sites =
        arguments.sites.empty()
            ? remesh::sample_sites(surface, sampling)
            : remesh::to_cleaned(remesh::read_sites(arguments.sites, mesh), mesh, clean);
    agvd::PropagationOptions propagating = arguments.propagation;
    propagating.num_threads = arguments.common.threads;
    propagating.progress = progress_of("propagate");
    const agvd::Propagation propagation = agvd::propagate(surface, sites, propagating);
    const agvd::Diagram diagram = agvd::build_diagram(
        surface, sites, propagation,
        {.num_threads = arguments.common.threads, .progress = progress_of("diagram")});

    cli::stop_if_interrupted();
    for (const fs::path& output : arguments.outputs) {
        remesh::write_diagram(output, surface, propagation, diagram);
    }
    const auto unreached =
        std::count_if(propagation.vertex_site.begin(), propagation.vertex_site.end(),
                      [](agvd::SiteId site) { return !site.is_valid(); });
    if (unreached > 0) {
        console.warn(std::to_string(unreached) +
                     " vertices are reached by no site; place one on every component");
    }
    console.info(remesh::to_text(propagating.engine, propagation.certified_error));
    console.info(std::to_string(sites.size()) + " sites, " +
                 std::to_string(diagram.vertices.size()) + " Voronoi vertices, " +
                 std::to_string(diagram.edges.size()) + " edges");
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Geodesic Voronoi diagrams of triangle meshes.", "agvd");
    app.require_subcommand(1);
    app.footer(cli::exit_code_help);
    CLI::App* diagram = app.add_subcommand("diagram", "Diagram of sites on a mesh, as files");
    Arguments arguments;
    cli::add_diagram_options(*diagram, arguments);
    diagram->add_option("-o,--output", arguments.outputs, "File to write; may be repeated")
        ->required()
        ->type_name("FILE")
        ->allow_extra_args(false);
    diagram->footer(std::string(footer) + cli::exit_code_help);
    return cli::run(app, argc, argv, [&] { run_diagram(arguments); });
}
