// Compares Steiner points inserted where an error bound needs them with equally many on each edge.

#include "agvd/core/error.h"
#include "agvd/propagation/propagate.h"
#include "bench/exact.h"
#include "bench/report.h"
#include "bench/timing.h"
#include "cli.h"

namespace {

using namespace agvd;

const std::vector<bench::Column> columns{{"mesh", "mesh"},
                                         {"faces", "faces", 0, 8},
                                         {"sites", "t", 0, 6},
                                         {"max_error", "E", -1, 8},
                                         {"points", "points per edge", 1, 15},
                                         {"seconds", "s", 2, 7},
                                         {"uniform_points", "uniform", 0, 8},
                                         {"uniform_seconds", "s", 2, 7}};

struct Arguments {
    bench::Options common;
    std::vector<double> max_errors{5e-3, 2e-3, 1e-3};
    int step = 8;
    int repetitions = 3;
};

struct Case {
    const Surface& surface;
    std::span<const SurfacePoint> sites;
};

// The quicker of the repetitions; on one thread.
double seconds_of(const Case& c, PropagationOptions options, int repetitions, Propagation& result) {
    options.num_threads = 1;
    std::vector<double> seconds;
    for (int i = 0; i < repetitions; ++i) {
        cli::stop_if_interrupted();
        seconds.push_back(
            bench::time([&] { result = propagate(c.surface, c.sites, options); }).cpu);
    }
    return bench::quickest(seconds);
}

nlohmann::ordered_json measure(const Case& c, std::span<const double> exact, double max_error,
                               const Arguments& arguments) {
    nlohmann::ordered_json row{
        {"faces", c.surface.num_faces()}, {"sites", c.sites.size()}, {"max_error", max_error}};
    Propagation propagation;
    row["seconds"] = seconds_of(c, {.engine = Engine::Steiner, .max_error = max_error},
                                arguments.repetitions, propagation);
    row["points"] = (static_cast<double>(propagation.num_nodes) - c.surface.num_vertices()) /
                    c.surface.num_edges();
    constexpr int most = 1000;  // The library takes no more.
    for (int m = arguments.step; m <= most; m += arguments.step) {
        const PropagationOptions uniform{.engine = Engine::Steiner, .steiner_points = m};
        const double once = seconds_of(c, uniform, 1, propagation);
        if (bench::vertex_error(propagation.vertex_distance, exact).max > max_error) continue;
        row["uniform_points"] = m;
        row["uniform_seconds"] =
            std::min(once, seconds_of(c, uniform, arguments.repetitions, propagation));
        break;
    }
    return row;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Steiner points that --max-error inserts where they are needed, and the least number on "
        "every edge that keeps the same error at the vertices (CPU, one thread)",
        "bench-insertion");
    Arguments arguments;
    arguments.common.sites = {100};
    bench::add_options(app, arguments.common);
    app.add_option("--max-error", arguments.max_errors, "Largest errors")->capture_default_str();
    app.add_option("--step", arguments.step, "Uniform numbers of points are multiples of this")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--repetitions", arguments.repetitions,
                   "Number of runs of each case; the quickest counts")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    return cli::run(app, argc, argv, [&] {
        nlohmann::ordered_json rows = nlohmann::ordered_json::array();
        bench::print_heading(columns);
        for (const auto& path : arguments.common.meshes) {
            const Surface surface = bench::load(path, 0);
            for (const Index count : arguments.common.sites) {
                const auto sites = bench::random_sites(surface, count, arguments.common.place,
                                                       arguments.common.seed);
                const Propagation exact = propagate(surface, sites, {.max_error = 0});
                for (const double max_error : arguments.max_errors) {
                    auto row =
                        measure({surface, sites}, exact.vertex_distance, max_error, arguments);
                    row["mesh"] = path.stem();
                    bench::print_row(columns, row);
                    rows.push_back(row);
                }
            }
        }
        bench::write_json(arguments.common, "insertion", rows);
    });
}
