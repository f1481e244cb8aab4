// The main program: reads a mesh and writes the dual of its geodesic Voronoi diagram. It checks all
// output paths before the long work, runs remesh::remesh(), and writes mesh and report together,
// so that either both are new or none is. With --out-dir it does so for many meshes (batch.h).
#include <CLI/CLI.hpp>
#include <charconv>
#include <iterator>
#include <span>
#include <utility>

#include "arguments.h"
#include "attributes.h"
#include "batch.h"
#include "expected_stages.h"
#include "help.h"
#include "levels.h"
#include "mesh_paths.h"
#include "mesh_run.h"
#include "page/thin_mesh.h"
#include "page_cells.h"
#include "page_outputs.h"
#include "region.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "report/report.h"
#include "shortfalls.h"
#include "sizing_arguments.h"
#include "stage_details.h"
#include "system/memory.h"
#include "system/process.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* footer =
    "Examples:\n"
    "  remesh bunny.ply --samples 2000 out.obj\n"
    "  remesh scan.stl -n 5000 -o scan.ply --report scan.json\n"
    "  remesh part.stl --edge-length 2% --adaptive part.obj\n"
    "  remesh part.off --sites sites.txt part.obj --report - | jq .\n"
    "  remesh *.obj --out-dir out -n 2000 --report out.json\n"
    "  remesh statue.glb lod.glb --levels 8000,2000,500\n\n"
    "With --out-dir each mesh becomes DIR/NAME, NAME being that of the input; .ply\n"
    "replaces an extension that cannot be written. A mesh that fails does not stop\n"
    "the rest; the failures are listed at the end. An interruption keeps the meshes\n"
    "that are finished. --report gets a JSON array with the report of each mesh.\n\n";

// Of remesh only: see cli::exit_code_help.
constexpr const char* batch_exit_code_help =
    "\n  6  some meshes of --out-dir failed, all others are done";

// Of --wrap without a value.
constexpr const char* automatic = "auto";

struct Arguments : cli::DiagramArguments {
    std::vector<fs::path> further;  // Positional arguments after IN.
    fs::path output;
    fs::path folder;  // Of many outputs; empty: there is one.
    bool no_clobber = false;
    std::string to;  // Format of the outputs; empty: by the extension.
    bool ascii = false;
    int relax_steps = remesh::RemeshOptions{}.relax_steps;
    agvd::Index samples_per_tile = remesh::RemeshOptions{}.samples_per_tile;
    bool keep_sites = false;
    std::optional<bool> fit;
    fs::path report;  // Empty: none; "-": stdout.
    remesh::VertexCount vertex_count = remesh::VertexCount::Exact;
    double drop_components = 0;
    std::optional<cli::Amount> weld;
    std::optional<cli::Amount> wrap;  // 0: half a spacing.
    bool strict = false;
    remesh::Delaunay delaunay = remesh::RemeshOptions{}.delaunay;
    remesh::Features features = remesh::RemeshOptions{}.features;
    double feature_angle = remesh::RemeshOptions{}.feature_angle;
    fs::path feature_edges;  // Empty: none.
    remesh::Junctions junctions = remesh::RemeshOptions{}.junctions;
    cli::SizingArguments sizing;
    cli::LevelArguments levels;
    cli::AttributeArguments attributes;
    cli::RegionArguments region;
    cli::PageArguments page;
};

std::map<std::string, remesh::Delaunay> delaunay_by_name() {
    return cli::by_name(
        {remesh::Delaunay::Intrinsic, remesh::Delaunay::Extrinsic, remesh::Delaunay::Off},
        remesh::delaunay_name);
}

// auto, off, or degrees above 0 and below 180.
// \return what is wrong with other values; otherwise empty.
std::string take_features(const std::string& text, Arguments& arguments) {
    if (text == "auto" || text == "off") {
        arguments.features = text == "auto" ? remesh::Features::Auto : remesh::Features::Off;
        return "";
    }
    double angle = 0;
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, angle);
    if (error != std::errc{} || last != end || !(angle > 0 && angle < 180)) {
        return "the value is '" + text +
               "'; use auto, off or an angle above 0 and below 180 degrees";
    }
    arguments.features = remesh::Features::Angle;
    arguments.feature_angle = angle;
    return "";
}

