// Time (of all cores together) and memory of the two stages of the diagram, in one run with the
// sweep they are measured by.

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "bench/p0.h"
#include "bench/report.h"
#include "cli.h"

namespace {

using namespace agvd;

struct Case {
    std::string mesh;
    const Surface& surface;
    const std::vector<SurfacePoint>& sites;
    int steiner_points;
    double lambda;
};

const std::vector<bench::Column> columns{
    {"mesh", "mesh", 0},
    {"faces", "faces", 0},
    {"sites", "sites", 0},
    {"steiner_points", "m", 0},
    {"lambda", "lambda", 2},
    {"p0_ms", "P0 ms", 2},
    {"propagate_ms", "propag. ms", 1},
    {"propagate_spread", "spread", 2},
    {"propagate_ns_per_face", "ns/face", 0},
    {"propagate_p0", "propag. P0", 1},
    {"diagram_ms", "diagram ms", 1},
    {"diagram_p0", "diagram P0", 1},
    {"bytes_per_node", "bytes/node", 1},
};

// P0, propagation and diagram in turn, so that all three meet the same disturbances.
nlohmann::ordered_json measure(const Case& c, int repetitions, int threads) {
    constexpr int sweeps = 5;
    double p0 = bench::p0_seconds(c.surface, c.sites, sweeps);
    std::vector<double> propagate_s, propagate_wall, diagram_s, diagram_wall;
    std::size_t peak_bytes = 0, num_nodes = 0;
    for (int i = 0; i < repetitions; ++i) {
        Propagation propagation;
        const bench::Seconds propagating = bench::time([&] {
            propagation = propagate(c.surface, c.sites,
                                    {.engine = Engine::Steiner,
                                     .steiner_points = c.steiner_points,
                                     .lambda = c.lambda});
        });
        Diagram diagram;
        const bench::Seconds building = bench::time([&] {
            diagram = build_diagram(c.surface, c.sites, propagation, {.num_threads = threads});
        });
        p0 = std::min(p0, bench::p0_seconds(c.surface, c.sites, sweeps));
        propagate_s.push_back(propagating.cpu);
        propagate_wall.push_back(propagating.wall);
        diagram_s.push_back(building.cpu);
        diagram_wall.push_back(building.wall);
        peak_bytes = propagation.peak_bytes;
        num_nodes = propagation.num_nodes;
    }
    const auto [propagation, propagation_spread] = bench::spread_of(propagate_s);
    const auto [diagram, diagram_spread] = bench::spread_of(diagram_s);
    const double faces = c.surface.num_faces();
    return {{"mesh", c.mesh},
            {"faces", c.surface.num_faces()},
            {"sites", c.sites.size()},
            {"steiner_points", c.steiner_points},
            {"lambda", c.lambda},
            {"threads", threads},
            {"repetitions", repetitions},
            {"p0_ms", 1e3 * p0},
            {"propagate_ms", 1e3 * propagation},
            {"propagate_wall_ms", 1e3 * bench::spread_of(propagate_wall).median},
            {"propagate_spread", propagation_spread},
            {"propagate_ns_per_face", 1e9 * propagation / faces},
            {"propagate_p0", propagation / p0},
            {"diagram_ms", 1e3 * diagram},
            {"diagram_wall_ms", 1e3 * bench::spread_of(diagram_wall).median},
            {"diagram_spread", diagram_spread},
            {"diagram_ns_per_face", 1e9 * diagram / faces},
            {"diagram_p0", diagram / p0},
            {"peak_bytes", peak_bytes},
            {"nodes", num_nodes},
            {"bytes_per_node", static_cast<double>(peak_bytes) / static_cast<double>(num_nodes)}};
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Time and memory of propagation and diagram, beside one Dijkstra sweep (P0)",
                 "bench-propagation");
    bench::Options options;
    options.sites = {100};
    options.steiner_points = {8};
    bench::add_options(app, options);
    std::vector<double> lambdas{1};
    Index min_faces = 0;
    int repetitions = 5;
    app.add_option("--lambda", lambdas, "Triangles are retired every lambda * #F pops")
        ->capture_default_str();
    app.add_option("--subdivide", min_faces, "Split faces in four until there are this many");
    app.add_option("--repetitions", repetitions, "Runs of each case; medians are shown")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    return cli::run(app, argc, argv, [&] {
        nlohmann::ordered_json rows = nlohmann::ordered_json::array();
        bench::print_heading(columns);
        for (const auto& path : options.meshes) {
            const Surface surface = bench::load(path, min_faces);
            for (const Index count : options.sites) {
                const auto sites = bench::random_sites(surface, count, options.place, options.seed);
                for (const int m : options.steiner_points) {
                    for (const double lambda : lambdas) {
                        cli::stop_if_interrupted();
                        rows.push_back(measure({path.stem(), surface, sites, m, lambda},
                                               repetitions, options.threads));
                        bench::print_row(columns, rows.back());
                    }
                }
            }
        }
        bench::write_json(options, "propagation", rows);
    });
}
