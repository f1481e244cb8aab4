// The main program: reads a mesh and writes the dual of its geodesic Voronoi diagram. It checks all
// output paths before the long work, runs remesh::remesh(), and writes mesh and report together,
// so that either both are new or none is.
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <utility>

#include "arguments.h"
#include "attributes.h"
#include "mesh_paths.h"
#include "region.h"
#include "remesh/io/atomic_file.h"
#include "remesh/io/read_edges.h"
#include "remesh/io/read_mesh.h"
#include "remesh/io/read_sites.h"
#include "remesh/io/read_vertices.h"
#include "remesh/io/report.h"
#include "remesh/io/write_mesh.h"
#include "remesh/pipeline/remesh.h"
#include "sizing_arguments.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* footer =
    "Examples:\n"
    "  remesh bunny.ply --samples 2000 out.obj\n"
    "  remesh scan.stl -n 5000 -o scan.ply --report scan.json\n"
    "  remesh part.stl --edge-length 2% --adaptive part.obj\n"
    "  remesh part.off --sites sites.txt part.obj --report - | jq .\n\n";

struct Arguments : cli::DiagramArguments {
    fs::path output;
    std::string to;  // Its format; empty: by the extension.
    int relax_steps = remesh::RemeshOptions{}.relax_steps;
    bool keep_sites = false;
    std::optional<bool> fit;
    fs::path report;  // Empty: none; "-": stdout.
    remesh::VertexCount vertex_count = remesh::VertexCount::Exact;
    double drop_components = 0;
    bool strict = false;
    remesh::Delaunay delaunay = remesh::RemeshOptions{}.delaunay;
    remesh::Features features = remesh::RemeshOptions{}.features;
    double feature_angle = remesh::RemeshOptions{}.feature_angle;
    fs::path feature_edges;  // Empty: none.
    remesh::Junctions junctions = remesh::RemeshOptions{}.junctions;
    cli::SizingArguments sizing;
    cli::AttributeArguments attributes;
    cli::RegionArguments region;
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
    CLI::Option* const features =
        app.add_option_function<std::string>(
               "--features,--crease", take,
               "Creases that the result keeps as chains of edges: those long and strong enough for "
               "the spacing of the sites (auto), all above an angle in degrees, or none (off)")
            ->type_name("auto|DEG|off")
            ->default_str("auto");
    app.add_option("--feature-edges", arguments.feature_edges,
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
    cli::add_attribute_options(app, arguments.attributes);
    app.add_option("--drop-components", arguments.drop_components,
                   "Drop components with less than this percentage of the area")
        ->check(CLI::Range(0.0, 100.0).description(""))
        ->type_name("PERCENT")
        ->capture_default_str();
    cli::add_region_options(app, arguments.region);
    app.add_flag(
        "--strict", arguments.strict,
        "Fail (exit code 5) if the result has more pairs of intersecting faces than the input, or "
        "is too coarse for creases, walls or components");
    app.add_option("--relax,--lloyd", arguments.relax_steps,
                   "Number of relaxation steps; 0: the sites stay as sampled")
        ->check(CLI::Range(0, 1'000'000).description(""))
        ->type_name("K")
        ->capture_default_str();
    app.add_flag("--keep-sites", arguments.keep_sites, "Do not relax the sites of --sites")
        ->needs("--sites");
    app.add_flag_function(
        "--fit,!--no-fit", [&arguments](std::int64_t count) { arguments.fit = count > 0; },
        "Let vertices leave the surface so that the triangles lie nearer to it; the default if "
        "sites are relaxed");
    cli::add_mesh_output(app, "OUT,-o,--output",
                         "Mesh to write: " + cli::mesh_extensions() +
                             "; an existing file is replaced; - writes standard output, with --to",
                         arguments.output)
        ->required();
    cli::add_format_option(app, "--to",
                           "Format of OUT where no extension names it: " + remesh::mesh_formats(),
                           arguments.to);
    app.add_option("--report", arguments.report, "Write a JSON report; - writes it to stdout")
        ->type_name("FILE|-");
}

// What the result is too coarse to show; empty: nothing.
std::string too_small(const remesh::RemeshResult& result) {
    std::string text;
    const auto add = [&](bool is_so, const char* what) {
        if (is_so) text += (text.empty() ? "" : ", ") + std::string(what);
    };
    add(result.features.dropped_length > 0, "creases");
    add(result.verdict.thin_walls > 0, "walls");
    add(result.verdict.small_components > 0, "components");
    return text;
}

// \throw agvd::ConstraintUnmet  with --strict.
void judge(const remesh::RemeshResult& result, bool strict, cli::Console& console) {
    if (const std::string small = too_small(result); strict && !small.empty()) {
        throw agvd::ConstraintUnmet("the result is too coarse for some " + small +
                                    "; use more --samples (without --strict the report tells how "
                                    "many), or leave out --strict");
    }
    const agvd::Index pairs = result.self_intersections.value_or(0);
    if (pairs <= result.input_self_intersections) return;
    const std::string text =
        "the result has " + std::to_string(pairs) + " pairs of intersecting faces, the input has " +
        std::to_string(result.input_self_intersections) + "; use more --samples";
    if (strict) throw agvd::ConstraintUnmet(text + ", or leave out --strict");
    console.warn(text);
}

// Warns of sheets that should be welded but could not be.
void warn_of_junctions(const remesh::JunctionCounts& counts, remesh::Junctions wanted,
                       cli::Console& console) {
    if (counts.apart_edges == 0 || wanted == remesh::Junctions::Apart) return;
    console.warn("the sheets at " + std::to_string(counts.apart_edges) +
                 " non-manifold edges of the input could not be welded; use more --samples, and "
                 "leave out --sites and --boundary free");
}

// Warns of bounds of the edges that give way to the number of vertices.
void warn_of_bounds(const remesh::SizingResult& sizes, const remesh::Sizing& wanted,
                    cli::Console& console) {
    constexpr double tolerance = 0.02;
    const std::string count = std::to_string(sizes.num_samples) + " vertices are too ";
    if (sizes.largest_target > (1 + tolerance) * wanted.max_edge) {
        console.warn(count + "few for --max-edge; use more, or longer edges");
    }
    if (sizes.largest_target > 0 && sizes.least_target < (1 - tolerance) * wanted.min_edge) {
        console.warn(count + "many for --min-edge; use fewer, or shorter edges");
    }
}

// Warns of a shape that suffers in the single precision of the format.
void warn_of_rounding(const remesh::MeshPath& target, const agvd::MeshView& mesh,
                      const agvd::Progress& progress, cli::Console& console) {
    const std::string text =
        remesh::describe(remesh::rounding_loss(target, mesh, progress), target);
    if (!text.empty()) console.warn(text);
}

void check_outputs(const Arguments& arguments) {
    static_cast<void>(remesh::mesh_format({arguments.output, arguments.to}));  // Is it known?
    cli::check_one_on_stdout(arguments.output, arguments.report, "--report");
    struct Output {
        const char* name;
        const fs::path& path;
    };
    std::vector<Output> checked;
    for (const Output& output :
         {Output{"the output", arguments.output}, Output{"--report", arguments.report},
          Output{"--map", arguments.attributes.map}}) {
        if (output.path.empty() || (&output.path == &arguments.report && output.path == "-")) {
            continue;
        }
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

// Bytes that a run needs at least. Meshes of 1 000 to 100 000 faces with 9 000 to 100 000 samples
// took 4000 to 7000 bytes a sample beyond 300 a face.
std::size_t least_memory(std::size_t num_faces, std::size_t num_samples) {
    return 200 * num_faces + 3000 * num_samples;
}

void run_job(const Arguments& arguments, cli::Console& console) {
    check_outputs(arguments);
    const bool wants_attributes = cli::wants_attributes(arguments.attributes) ||
                                  cli::wants_attributes(arguments.sizing) ||
                                  !arguments.region.region.empty();
    remesh::MeshFile input = cli::read_input(
        arguments, console, wants_attributes ? cli::WithAttributes::Yes : cli::WithAttributes::No);
    // Of the file, before those that are not carried over are removed.
    std::vector<agvd::Index> labels =
        cli::labels_to_keep(arguments.attributes, arguments.input, input.attributes);
    remesh::Sizing sizing = cli::sizing_for(arguments.sizing, arguments.input, input);
    std::vector<std::uint8_t> region = cli::region_for(arguments.region, arguments.input, input);
    const remesh::AttributeReport attributes =
        cli::select_attributes(arguments.attributes, arguments.input,
                               {arguments.output, arguments.to}, input.attributes, console);
    const bool needs_input = cli::needs_map(arguments.attributes, input.attributes);
    if (!needs_input) std::vector<agvd::Index>().swap(input.face_polygon);  // Not used any more.
    console.info(cli::describe(arguments.input, input.mesh.view()));
    // Otherwise memory that half a stage has freed between its results would stay in use.
    const auto progress = [&, last = std::pair(remesh::Stage::Clean, false)](
                              remesh::Stage stage, double fraction) mutable {
        const bool goes_on = console.progress(remesh::stage_name(stage), fraction);
        const std::pair now(stage, fraction >= 0.5);
        if (std::exchange(last, now) != now) ::malloc_trim(0);
        return goes_on;
    };
    const std::size_t num_vertices = cli::num_vertices_in(region, input.mesh.view());
    remesh::RemeshOptions options{.num_samples = cli::num_samples_for(arguments, num_vertices),
                                  .sizing = std::move(sizing),
                                  .vertex_count = arguments.vertex_count,
                                  .boundary = arguments.sampling.boundary,
                                  .drop_components = arguments.drop_components / 100,
                                  .init = arguments.sampling.init,
                                  .features = arguments.features,
                                  .feature_angle = arguments.feature_angle,
                                  .face_labels = std::move(labels),
                                  .junctions = arguments.junctions,
                                  .region = std::move(region),
                                  .seed = arguments.sampling.seed,
                                  .relax_steps = arguments.relax_steps,
                                  .keep_sites = arguments.keep_sites,
                                  .fit = arguments.fit,
                                  .propagation = arguments.propagation,
                                  .delaunay = arguments.delaunay,
                                  .num_threads = arguments.common.threads,
                                  .progress = progress};
    if (!arguments.sites.empty()) {
        options.sites =
            remesh::read_sites(arguments.sites, input.mesh.view(), console.progress_of("read"));
    }
    if (!arguments.feature_edges.empty()) {
        options.feature_edges =
            remesh::read_edges(arguments.feature_edges, console.progress_of("read"));
    }
    if (!arguments.region.lock.empty()) {
        options.locked = remesh::read_vertices(arguments.region.lock, input.mesh.view(),
                                               console.progress_of("read"));
    }
    console.require_memory("sample",
                           least_memory(input.mesh.triangles.size(),
                                        cli::estimated_samples(options, input.mesh.view())));
    const remesh::RemeshResult result = cli::naming_file(
        arguments.input,
        [&] {
            return needs_input ? remesh::remesh(input.mesh.view(), options)
                               : remesh::remesh_moved(std::move(input.mesh), options);
        },
        arguments.sites);
    judge(result, arguments.strict, console);
    warn_of_junctions(result.junctions, arguments.junctions, console);
    warn_of_bounds(result.sizing, options.sizing, console);
    const remesh::RunInfo info{.version = REMESH_VERSION,
                               .input_path = arguments.input.string(),
                               .output_path = arguments.output.string(),
                               .options = options,
                               .attributes = attributes};
    const agvd::Progress writing = console.progress_of("write");
    std::vector<remesh::FileContent> files;
    const remesh::MeshAttributes carried =
        cli::carry_attributes(arguments.attributes, input, result, arguments.common.threads,
                              console.progress_of("transfer"), files);
    const remesh::MeshPath target{arguments.output, arguments.to};
    files.push_back(
        {arguments.output, remesh::format_mesh(target, result.mesh.view(), carried, writing)});
    warn_of_rounding(target, result.mesh.view(), writing, console);
    if (arguments.report == "-") {
        cli::print(remesh::to_json(result, info));
    } else if (!arguments.report.empty()) {
        files.push_back({arguments.report, remesh::to_json(result, info)});
    }
    remesh::write_files_atomically(files, writing);
    console.info(remesh::to_text(result, info));
}

}  // namespace

int main(int argc, char** argv) {
    // NOLINTBEGIN(concurrency-mt-unsafe): no other thread runs yet. Each large array is returned to
    // the system at once. By default larger and larger ones are kept, in gaps too small for the
    // next: a tenth more memory at 1.4 M faces.
    ::mallopt(M_MMAP_THRESHOLD, 1 << 22);
    // The heap grows by large pages (large_pages.cpp); free memory at its end is kept until the
    // stage is over.
    ::mallopt(M_TOP_PAD, 1 << 25);
    ::mallopt(M_TRIM_THRESHOLD, 1 << 26);
    // NOLINTEND(concurrency-mt-unsafe)
    CLI::App app("Replaces a mesh by the dual of its geodesic Voronoi diagram.", "remesh");
    Arguments arguments;
    add_options(app, arguments);
    app.footer(std::string(footer) + cli::exit_code_help);
    return cli::run(app, argc, argv, [&] {
        cli::Console console(arguments.common, cli::limit_of(arguments));
        console.run([&] { run_job(arguments, console); });
    });
}