void add_feature_options(CLI::App& app, Arguments& arguments) {
    const auto take = [&arguments](const std::string& text) {
        const std::string complaint = take_features(text, arguments);
        if (!complaint.empty()) throw CLI::ValidationError("--features", complaint);
    };
    cli::start_group(app, cli::heading::curves);
    CLI::Option* const features =
        app.add_option_function<std::string>(
               "--features,--crease", take,
               "Creases that the result keeps as chains of edges: those long and strong enough for "
               "the spacing of the sites (auto), all above an angle in degrees, or none (off)")
            ->type_name("auto|DEG|off")
            ->default_str("auto");
    cli::add_file(app, "--feature-edges", arguments.feature_edges,
                  "Edges that are creases whatever their angle: lines of two vertices, counted "
                  "from 0")
        ->type_name("FILE");
    const auto take_junctions = [&arguments](const std::string& name) {
        arguments.junctions = name == "keep" ? remesh::Junctions::Keep : remesh::Junctions::Apart;
    };
    cli::add_choice(
        app,
        {"--junctions",
         {"apart", "keep"},
         "apart",
         "Sheets of the result where an edge of the input has more than two faces. apart: each "
         "sheet has its own vertices, at the same points; keep: the sheets are welded"},
        take_junctions);
    app.add_flag_callback(
           "--no-features", [&arguments] { arguments.features = remesh::Features::Off; },
           "The same as --features off")
        ->excludes(features);
}

// Which vertices and edges the result has.
void add_result_options(CLI::App& app, Arguments& arguments) {
    cli::start_group(app, cli::heading::count);
    cli::add_choice(
        app,
        {"--topology",
         {"exact", "add"},
         "exact",
         "Number of vertices; the topology is always kept. exact: N; add: N and those that the "
         "topology needs"},
        [&arguments](const std::string& name) {
            arguments.vertex_count =
                name == "add" ? remesh::VertexCount::Add : remesh::VertexCount::Exact;
        });
    cli::start_group(app, cli::heading::curves);
    cli::add_choice(
        app,
        {"--boundary",
         {"keep", "free"},
         "keep",
         "keep: boundary vertices lie on the input's boundary, and its corners are vertices; "
         "free: boundary vertices lie near it"},
        [&arguments](const std::string& name) {
            arguments.sampling.boundary =
                name == "free" ? remesh::Boundary::Free : remesh::Boundary::Keep;
        });
    cli::start_group(app, cli::heading::relaxation);
    cli::add_choice(
        app,
        {"--delaunay", cli::names_of(delaunay_by_name()), remesh::delaunay_name(arguments.delaunay),
         "Flip edges that fail the Delaunay condition by geodesic lengths (intrinsic) or by "
         "straight lengths (extrinsic); off: flip none"},
        [&arguments](const std::string& name) {
            arguments.delaunay = delaunay_by_name().at(name);
        });
}

