// make_data: writes every mesh of data/, so that the origin of each is known.

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cli.h"
#include "make_data/data_files.h"
#include "mesh_paths.h"
#include "remesh/meshfile/atomic_file.h"
#include "system/process.h"

int main(int argc, char** argv) {
    cli::begin_process(argc, argv);
    std::filesystem::path folder;
    CLI::App app{"Writes the meshes of data/.", "make_data"};
    cli::add_file(app, "FOLDER", folder, "Folder to write to; it must exist")
        ->required()
        ->check(CLI::ExistingDirectory);
    return cli::run(app, argc, argv, [&] {
        for (const make_data::DataFile& file : make_data::data_files()) {
            remesh::write_file_atomically(folder / file.name, format(file));
            cli::stop_if_interrupted();
        }
    });
}
