// Meshes larger than memory, or shared by several machines: `remesh-tiles split` cuts a file into
// tiles, `mesh` makes the mesh of each, `join` makes one of all (tile_jobs.h).
#include <CLI/CLI.hpp>

#include "arguments.h"
#include "cli.h"
#include "help.h"
#include "mesh_paths.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/tilefiles/tile_jobs.h"
#include "shortfalls.h"
#include "system/process.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* footer =
    "Examples:\n"
    "  remesh-tiles split scan.ply tiles -n 1000000\n"
    "  remesh-tiles mesh tiles\n"
    "  remesh-tiles join tiles out.ply\n\n"
    "Tiles can be meshed by many processes that share the folder, in any order. What is\n"
    "there is not made again, so a command that was stopped goes on where it was. The\n"
    "result has the same bytes in each case.\n\n";

constexpr const char* split_footer =
    "Examples:\n"
    "  remesh-tiles split scan.ply tiles -n 1000000\n"
    "  remesh-tiles split scan.stl tiles -n 200000 --tile 5000\n\n";

constexpr const char* mesh_footer =
    "Examples:\n"
    "  remesh-tiles mesh tiles\n"
    "  remesh-tiles mesh tiles --share 0/4 -t 1\n"
    "  remesh-tiles mesh tiles --tile $SLURM_ARRAY_TASK_ID -t 1\n\n";

constexpr const char* join_footer =
    "Examples:\n"
    "  remesh-tiles join tiles out.ply\n\n";

struct Arguments {
    cli::CommonOptions common;
    fs::path folder;
};

struct SplitArguments : Arguments {
    fs::path input;
    remesh::SplitOptions options;
};

struct MeshArguments : Arguments {
    std::vector<agvd::Index> tiles;
    agvd::Index share = 0, num_shares = 1;
};

struct JoinArguments : Arguments {
    fs::path output;
    bool no_clobber = false;
};

void add_folder(CLI::App& command, Arguments& arguments, const char* text) {
    cli::start_group(command, cli::heading::files);
    cli::add_file(command, "DIR", arguments.folder, text)->required();
}

CLI::App* add_split(CLI::App& app, SplitArguments& arguments) {
    CLI::App* const command =
        app.add_subcommand("split", "Cut a file that need not fit into memory into tiles");
    cli::start_group(*command, cli::heading::files);
    cli::add_file(*command, "IN", arguments.input, "Binary PLY with triangles, or binary STL")
        ->required();
    cli::add_file(*command, "DIR", arguments.folder,
                  "Folder for the tiles; is made if it is missing")
        ->required();
    cli::start_group(*command, cli::heading::count);
    cli::add_count(*command, "-n,--samples", "Number of vertices of the whole result",
                   arguments.options.num_samples)
        ->default_str(std::to_string(arguments.options.num_samples));
    cli::add_count(*command, "--tile",
                   "Largest number of vertices of a tile, 500 or more; a tile takes some 5 kB of "
                   "memory for each, and some 100 bytes for each of its faces",
                   arguments.options.samples_per_tile)
        ->default_str(std::to_string(arguments.options.samples_per_tile));
    command->add_option("--seed", arguments.options.seed, "Of the random numbers")
        ->type_name("N")
        ->capture_default_str();
    command
        ->add_option("--relax", arguments.options.relax_steps,
                     "Steps of relaxation on each of two levels, 1 or more")
        ->type_name("STEPS")
        ->capture_default_str();
    cli::add_common_options(*command, arguments.common);
    command->footer(std::string(split_footer) + cli::exit_code_help);
    return command;
}

// "2/8": the third of eight.
std::string take_share(const std::string& text, MeshArguments& arguments) {
    const std::size_t slash = text.find('/');
    const auto number = [](const std::string& digits) {
        return !digits.empty() && digits.size() < 10 &&
                       digits.find_first_not_of("0123456789") == std::string::npos
                   ? static_cast<agvd::Index>(std::stoul(digits))
                   : agvd::no_index;
    };
    const agvd::Index share = slash == std::string::npos ? agvd::no_index
                                                         : number(text.substr(0, slash)),
                      count = slash == std::string::npos ? agvd::no_index
                                                         : number(text.substr(slash + 1));
    if (share == agvd::no_index || count == agvd::no_index || share >= count) {
        return "the value is '" + text + "'; use I/K with I from 0 to K - 1";
    }
    arguments.share = share;
    arguments.num_shares = count;
    return "";
}

