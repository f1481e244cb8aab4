// Geodesic Voronoi diagrams, distances and paths. Each subcommand is a file of its own.
#include <CLI/CLI.hpp>
#include <array>

#include "help.h"
#include "page/embed.h"
#include "query.h"
#include "system/process.h"

int main(int argc, char** argv) {
    cli::begin_process(argc, argv);
    CLI::App app("Geodesic Voronoi diagrams of triangle meshes.", "agvd");
    app.require_subcommand(1);
    app.footer(cli::exit_code_help);
    const std::array queries{cli::add_diagram(app, page::to_shell(argc, argv, "agvd")),
                             cli::add_distance(app), cli::add_path(app), cli::add_isolines(app),
                             cli::add_compare(app)};
    return cli::run(app, argc, argv, [&] {
        for (const cli::Query& query : queries) {
            if (query.command->parsed()) query.run();
        }
    });
}
