// Time, memory and error of the propagation engines, and of the diagram if asked for, in one
// execution with the sweep that is the unit of time. All methods run in turn, so that other
// programs on the machine disturb all of them alike.

#include <optional>
#include <utility>

#include "agvd/diagram/diagram.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/propagation/propagate.h"
#include "arguments.h"
#include "bench/allocations.h"
#include "bench/exact.h"
#include "bench/medians.h"
#include "bench/method.h"
#include "bench/p0.h"
#include "bench/report.h"
#include "bench/timing.h"
#include "cli.h"

namespace {

using namespace agvd;
using Json = nlohmann::ordered_json;

struct Arguments {
    bench::Options common;
    bench::MethodLists lists;
    std::vector<int> threads{1};
    Index min_faces = 0;
    Index exact_limit = 0;  // Faces.
    int repetitions = 5;
    bool diagram = false;
};

struct Case {
    std::string mesh;
    const Surface& input;
    const Surface& surface;  // Its intrinsic triangulation.
    const SurfaceLayout& layout;
    const std::vector<SurfacePoint>& sites;    // On the input,
    const std::vector<SurfacePoint>& on_base;  // and on its triangulation.
};

std::vector<bench::Column> columns_for(const Arguments& arguments) {
    std::vector<bench::Column> columns{{"mesh", "mesh"},
                                       {"faces", "faces", 0, 8},
                                       {"sites", "sites", 0, 6},
                                       {"method", "method", 0, 14},
                                       {"threads", "threads", 0, 7},
                                       {"p0_ms", "P0 ms", 2, 8},
                                       {"propagate_ms", "cpu ms", 1, 9},
                                       {"propagate_p0", "cpu P0", 2, 7},
                                       {"propagate_beside_p0", "beside", 2, 7},
                                       {"base_ms", "base ms", 1, 7},
                                       {"layout_p0", "layout", 2, 6},
                                       {"propagate_spread", "spread", 2, 6},
                                       {"propagate_ns_per_face", "ns/face", 0, 7},
                                       {"propagate_wall_p0", "wall P0", 2, 7},
                                       {"speedup", "speedup", 2, 7},
                                       {"bytes_per_face", "B/face", 0, 6},
                                       {"certified_error", "certified", -1, 9},
                                       {"mixed_faces", "mixed", 0, 8},
                                       {"relays_per_mixed_face", "relays", 2, 6}};
    if (arguments.exact_limit > 0) {
        columns.insert(columns.end(), {{"mean_relative_error", "mean err.", -1, 9},
                                       {"max_relative_error", "max err.", -1, 9},
                                       {"lowest_relative_error", "lowest", -1, 9}});
    }
    if (arguments.diagram) {
        columns.insert(columns.end(), {{"diagram_ms", "diagram ms", 1},
                                       {"diagram_p0", "diagram P0", 1},
                                       {"diagram_beside_p0", "beside", 1},
                                       {"both_p0", "both P0", 1},
                                       {"complex_p0", "complex P0", 1},
                                       {"complex_beside_p0", "beside", 1},
                                       {"both_bytes_per_face", "both B/face", 0},
                                       {"working_bytes_per_face", "working", 0},
                                       {"most_relays", "most relays", 0}});
    }
    return columns;
}

// Seconds of the repetitions. The quickest of them counts, as with the sweep: other programs on the
// machine only add time. On a machine that is always busy this disadvantages long jobs, which never
// run undisturbed; so there is also the median of the ratios of each repetition to the sweeps right
// before and after it.
struct Timings {
    std::vector<double> cpu, wall, over_sweeps;