CLI::App* add_mesh(CLI::App& app, MeshArguments& arguments) {
    CLI::App* const command =
        app.add_subcommand("mesh",
                           "Make the meshes of tiles that have none, as many at a time as "
                           "there are threads");
    add_folder(*command, arguments, "Folder with the tiles");
    cli::start_group(*command, cli::heading::count);
    CLI::Option* const tiles =
        command->add_option("--tile", arguments.tiles, "Only these tiles, counted from 0")
            ->type_name("NUMBER");
    command
        ->add_option_function<std::string>(
            "--share",
            [&arguments](const std::string& text) {
                const std::string complaint = take_share(text, arguments);
                if (!complaint.empty()) throw CLI::ValidationError("--share", complaint);
            },
            "Only the tiles whose number leaves I when divided by K: for K processes")
        ->type_name("I/K")
        ->excludes(tiles);
    cli::add_common_options(*command, arguments.common);
    command->footer(std::string(mesh_footer) + cli::exit_code_help);
    return command;
}

CLI::App* add_join(CLI::App& app, JoinArguments& arguments) {
    CLI::App* const command =
        app.add_subcommand("join", "Join the meshes of all tiles, and write them to a file");
    add_folder(*command, arguments, "Folder with the meshes of all tiles");
    cli::add_mesh_output(*command, "OUT", "The result; the extension gives the format",
                         arguments.output)
        ->required();
    command->add_flag("--no-clobber", arguments.no_clobber, "Do not replace a file that exists");
    cli::add_common_options(*command, arguments.common);
    command->footer(std::string(join_footer) + cli::exit_code_help);
    return command;
}

void run_split(const SplitArguments& arguments, cli::Console& console) {
    remesh::SplitOptions options = arguments.options;
    options.num_threads = arguments.common.threads;
    options.progress = console.progress_of("split");
    const remesh::TilePlan plan =
        remesh::split_into_tiles(arguments.input, arguments.folder, options);
    console.info(std::to_string(plan.num_faces) + " faces in " + std::to_string(plan.num_tiles()) +
                 " tiles, with " + std::to_string(plan.num_sites) + " vertices on their borders");
    if (plan.crease_length > 0) console.warn(cli::creases_of_tiles_text(plan.crease_length));
}

void run_mesh(const MeshArguments& arguments, cli::Console& console) {
    const remesh::TilePlan plan = remesh::read_tile_plan(arguments.folder);
    std::vector<agvd::Index> tiles = arguments.tiles;
    if (tiles.empty()) {
        for (agvd::Index t = arguments.share; t < plan.num_tiles(); t += arguments.num_shares) {
            tiles.push_back(t);
        }
    }
    const auto [made, there] = remesh::mesh_tiles(
        arguments.folder, tiles,
        {.num_threads = arguments.common.threads, .progress = console.progress_of("mesh")});
    console.info(std::to_string(made) + " tiles meshed, " + std::to_string(there) + " were there");
}

void run_join(const JoinArguments& arguments, cli::Console& console) {
    if (arguments.no_clobber) cli::require_new(arguments.output);
    cli::check_format({arguments.output});
    cli::check_output(arguments.output, {});
    const remesh::JoinedTiles joined = remesh::join_tiles(
        arguments.folder,
        {.num_threads = arguments.common.threads, .progress = console.progress_of("join")});
    remesh::write_mesh(arguments.output, joined.mesh.view(), console.progress_of("write"));
    console.info(std::to_string(joined.mesh.positions.size()) + " vertices, " +
                 std::to_string(joined.mesh.triangles.size()) + " triangles, " +
                 std::to_string(joined.topology.components.size()) + " components of genus " +
                 std::to_string(joined.topology.genus()) + " with " +
                 std::to_string(joined.topology.boundary_loops()) + " boundary loops");
    if (joined.self_intersections.value_or(0) > 0) {
        console.warn(std::to_string(*joined.self_intersections) + " pairs of triangles intersect");
    }
}

template <typename Arguments>
void run(const Arguments& arguments, void (*job)(const Arguments&, cli::Console&)) {
    cli::Console console(arguments.common);
    console.run([&] { job(arguments, console); });
}

}  // namespace

int main(int argc, char** argv) {
    cli::begin_process(argc, argv);
    CLI::App app("Meshes larger than memory, in tiles.", "remesh-tiles");
    app.require_subcommand(1);
    app.footer(std::string(footer) + cli::exit_code_help);
    SplitArguments for_split;
    MeshArguments for_mesh;
    JoinArguments for_join;
    const CLI::App* const split = add_split(app, for_split);
    const CLI::App* const mesh = add_mesh(app, for_mesh);
    add_join(app, for_join);
    return cli::run(app, argc, argv, [&] {
        if (split->parsed()) {
            run(for_split, run_split);
        } else if (mesh->parsed()) {
            run(for_mesh, run_mesh);
        } else {
            run(for_join, run_join);
        }
    });
}
