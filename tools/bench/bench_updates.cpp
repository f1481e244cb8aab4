// The cost of moving a few sites, compared with computing everything anew: for the propagation
// alone, and with the diagram. Different sites move in each repetition.

#include "agvd/core/random.h"
#include "agvd/diagram/build_diagram.h"
#include "agvd/propagation/propagate.h"
#include "agvd/update/moving_diagram.h"
#include "bench/p0.h"
#include "bench/report.h"
#include "bench/timing.h"
#include "cli.h"

namespace {

using namespace agvd;

const std::vector<bench::Column> columns{{"mesh", "mesh"},
                                         {"faces", "faces"},
                                         {"sites", "sites"},
                                         {"moves", "moves"},
                                         {"moved", "moved"},
                                         {"propagated", "propagated", 1},
                                         {"fresh_p0", "fresh P0", 2},
                                         {"update_p0", "update P0", 2},
                                         {"update_over_fresh", "ratio", 4},
                                         {"fresh_whole_p0", "whole P0", 2},
                                         {"update_whole_p0", "update P0", 2},
                                         {"update_over_fresh_whole", "ratio", 4},
                                         {"median_over_median_whole", "medians", 4}};

struct Arguments {
    bench::Options common;
    double share = 0.01;
    double max_error = 1e-3;
    int repetitions = 20;
};

// The half-edge that leaves the vertex a site lies on.
Index corner_of(const SurfacePoint& site) {
    Index k = 0;
    while (site.barycentric[k] != 1) ++k;
    return 3 * site.face.value() + k;
}

// Different sites each time.
SiteChanges random_moves(const Surface& surface, const std::vector<SurfacePoint>& sites,
                         bool are_near, Index count, std::uint64_t seed) {
    SiteChanges changes;
    const Index step = static_cast<Index>(sites.size()) / count;
    for (Index i = 0; i < count; ++i) {
        const Index site =
            i * step + static_cast<Index>(random_bits(seed, 0, i) % std::max<Index>(step, 1));
        const std::uint64_t draw = random_bits(seed, 1, i);
        const Index to = are_near ? surface.head(corner_of(sites[site]))
                                  : static_cast<Index>(draw % surface.num_vertices());
        changes.moved.emplace_back(site, bench::point_at(surface, to));
    }
    return changes;
}

nlohmann::ordered_json measure(const std::string& mesh, const Surface& surface,
                               const SurfaceLayout& layout, std::vector<SurfacePoint> sites,
                               bool are_near, const Arguments& arguments) {
    const PropagationOptions options{.max_error = arguments.max_error, .num_threads = 1};
    const auto count = static_cast<Index>(static_cast<double>(sites.size()) * arguments.share);
    bench::P0 sweep(surface, sites);
    double p0 = sweep.seconds().quickest;
    std::vector<double> fresh, update, propagated, fresh_diagram, update_whole;
    MovingDiagram diagram(surface, layout, sites, options, {.num_threads = 1});
    MovingSites moving(surface, layout, std::move(sites), options);
    std::uint64_t seed = arguments.common.seed;
    for (int i = 0; i < arguments.repetitions; ++i) {
        cli::stop_if_interrupted();
        // In use sites are moved many times: each kind is run a few times in a row.
        constexpr int in_a_row = 4;
        std::vector<SiteChanges> changes;
        for (int k = 0; k < in_a_row; ++k) {
            changes.push_back(
                random_moves(surface, moving.sites(), are_near, std::max<Index>(count, 1), seed++));
            update.push_back(bench::time([&] { moving.update(changes.back()); }).cpu);
            propagated.push_back(moving.num_propagated());
        }
        for (const SiteChanges& change : changes) {
            update_whole.push_back(bench::time([&] { diagram.update(change); }).cpu);
        }
        Propagation propagation;
        fresh.push_back(bench::time([&] {
                            propagation = propagate(surface, layout, moving.sites(), options);
                        }).cpu);
        fresh_diagram.push_back(bench::time([&] {
                                    (void)build_diagram(surface, moving.sites(), propagation,
                                                        {.num_threads = 1});
                                }).cpu);
        p0 = std::min(p0, sweep.seconds().quickest);
    }
    const double whole = bench::quickest(fresh) + bench::quickest(fresh_diagram);
    return {{"mesh", mesh},
            {"faces", surface.num_faces()},
            {"sites", moving.sites().size()},
            {"moves", are_near ? "near" : "anywhere"},
            {"moved", std::max<Index>(count, 1)},
            {"propagated", bench::median(propagated)},
            {"p0_ms", 1e3 * p0},
            {"fresh_p0", bench::quickest(fresh) / p0},
            {"update_p0", bench::quickest(update) / p0},
            {"update_over_fresh", bench::quickest(update) / bench::quickest(fresh)},
            {"fresh_whole_p0", whole / p0},
            {"update_whole_p0", bench::quickest(update_whole) / p0},
            {"update_over_fresh_whole", bench::quickest(update_whole) / whole},
            {"median_over_median_whole",
             bench::median(update_whole) / (bench::median(fresh) + bench::median(fresh_diagram))}};
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Time of moving some sites, divided by that of a fresh run", "bench-updates");
    Arguments arguments;
    arguments.common.sites = {2000};
    bench::add_options(app, arguments.common);
    app.add_option("--share", arguments.share, "Share of the sites that move")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    app.add_option("--max-error", arguments.max_error, "Error of the distances; 0: exact")
        ->capture_default_str();
    app.add_option(
           "--repetitions", arguments.repetitions,
           "Number of fresh runs, each after four changes; the table shows the quickest, and "
           "ratios of medians")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    return cli::run(app, argc, argv, [&] {
        nlohmann::ordered_json rows = nlohmann::ordered_json::array();
        bench::print_heading(columns);
        for (const auto& path : arguments.common.meshes) {
            const Surface surface = bench::load(path, 0);
            const SurfaceLayout layout(surface);
            for (const Index count : arguments.common.sites) {
                for (const bool are_near : {true, false}) {
                    const auto sites = bench::random_sites(surface, count, bench::Place::Vertices,
                                                           arguments.common.seed);
                    rows.push_back(
                        measure(path.stem(), surface, layout, sites, are_near, arguments));
                    bench::print_row(columns, rows.back());
                }
            }
        }
        bench::write_json(arguments.common, "updates", rows);
    });
}