    void add(const bench::Seconds& taken, double sweep_before, double sweep_after) {
        cpu.push_back(taken.cpu);
        wall.push_back(taken.wall);
        over_sweeps.push_back(2 * taken.cpu / (sweep_before + sweep_after));
    }
    void tell(const std::string& stage, double p0, double faces, Json& row) const {
        row[stage + "_ms"] = 1e3 * bench::quickest(cpu);
        row[stage + "_wall_ms"] = 1e3 * bench::quickest(wall);
        row[stage + "_p0"] = bench::quickest(cpu) / p0;
        row[stage + "_beside_p0"] = bench::median(over_sweeps);
        row[stage + "_wall_p0"] = bench::quickest(wall) / p0;
        row[stage + "_spread"] = bench::spread(cpu);
        row[stage + "_ns_per_face"] = 1e9 * bench::quickest(cpu) / faces;
    }
};

std::size_t bytes_of(const Diagram& d) {
    const auto sum = [](const auto&... lists) { return ((lists.size() * sizeof(lists[0])) + ...); };
    return sum(d.points, d.point_distance, d.passages, d.edge_points, d.edges, d.vertex_offsets,
               d.vertex_ends, d.vertex_sites, d.vertices, d.vertex_distance, d.nearest_site,
               d.nearest_distance, d.cell_area, d.cell_euler);
}

// One method, run several times.
struct Contestant {
    const bench::Method& method;
    int threads;
    // Both: in one call, where faces are traced while the Steiner engine runs.
    Timings propagate = {}, diagram = {}, both = {}, complex = {};
    Json result = {};  // What does not depend on the run.
};

Json describe(const Case& c, const Propagation& propagation,
              const std::optional<std::vector<double>>& exact) {
    const auto mixed = static_cast<double>(propagation.mixed_faces.size());
    Json result{{"peak_bytes", propagation.peak_bytes},
                {"bytes_per_face", static_cast<double>(propagation.peak_bytes) /
                                       static_cast<double>(c.surface.num_faces())},
                {"nodes", propagation.num_nodes},
                {"certified_error", propagation.certified_error},
                {"mixed_faces", propagation.mixed_faces.size()},
                {"relays_per_mixed_face",
                 mixed == 0 ? 0 : static_cast<double>(propagation.relays.size()) / mixed}};
    if (!std::isfinite(propagation.certified_error)) result["certified_error"] = nullptr;
    if (exact) {
        const bench::VertexError error = bench::vertex_error(propagation.vertex_distance, *exact);
        result["mean_relative_error"] = error.mean;
        result["max_relative_error"] = error.max;
        result["lowest_relative_error"] = error.lowest;
    }
    return result;
}

// Adds one repetition.
void run(const Case& c, const std::optional<std::vector<double>>& exact, bool with_diagram,
         bench::P0& sweep, bench::SweepSeconds& p0, Contestant& contestant) {
    PropagationOptions options = contestant.method.options;
    options.num_threads = contestant.threads;
    Propagation propagation;
    const bench::Seconds propagating =
        bench::time([&] { propagation = propagate(c.surface, c.layout, c.on_base, options); });
    if (contestant.result.empty()) contestant.result = describe(c, propagation, exact);
    const double before = std::exchange(p0, sweep.seconds()).median;
    contestant.propagate.add(propagating, before, p0.median);
    if (!with_diagram) return;
    const DiagramOptions drawing{.num_threads = contestant.threads};
    contestant.complex.add(
        bench::time([&] { (void)build_cell_complex(c.surface, c.on_base, propagation, drawing); }),
        before, p0.median);
    contestant.diagram.add(
        bench::time(
            [&] { (void)build_diagram(c.surface, c.on_base, std::move(propagation), drawing); }),
        before, p0.median);
    propagation = {};
    TracedDiagram traced;
    const bench::PeakBytes most;
    contestant.both.add(
        bench::time([&] { traced = trace_diagram(c.surface, c.on_base, options, drawing); }),
        before, p0.median);
    const double faces = c.surface.num_faces();
    const auto bytes = static_cast<double>(most.bytes());
    contestant.result["both_bytes_per_face"] = bytes / faces;
    contestant.result["working_bytes_per_face"] =
        (bytes - static_cast<double>(bytes_of(traced.diagram))) / faces;
    contestant.result["most_relays"] = traced.most_relays;
}

// Wall time over that of one thread; null without a run on one thread.
Json speedup(const Contestant& contestant, std::span<const Contestant> all) {
    for (const Contestant& other : all) {
        if (&other.method != &contestant.method || other.threads != 1) continue;
        return bench::quickest(other.propagate.wall) / bench::quickest(contestant.propagate.wall);
    }
    return nullptr;
}

Json heading_of(const Case& c, const std::string& method, int threads) {
    return {{"mesh", c.mesh},
            {"faces", c.surface.num_faces()},
            {"sites", c.sites.size()},
            {"method", method},
            {"threads", threads}};
}

Json row_of(const Case& c, const Contestant& contestant, double p0,
            std::span<const Contestant> all) {
    const PropagationOptions& options = contestant.method.options;
    Json row = heading_of(c, contestant.method.name, contestant.threads);
    row["engine"] = engine_name(options.engine);
    row["max_error"] = options.max_error ? Json(*options.max_error) : Json();
    const bool is_steiner = options.engine == Engine::Steiner;
    row["steiner_points"] = is_steiner ? Json(options.steiner_points) : Json();
    row["lambda"] = is_steiner ? Json(options.lambda) : Json();
    row["repetitions"] = contestant.propagate.cpu.size();
    row["p0_ms"] = 1e3 * p0;
    const double faces = c.surface.num_faces();
    contestant.propagate.tell("propagate", p0, faces, row);
    row["speedup"] = speedup(contestant, all);
    if (!contestant.diagram.cpu.empty()) {
        contestant.diagram.tell("diagram", p0, faces, row);
        contestant.both.tell("both", p0, faces, row);
        contestant.complex.tell("complex", p0, faces, row);
    }
    row.update(contestant.result);
    return row;
}

// Runs all contestants in turn, with the sweep between them, so that all have the same
// disturbances.
std::vector<Json> measure(const Case& c, const std::vector<bench::Method>& methods,
                          const Arguments& arguments) {
    bench::P0 sweep(c.input, c.sites);
    bench::SweepSeconds last_sweeps = sweep.seconds();
    double p0 = last_sweeps.quickest;
    std::optional<std::vector<double>> exact;  // Distances of the vertices.
    if (c.surface.num_faces() <= arguments.exact_limit) {
        exact = bench::exact_vertex_distances(c.input, c.sites);
    }
    std::vector<Contestant> contestants;
    for (const bench::Method& method : methods) {
        for (const int threads : arguments.threads) contestants.push_back({method, threads});
    }
    std::vector<double> layout, base;
    for (int i = 0; i < arguments.repetitions; ++i) {
        for (Contestant& contestant : contestants) {
            cli::stop_if_interrupted();
            run(c, exact, arguments.diagram, sweep, last_sweeps, contestant);
            p0 = std::min(p0, last_sweeps.quickest);
        }
        layout.push_back(bench::time([&] { (void)SurfaceLayout(c.surface, 1); }).cpu);
        base.push_back(bench::time([&] { (void)IntrinsicTriangulation(c.input); }).cpu);
    }
    std::vector<Json> rows;
    if (exact) {
        Timings timings;
        timings.add(
            bench::time([&] { (void)bench::vertex_distances_by_one_search(c.input, c.sites); }), p0,
            p0);
        rows.push_back(heading_of(c, "CGAL exact", 1));
        rows.back()["repetitions"] = 1;
        rows.back()["p0_ms"] = 1e3 * p0;
        timings.tell("propagate", p0, c.surface.num_faces(), rows.back());
    }
    for (const Contestant& contestant : contestants) {
        rows.push_back(row_of(c, contestant, p0, contestants));
        rows.back()["base_ms"] = 1e3 * bench::quickest(base);
        rows.back()["layout_p0"] = bench::quickest(layout) / p0;
    }
    return rows;
}

void add_options(CLI::App& app, Arguments& arguments) {
    bench::Options& common = arguments.common;
    bench::MethodLists& lists = arguments.lists;
    common.sites = {2000, 1000, 100, 30};
    common.steiner_points = {8};
    lists.engines = {Engine::Window, Engine::Steiner};
    lists.max_errors = {0, default_max_error};
    lists.lambdas = {1};
    bench::add_options(app, common);
    app.add_option("--engine", lists.engines, "Engines: window, steiner; default: both")
        ->transform(CLI::CheckedTransformer(cli::engines_by_name()).description(""));
    app.add_option("--max-error", lists.max_errors, "Window engine: largest errors; 0: exact")
        ->capture_default_str();
    app.add_option("--lambda", lists.lambdas,
                   "Steiner engine: triangles retire every lambda * #F pops")
        ->capture_default_str();
    app.add_option("--threads", arguments.threads,
                   "Numbers of threads; 0: all cores; the speedup is over 1 thread")
        ->capture_default_str();
    app.add_option("--subdivide", arguments.min_faces,
                   "Split all faces in four until the mesh has this many faces");
    app.add_option("--exact-limit", arguments.exact_limit,
                   "Also run CGAL's exact method on meshes of up to this many faces, once, and "
                   "measure the error of the vertex distances; slow");
    app.add_option("--repetitions", arguments.repetitions,
                   "Number of runs of each case; the quickest counts")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_flag("--diagram", arguments.diagram, "Also build the diagram");
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Time, memory and error of the propagation engines, compared with one Dijkstra sweep (P0)",
        "bench-propagation");
    Arguments arguments;
    add_options(app, arguments);
    return cli::run(app, argc, argv, [&] {
        const bench::Options& common = arguments.common;
        arguments.lists.steiner_points = common.steiner_points;
        const std::vector<bench::Method> methods = bench::methods(arguments.lists);
        const std::vector<bench::Column> columns = columns_for(arguments);
        Json rows = Json::array();
        bench::print_heading(columns);
        for (const auto& path : common.meshes) {
            const Surface input = bench::load(path, arguments.min_faces);
            const IntrinsicTriangulation base(input);
            const SurfaceLayout layout(base.surface());
            for (const Index count : common.sites) {
                const auto sites = bench::random_sites(input, count, common.place, common.seed);
                const auto on_base = base.to_intrinsic(sites);
                for (const Json& row :
                     measure({path.stem(), input, base.surface(), layout, sites, on_base}, methods,
                             arguments)) {
                    rows.push_back(row);
                    bench::print_row(columns, row);
                }
            }
        }
        for (const Json& row : bench::medians(rows)) {
            rows.push_back(row);
            bench::print_row(columns, row);
        }
        bench::write_json(common, "propagation", rows);
    });
}
