// Measures one mesh and set of sites with every method, for the evaluation of [meng2023] Sec. 6.
// The methods run in turn in each repetition, each followed by sweeps of P0, so that changes of the
// machine's speed concern all of them alike; the quickest times count. Errors compare the last
// diagram of each method with the exact one. Codes of others, which take far longer, run once.
#include "paper/paper_case.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "based_diagram.h"
#include "bench/allocations.h"
#include "bench/exact.h"
#include "bench/p0.h"
#include "bench/timing.h"
#include "cli.h"
#include "paper/cell_at.h"
#include "paper/compare_diagrams.h"
#include "paper/other_codes.h"
#include "paper/vertex_labels.h"
#include "remesh/dual/build_dual.h"

namespace bench {
namespace {

using namespace agvd;
using Json = nlohmann::ordered_json;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Quickest times, and what does not depend on the run.
struct Contestant {
    double base = infinity, propagate = infinity, diagram = infinity, dual = infinity,
           total = infinity;
    std::size_t peak_bytes = 0;
    Diagram result = {};
};

void run(const PaperCase& c, const Method& method, bool with_dual, Contestant& contestant) {
    PropagationOptions options = method.options;
    options.num_threads = 1;
    const PeakBytes peak;
    std::optional<IntrinsicTriangulation> base;
    std::vector<SurfacePoint> on_base;
    const double making = time([&] {
                              if (method.drawing != Drawing::OnBase) return;
                              base = cli::base_for(c.surface, c.sites.size(), {});
                              on_base = base->to_intrinsic(c.sites);
                          }).cpu;
    const Surface& surface = base ? base->surface() : c.surface;
    const std::vector<SurfacePoint>& sites = base ? on_base : c.sites;
    // Faces are traced while the Steiner engine runs.
    const bool is_traced =
        options.engine == Engine::Steiner && method.drawing != Drawing::VertexLabels;
    Propagation propagation;
    Diagram diagram;
    std::vector<Triangle> triangles;
    const auto propagate_alone = [&] { propagation = propagate(surface, sites, options); };
    double propagating = is_traced ? 0 : time(propagate_alone).cpu;
    double building =
        time([&] {
            diagram =
                is_traced ? trace_diagram(surface, sites, options, {.num_threads = 1}).diagram
                : method.drawing == Drawing::VertexLabels
                    ? vertex_label_diagram(surface, sites.size(), propagation)
                    : build_diagram(surface, sites, std::move(propagation), {.num_threads = 1});
        }).cpu;
    if (base) {
        building += time([&] { diagram = diagram_on_input(*base, std::move(diagram)); }).cpu;
    }
    double dualizing = 0;
    if (with_dual) {
        dualizing = time([&] { triangles = remesh::build_dual(diagram); }).cpu;
    }
    if (contestant.peak_bytes == 0) contestant.peak_bytes = peak.bytes();
    if (is_traced) {
        propagating = time(propagate_alone).cpu;
        building -= propagating;
    }
    contestant.base = std::min(contestant.base, making);
    contestant.propagate = std::min(contestant.propagate, propagating);
    contestant.diagram = std::min(contestant.diagram, building);
    contestant.dual = std::min(contestant.dual, dualizing);
    contestant.total = std::min(contestant.total, making + propagating + building + dualizing);
    contestant.result = std::move(diagram);
}

void add_errors(const PaperCase& c, const std::vector<Contestant>& contestants,
                const Diagram& exact, Index bisector_points, std::vector<Json>& rows) {
    std::vector<const Diagram*> diagrams;
    diagrams.reserve(contestants.size());
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

void add_label_errors(const PaperCase& c, const std::vector<Contestant>& contestants,
                      Index num_points, std::vector<Json>& rows) {
    const std::vector<SurfacePoint> points = uniform_points(c.surface, num_points, 1);
    std::vector<std::vector<SiteId>> labels;
    for (const Contestant& contestant : contestants) {
        const CellLocator locate(c.surface, contestant.result);
        std::vector<SiteId>& of_points = labels.emplace_back();
        for (const SurfacePoint& point : points) of_points.push_back(locate(point));
    }
    const auto errors = exact_label_errors(c.surface, c.sites, points, labels);
    const double cell_radius = mean_cell_radius(c.surface, c.sites.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i]["wrong_label_percent"] = 100 * errors[i].wrong;
        rows[i]["largest_label_error"] = errors[i].largest / cell_radius;
    }
}

Json row_of(const PaperCase& c, const std::string& method, double p0, double total,
            std::size_t peak_bytes) {
    return {{"mesh", c.mesh},
            {"faces", c.surface.num_faces()},
            {"sites", c.sites.size()},
            {"method", method},
            {"p0_ms", 1e3 * p0},
            {"total_p0", total / p0},
            {"total_ms", 1e3 * total},
            {"peak_mb", 1e-6 * static_cast<double>(peak_bytes)},
            {"bytes_per_face",
             static_cast<double>(peak_bytes) / static_cast<double>(c.surface.num_faces())}};
}

// \param ours  #V: distances of the vertices.
Json row_of_code(const PaperCase& c, const OtherCode& code, std::span<const double> ours,
                 double p0) {
    const PeakBytes peak;
    std::vector<double> theirs;
    const double taken = time([&] { theirs = code.vertex_distances(c.surface, c.sites); }).cpu;
    Json row = row_of(c, code.name, p0, taken, peak.bytes());
    double largest = 0;
    for (std::size_t v = 0; v < ours.size(); ++v) {
        if (ours[v] != theirs[v]) largest = std::max(largest, std::abs(ours[v] - theirs[v]));
    }
    row["propagate_p0"] = taken / p0;
    row["largest_difference"] = largest / mean_cell_radius(c.surface, c.sites.size());
    return row;
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
        rows.push_back(row_of(c, methods[k].name, p0, contestant.total, contestant.peak_bytes));
        rows.back().update(Json{{"base_p0", contestant.base / p0},
                                {"propagate_p0", contestant.propagate / p0},
                                {"diagram_p0", contestant.diagram / p0},
                                {"dual_p0", contestant.dual / p0}});
        const PropagationOptions& how = methods[k].options;
        if (how.engine != Engine::Steiner) continue;
        rows.back().update(Json{{"steiner_points", how.steiner_points}, {"lambda", how.lambda}});
    }
    if (options.with_errors) {
        const auto is_exact = [](const Method& method) {
            return method.options.engine == Engine::Window && method.options.max_error == 0 &&
                   method.drawing == Drawing::OnMesh;
        };
        const auto found = std::find_if(methods.begin(), methods.end(), is_exact);
        const Diagram exact =
            found == methods.end()
                ? exact_diagram(c)
                : contestants[static_cast<std::size_t>(found - methods.begin())].result;
        add_errors(c, contestants, exact, options.bisector_points, rows);
    }
    if (options.label_points > 0) add_label_errors(c, contestants, options.label_points, rows);
    if (options.with_other_codes) {
        for (const OtherCode& code : other_codes()) {
            cli::stop_if_interrupted();
            if (c.surface.num_faces() > code.max_faces) continue;
            rows.push_back(row_of_code(c, code, contestants[0].result.nearest_distance, p0));
        }
    }
    return rows;
}

}  // namespace bench