void add_options(CLI::App& app, Arguments& arguments) {
    cli::add_diagram_options(app, arguments);
    add_result_options(app, arguments);
    add_feature_options(app, arguments);
    cli::add_sizing_options(app, arguments.sizing);
    cli::add_level_option(app, arguments.levels);
    cli::add_attribute_options(app, arguments.attributes);
    cli::start_group(app, cli::heading::files);
    app.add_option("--drop-components", arguments.drop_components,
                   "Drop components with less than this percentage of the area")
        ->check(CLI::Range(0.0, 100.0).description(""))
        ->type_name("PERCENT")
        ->capture_default_str();
    cli::add_length(app, "--weld",
                    "Weld vertices of the boundary within this distance, in mesh units or percent "
                    "of the diagonal, and within less than half of each edge there",
                    arguments.weld)
        ->excludes(app.get_option("--keep-slits"));
    app.add_option("--fill-holes", arguments.cleaning.fill_holes,
                   "Fill holes of at most N edges; 0: none")
        ->check(CLI::Range(0, 1'000'000).description(""))
        ->type_name("N")
        ->capture_default_str();
    const auto take_wrap = [&arguments](const std::string& text) {
        arguments.wrap = text == automatic ? cli::Amount{} : cli::parse_amount(text);
        if (arguments.wrap) return;
        throw CLI::ValidationError(
            "--wrap", "the value is '" + text + "'; use a length above 0, or a percentage");
    };
    app.add_option_function<std::string>("--wrap", take_wrap,
                                         "Remesh the outside of the mesh as balls of this radius "
                                         "see it, in mesh units or percent "
                                         "of the diagonal: one closed surface without "
                                         "intersections, whatever the mesh; holes and "
                                         "gaps narrower than 1.6 radii are closed, what lies "
                                         "inside is gone. Without a value half "
                                         "the spacing of the samples; solids without "
                                         "such gaps are united exactly")
        ->type_name("[L|L%]")
        ->excludes(app.get_option("--sites"))
        ->excludes(app.get_option("--feature-edges"))
        ->excludes(app.get_option("--max-distance"));
    cli::add_region_options(app, arguments.region);
    cli::start_group(app, cli::heading::running);
    app.add_flag(
        "--strict", arguments.strict,
        "Fail (exit code 5) if the result has more pairs of intersecting faces than the input, or "
        "is too coarse for creases, walls or components");
    cli::start_group(app, cli::heading::relaxation);
    app.add_option("--relax,--lloyd", arguments.relax_steps,
                   "Number of relaxation steps; 0: the sites stay as sampled")
        ->check(CLI::Range(0, 1'000'000).description(""))
        ->type_name("K")
        ->capture_default_str();
    app.add_flag("--keep-sites", arguments.keep_sites, "Do not relax the sites of --sites")
        ->needs("--sites");
    app.add_option("--tile", arguments.samples_per_tile,
                   "Vertices of a tile, at most: results of more than 5/4 as many are made in "
                   "tiles, which takes less memory and keeps threads busy; 0: in one piece")
        ->check(CLI::Range(0, 1'000'000'000).description(""))
        ->type_name("N")
        ->capture_default_str();
    CLI::Option* const fit = app.add_flag_callback(
        "--fit", [&arguments] { arguments.fit = true; },
        "Let vertices leave the surface so that the triangles lie nearer to it; the default if "
        "sites are relaxed");
    app.add_flag_callback(
           "--no-fit", [&arguments] { arguments.fit = false; }, "Vertices stay on the surface")
        ->excludes(fit);
}

// Whether --wrap has a value is told by what follows it: it may be a file.
std::vector<const char*> with_value_of_wrap(std::span<char* const> arguments) {
    std::vector<const char*> result;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        result.push_back(arguments[i]);
        if (std::string_view(arguments[i]) != "--wrap") continue;
        const bool has_value =
            i + 1 < arguments.size() && (cli::parse_amount(arguments[i + 1]) ||
                                         std::string_view(arguments[i + 1]) == automatic);
        if (!has_value) result.push_back(automatic);
    }
    return result;
}

void add_output_options(CLI::App& app, Arguments& arguments) {
    cli::start_group(app, cli::heading::files);
    cli::add_mesh_outputs(app, "OUT",
                          "Mesh to write: " + cli::mesh_extensions() +
                              "; an existing file is replaced; - writes standard output, with "
                              "--to. With --out-dir: more meshes to read",
                          arguments.further);
    CLI::Option* const output =
        cli::add_mesh_output(app, "-o,--output", "The same as OUT", arguments.output)
            ->type_name("FILE");
    cli::add_format_option(app, "--to",
                           "Format of OUT where no extension names it, or of all files in "
                           "--out-dir: " +
                               remesh::mesh_formats(),
                           arguments.to);
    cli::add_ascii(app, arguments.ascii);
    cli::add_file(app, "--out-dir", arguments.folder,
                  "Read many meshes, and write each to a file of its name in this folder")
        ->excludes(output)
        ->excludes("--map")
        ->type_name("DIR");
    app.add_flag("--no-clobber", arguments.no_clobber,
                 "Never replace a file: exit code 3 if an output exists; with --out-dir the mesh "
                 "is skipped")
        ->excludes("--force");
    cli::add_file(app, "--report", arguments.report,
                  "Write a JSON report, also of a run that fails; - writes it to stdout")
        ->type_name("FILE|-");
    cli::add_page_options(app, arguments.page);
    for (const char* const name : {"--html", "--picture"}) {
        app.get_option(name)->excludes("--out-dir");
    }
}

// Those of each level, with the names of its files.
std::vector<Arguments> arguments_of_levels(const Arguments& arguments) {
    const std::vector<fs::path> outputs = cli::level_paths(arguments.levels, arguments.output),
                                maps = cli::level_paths(arguments.levels, arguments.attributes.map),
                                pages = cli::level_paths(arguments.levels, arguments.page.html),
                                pictures =
                                    cli::level_paths(arguments.levels, arguments.page.picture);
    std::vector<Arguments> levels(outputs.size(), arguments);
    for (std::size_t level = 0; level < levels.size(); ++level) {
        levels[level].output = outputs[level];
        levels[level].attributes.map = maps[level];
        levels[level].page.html = pages[level];
        levels[level].page.picture = pictures[level];
    }
    return levels;
}

void check_outputs(const Arguments& arguments) {
    cli::check_format({arguments.output, arguments.to});
    cli::check_page_options(arguments.page);
    cli::check_one_on_stdout(arguments.output, arguments.report, "--report");
    struct Output {
        const char* name;
        const fs::path& path;
    };
    std::vector<Output> checked;
    for (const Output& output :
         {Output{"the output", arguments.output}, Output{"--report", arguments.report},
          Output{"--map", arguments.attributes.map}, Output{"--html", arguments.page.html},
          Output{"--picture", arguments.page.picture}}) {
        if (output.path.empty() || (&output.path == &arguments.report && output.path == "-")) {
            continue;
        }
        if (arguments.no_clobber) cli::require_new(output.path);
        cli::check_output(
            output.path,
            {arguments.input, arguments.sites, arguments.feature_edges, arguments.region.lock},
            arguments.force);
        for (const Output& other : checked) {
            if (!cli::is_same_file(output.path, other.path)) continue;
            throw agvd::InvalidOption(std::string(output.name) + " and " + other.name +
                                      " name the same file, " + output.path.string() +
                                      "; choose another file");
        }
        checked.push_back(output);
    }
}

// Adds what the file itself wants kept to what the command line does.
void keep_wanted(const Arguments& arguments, const remesh::MeshFile& input,
                 remesh::RemeshOptions& options, cli::Console& console) {
    const bool has_edges =
        !input.feature_edges.empty() && options.features != remesh::Features::Off;
    const bool has_locks = !input.locked.empty() || !input.locked_edges.empty();
    const std::string file = arguments.input.string() + ": ";
    if (has_edges) {
        options.feature_edges.insert(options.feature_edges.end(), input.feature_edges.begin(),
                                     input.feature_edges.end());
        console.info(file + std::to_string(input.feature_edges.size()) +
                     " edges of the file are feature edges");
    }
    if (has_locks && options.sites) {
        console.warn(file +
                     "its corners, required vertices and required edges may move, as --sites names "
                     "the vertices");
    } else if (has_locks) {
        options.locked.insert(options.locked.end(), input.locked.begin(), input.locked.end());
        options.locked_edges = input.locked_edges;
        console.info(file + std::to_string(input.locked.size()) + " vertices and " +
                     std::to_string(input.locked_edges.size()) + " edges of the file are locked");
    }
}

// What all levels are made of.
struct Input {
    remesh::MeshFile file;
    remesh::AttributeReport attributes;
    bool is_needed = true;              // After remesh() as well.
    std::size_t num_vertices = 0;       // Of which percentages are taken.
    remesh::RemeshOptions options;      // Of level 0.
    std::vector<std::string> warnings;  // So far.
};

Input prepare(const Arguments& arguments, cli::Console& console) {
    const bool wants_attributes = cli::wants_attributes(arguments.attributes) ||
                                  cli::wants_attributes(arguments.sizing) ||
                                  !arguments.region.region.empty();
    console.expect(cli::stages_with_reading(arguments.input, arguments.sampling.num_samples));
    remesh::MeshFile input = cli::read_input(
        arguments, console, wants_attributes ? cli::WithAttributes::Yes : cli::WithAttributes::No);
    // Of the file, before those that are not carried over are removed.
    std::vector<agvd::Index> labels =
        cli::labels_to_keep(arguments.attributes, arguments.input, input.attributes);
    remesh::Sizing sizing =
        cli::sizing_for(arguments.sizing, arguments.input, input, console.progress_of("read"));
    std::vector<std::uint8_t> region = cli::region_for(arguments.region, arguments.input, input);
    const remesh::AttributeReport attributes =
        cli::select_attributes(arguments.attributes, arguments.input,
                               {arguments.output, arguments.to}, input.attributes, console);
    const bool needs_map = cli::needs_map(arguments.attributes, input.attributes);
    if (!needs_map && arguments.sites.empty()) {
        std::vector<agvd::Index>().swap(input.face_polygon);  // Not used any more.
    }
    console.info(cli::describe(arguments.input, input.mesh.view()));
    // Otherwise memory that half a stage has freed between its results would stay in use. Less than
    // a small run takes in all is kept: each page that comes back is cleared anew, a fifth of the
    // time of bunny with 2000.
    constexpr std::size_t kept_free = std::size_t{3} << 24;
    const auto progress = [&, last = std::pair(remesh::Stage::Clean, false)](
                              remesh::Stage stage, double fraction) mutable {
        const bool goes_on = console.progress(remesh::stage_name(stage), fraction);
        const std::pair now(stage, fraction >= 0.5);
        if (std::exchange(last, now) != now) cli::return_free_memory(kept_free);
        return goes_on;
    };
    const std::size_t num_vertices = cli::num_vertices_in(region, input.mesh.view());
    remesh::RemeshOptions options{.num_samples = cli::num_samples_for(arguments, num_vertices),
                                  .cleaning = arguments.cleaning,
                                  .sizing = std::move(sizing),
                                  .vertex_count = arguments.vertex_count,
                                  .boundary = arguments.sampling.boundary,
                                  .bounds = cli::bounds_for(arguments.sizing, input.mesh.view()),
                                  .drop_components = arguments.drop_components / 100,
                                  .init = arguments.sampling.init,
                                  .features = arguments.features,
                                  .feature_angle = arguments.feature_angle,
                                  .face_labels = std::move(labels),
                                  .texture_seams = input.attributes.texture.seams,
                                  .junctions = arguments.junctions,
                                  .lock_boundary = arguments.region.lock_boundary,
                                  .region = std::move(region),
                                  .seed = arguments.sampling.seed,
                                  .relax_steps = arguments.relax_steps,
                                  .keep_sites = arguments.keep_sites,
                                  .samples_per_tile = arguments.samples_per_tile,
                                  .fit = arguments.fit,
                                  .delaunay = arguments.delaunay,
                                  .num_threads = arguments.common.threads,
                                  .progress = progress};
    const agvd::PropagationOptions& asked = arguments.propagation;
    options.propagation = {.engine = asked.engine,
                           .max_error = asked.max_error,
                           .steiner_points = asked.steiner_points,
                           .lambda = asked.lambda};
    if (arguments.sample_percent > 0 && options.vertex_count == remesh::VertexCount::Exact) {
        options.vertex_count = remesh::VertexCount::Raise;
    }
    if (arguments.weld) {
        options.cleaning.weld = cli::length_of(*arguments.weld, input.mesh.view());
    }
    if (arguments.wrap) options.wrap = cli::length_of(*arguments.wrap, input.mesh.view());
    if (!arguments.sites.empty()) {
        remesh::SitesFile given = cli::read_given_sites(arguments, input, console);
        cli::require_plain_points(arguments.sites, given.points, given.shapes.size(),
                                  "vertices are made of");
        options.sites = std::move(given.sites);
    }
    if (!arguments.feature_edges.empty()) {
        options.feature_edges =
            remesh::read_edges(arguments.feature_edges, console.progress_of("read"));
    }
    if (!arguments.region.lock.empty()) {
        options.locked = remesh::read_vertices(arguments.region.lock, input.mesh.view(),
                                               console.progress_of("read"));
    }
    keep_wanted(arguments, input, options, console);
    return {
        .file = std::move(input),
        .attributes = attributes,
        .is_needed = needs_map || arguments.levels.count > 1 || cli::wants_pages(arguments.page),
        .num_vertices = num_vertices,
        .options = std::move(options),
        .warnings = console.warnings()};
}

// Tells the bar of the levels still to come, the last one first.
void expect_levels(std::span<const remesh::RemeshOptions> to_come, const Input& input,
                   cli::Console& console) {
    const agvd::MeshView mesh = input.file.mesh.view();
    std::vector<cli::ExpectedStage> stages;
    for (std::size_t level = to_come.size(); level-- > 0;) {
        const remesh::RemeshOptions& options = to_come[level];
        const auto of_level = cli::stages_of_remesh(
            mesh.triangles.size(), cli::estimated_samples(options, mesh), input.is_needed, options);
        stages.insert(stages.end(), of_level.begin(), of_level.end());
    }
    console.expect(std::move(stages), cli::runs_of_remesh(to_come.back()));
}

// Page and picture.
// \param info  of the report, which the page holds as well.
void add_pages(const Arguments& arguments, const Input& input, const remesh::RemeshResult& result,
               const remesh::MeshAttributes& carried, const remesh::RunInfo& info,
               cli::Console& console, cli::Products& products) {
    page::Page page{.report = remesh::to_json(result, info),
                    .original_name = arguments.input.filename().string(),
                    .result_name = arguments.output.filename().string(),
                    .original = input.file.mesh.view(),
                    .result = result.mesh.view(),
                    .targets = result.sizing.targets,
                    .original_labels = cli::labels_for_page(input.file.attributes),
                    .result_labels = cli::labels_for_page(carried),
                    .original_colors = cli::colors_for_page(input.file.attributes),
                    .result_colors = cli::colors_for_page(carried),
                    .options = info.options};
    if (!arguments.page.html.empty()) {
        if (page.original.triangles.size() <= page::most_faces && result.kept.faces.empty()) {
            page.cells =
                cli::cells_for_page(page.original, result.sites, info.options,
                                    [&](const char* stage) { return console.progress_of(stage); });
        }
        page.evaluation = cli::naming_file(arguments.input, [&] {
            return remesh::evaluate(page.original, page.result,
                                    {.num_threads = arguments.common.threads,
                                     .progress = console.progress_of("measure")});
        });
    }
    for (remesh::FileContent& file :
         cli::make_pages(arguments.page, std::move(page), console.progress_of("page"))) {
        products.files.push_back(std::move(file));
    }
}

// A level, or the only result.
// \param arguments, options  of this level.
cli::Products make_level(const Arguments& arguments, const remesh::RemeshOptions& options,
                         Input& input, cli::Console& console) {
    const bool is_one_of_many = arguments.levels.count > 1;
    if (is_one_of_many) console.info("level " + arguments.output.string());
    const std::size_t num_warnings = console.warnings().size();
    const std::size_t num_faces = input.file.mesh.triangles.size();
    const std::size_t num_samples = cli::estimated_samples(options, input.file.mesh.view());
    console.require_memory("sample", cli::least_memory(num_faces, num_samples));
    const remesh::RemeshResult result = cli::naming_file(
        arguments.input.string() +
            (is_one_of_many ? ", for " + arguments.output.string() : std::string()),
        [&] {
            return input.is_needed ? remesh::remesh(input.file.mesh.view(), options)
                                   : remesh::remesh_moved(std::move(input.file.mesh), options);
        },
        arguments.sites);
    console.end_stage();
    console.detail(cli::stage_details(result, num_faces));
    for (const std::string& text : cli::shortfalls_of(result, options, arguments.strict)) {
        console.warn(text);
    }
    remesh::RunInfo info{.version = REMESH_VERSION,
                         .input_path = arguments.input.string(),
                         .output_path = arguments.output.string(),
                         .options = options,
                         .attributes = input.attributes};
    const agvd::Progress writing = console.progress_of("write");
    cli::Products products;
    const remesh::MeshAttributes carried =
        cli::carry_attributes(arguments.attributes, input.file, result, arguments.common.threads,
                              console.progress_of("transfer"), products.files);
    const remesh::MeshPath target{arguments.output, arguments.to};
    std::string bytes = remesh::format_mesh(target, result.mesh.view(), carried, writing);
    if (arguments.ascii && bytes.starts_with("ply")) bytes = remesh::ply_as_text(std::move(bytes));
    products.files.push_back({arguments.output, std::move(bytes)});
    const remesh::RoundingLoss loss = remesh::rounding_loss(target, result.mesh.view(), writing);
    if (loss.matters()) console.warn(remesh::describe(loss, target));
    if (!arguments.report.empty() || !arguments.page.html.empty()) {
        info.output = remesh::measure_figures(result.mesh.view(), writing);
        info.warnings = input.warnings;
        const auto more = std::span(console.warnings()).subspan(num_warnings);
        info.warnings.insert(info.warnings.end(), more.begin(), more.end());
    }
    if (!arguments.report.empty()) {
        products.reports = {remesh::to_json(result, info)};
    }
    if (cli::wants_pages(arguments.page)) {
        add_pages(arguments, input, result, carried, info, console, products);
    }
    console.detail(remesh::details_to_text(result, info));
    products.text = remesh::to_text(result, info);
    return products;
}

cli::Products make_products(const Arguments& arguments, cli::Console& console) {
    Input input = prepare(arguments, console);
    const std::vector<Arguments> levels = arguments_of_levels(arguments);
    std::vector<remesh::RemeshOptions> options;
    for (std::size_t level = 0; level < levels.size(); ++level) {
        options.push_back(
            cli::options_of_level(arguments.levels, level, input.options, input.num_vertices));
    }
    cli::Products products;
    // Coarse levels first: too few samples are found before the long work.
    for (std::size_t level = levels.size(); level-- > 0;) {
        expect_levels(std::span(options).first(level + 1), input, console);
        cli::Products more = make_level(levels[level], options[level], input, console);
        std::move(products.files.begin(), products.files.end(), std::back_inserter(more.files));
        std::move(products.reports.begin(), products.reports.end(),
                  std::back_inserter(more.reports));
        if (!products.text.empty()) more.text += '\n' + products.text;
        products = std::move(more);
    }
    return products;
}

// \param arguments, console  outlive the run.
cli::MeshRun run_of(const Arguments& arguments, cli::Console& console) {
    return {.input = arguments.input,
            .output = cli::level_paths(arguments.levels, arguments.output).front(),
            .report = arguments.report,
            .has_levels = arguments.levels.count > 1,
            .no_clobber = arguments.no_clobber,
            .check_outputs =
                [&] {
                    for (const Arguments& level : arguments_of_levels(arguments)) {
                        check_outputs(level);
                    }
                },
            .make = [&] { return make_products(arguments, console); }};
}

void run_one(Arguments arguments) {
    // OUT or --output.
    if (!arguments.output.empty()) arguments.further.push_back(arguments.output);
    if (arguments.to.empty()) cli::check_no_label(arguments.attributes, arguments.further);
    arguments.output = cli::only_output(arguments.further);
    cli::Console console(arguments.common, cli::limit_of(arguments));
    cli::run_alone(run_of(arguments, console), console);
}

void run_many(const Arguments& arguments) {
    cli::BatchArguments batch{.inputs = {arguments.input},
                              .folder = arguments.folder,
                              .to = arguments.to,
                              .levels = arguments.levels,
                              .report = arguments.report,
                              .force = arguments.force};
    batch.inputs.insert(batch.inputs.end(), arguments.further.begin(), arguments.further.end());
    const std::vector<cli::BatchMesh> meshes = cli::plan_batch(batch);
    if (arguments.no_clobber && arguments.report != "-") cli::require_new(arguments.report);
    const auto run_mesh = [&](const cli::BatchMesh& mesh) {
        Arguments of_mesh = arguments;
        of_mesh.input = mesh.input;
        of_mesh.output = mesh.output;
        cli::Console console(of_mesh.common, cli::limit_of(of_mesh));
        return cli::run_in_batch(run_of(of_mesh, console), console);
    };
    cli::Console console(arguments.common);
    cli::run_batch(batch, meshes, run_mesh, console);
}

}  // namespace

int main(int argc, char** argv) {
    cli::tune_heap();
    cli::begin_process(argc, argv);
    CLI::App app("Replaces a mesh by the dual of its geodesic Voronoi diagram.", "remesh");
    Arguments arguments;
    add_options(app, arguments);
    add_output_options(app, arguments);
    app.footer(std::string(footer) + cli::exit_code_help + batch_exit_code_help);
    arguments.page.command = page::to_shell(argc, argv, "remesh");
    const std::vector<const char*> given =
        with_value_of_wrap({argv, static_cast<std::size_t>(argc)});
    return cli::run(app, static_cast<int>(given.size()), given.data(), [&] {
        cli::check_levels(arguments.levels, arguments.sizing);
        if (arguments.folder.empty()) {
            run_one(arguments);
        } else {
            run_many(arguments);
        }
    });
}
