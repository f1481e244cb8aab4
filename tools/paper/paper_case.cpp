// Measures one mesh and set of sites with every method, for the evaluation of [meng2023] Sec. 6.
// The methods run in turn in each repetition, each followed by sweeps of P0, so that changes of the
// machine's speed concern all of them alike; the quickest times count. Errors compare the last
// diagram of each method with the exact one.
#include "paper/paper_case.h"

#include <algorithm>
#include <limits>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "bench/allocations.h"
#include "bench/p0.h"
#include "bench/timing.h"
#include "cli.h"
#include "paper/compare_diagrams.h"
#include "paper/vertex_labels.h"
#include "remesh/dual/build_dual.h"

namespace bench {
namespace {

using namespace agvd;
using Json = nlohmann::ordered_json;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Quickest times, and what does not depend on the run.
struct Contestant {
    double propagate = infinity, diagram = infinity, dual = infinity, total = infinity;
    std::size_t peak_bytes = 0;
    Diagram result = {};
};

void run(const PaperCase& c, const Method& method, bool with_dual, Contestant& contestant) {
    PropagationOptions options = method.options;
    options.num_threads = 1;
    const PeakBytes peak;
    Propagation propagation;
    Diagram diagram;
    std::vector<Triangle> triangles;
    const double propagating =
        time([&] { propagation = propagate(c.surface, c.sites, options); }).cpu;
    const double building =
        time([&] {
            diagram = method.by_vertex_labels
                          ? vertex_label_diagram(c.surface, c.sites.size(), propagation)
                          : build_diagram(c.surface, c.sites, propagation, {.num_threads = 1});
        }).cpu;
    double dualizing = 0;
    if (with_dual) {
        dualizing = time([&] { triangles = remesh::build_dual(c.surface, diagram); }).cpu;
    }
    if (contestant.peak_bytes == 0) contestant.peak_bytes = peak.bytes();
    contestant.propagate = std::min(contestant.propagate, propagating);
    contestant.diagram = std::min(contestant.diagram, building);
    contestant.dual = std::min(contestant.dual, dualizing);
    contestant.total = std::min(contestant.total, propagating + building + dualizing);
    contestant.result = std::move(diagram);
}

void add_errors(const PaperCase& c, const std::vector<Contestant>& contestants,
                const Diagram& exact, Index bisector_points, std::vector<Json>& rows) {
    std::vector<const Diagram*> diagrams;
    for (const Contestant& contestant : contestants) diagrams.push_back(&contestant.result);
    const auto errors =
        exact_bisector_errors(c.surface, c.sites, diagrams, {.max_points = bisector_points});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        cli::stop_if_interrupted();
        const DiagramDifference difference = compare_diagrams(c.surface, *diagrams[i], exact);
        rows[i].update(Json{{"delta_percent", 100 * difference.frechet.delta},
                            {"frechet_radii", difference.frechet.sum / difference.cell_radius},
                            {"unmatched_loops", difference.frechet.unmatched_loops},
                            {"hausdorff_radii", difference.hausdorff / difference.cell_radius},
                            {"wrong_percent", 100 * difference.wrong_label_area},
                            {"mean_bisector_error", errors[i].mean},
                            {"p95_bisector_error", errors[i].p95},
                            {"max_bisector_error", errors[i].max}});
    }
}

Diagram exact_diagram(const PaperCase& c) {
    return build_diagram(c.surface, c.sites, propagate(c.surface, c.sites, {.max_error = 0}));
}

}  // namespace

std::vector<Json> measure(const PaperCase& c, const std::vector<Method>& methods,
                          const PaperOptions& options) {
    std::vector<Contestant> contestants(methods.size());
    P0 sweep(c.surface, c.sites);
    double p0 = sweep.seconds().quickest;
    for (int i = 0; i < options.repetitions; ++i) {
        for (std::size_t k = 0; k < methods.size(); ++k) {
            cli::stop_if_interrupted();
            run(c, methods[k], options.with_dual, contestants[k]);
            p0 = std::min(p0, sweep.seconds().quickest);
        }
    }
    std::vector<Json> rows;
    for (std::size_t k = 0; k < methods.size(); ++k) {
        const Contestant& contestant = contestants[k];
        rows.push_back({{"mesh", c.mesh},
                        {"faces", c.surface.num_faces()},
                        {"sites", c.sites.size()},
                        {"method", methods[k].name},
                        {"p0_ms", 1e3 * p0},
                        {"propagate_p0", contestant.propagate / p0},
                        {"diagram_p0", contestant.diagram / p0},
                        {"dual_p0", contestant.dual / p0},
                        {"total_p0", contestant.total / p0},
                        {"total_ms", 1e3 * contestant.total},
                        {"peak_mb", 1e-6 * static_cast<double>(contestant.peak_bytes)},
                        {"bytes_per_face", static_cast<double>(contestant.peak_bytes) /
                                               static_cast<double>(c.surface.num_faces())}});
    }
    if (options.with_errors) {
        const auto is_exact = [](const Method& method) {
            return method.options.engine == Engine::Window && method.options.max_error == 0 &&
                   !method.by_vertex_labels;
        };
        const auto found = std::find_if(methods.begin(), methods.end(), is_exact);
        const Diagram exact =
            found == methods.end()
                ? exact_diagram(c)
                : contestants[static_cast<std::size_t>(found - methods.begin())].result;
        add_errors(c, contestants, exact, options.bisector_points, rows);
    }
    return rows;
}

}  // namespace bench
