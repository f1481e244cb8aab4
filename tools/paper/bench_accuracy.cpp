// Error of the diagram against the exact one.

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "bench/method.h"
#include "bench/report.h"
#include "cli.h"
#include "paper/compare.h"

namespace {

using namespace agvd;

const std::vector<bench::Column> columns{
    {"mesh", "mesh", 0},
    {"faces", "faces", 0},
    {"sites", "sites", 0},
    {"method", "method", 0},
    {"certified_error", "certified", -1},
    {"wrong_label_percent", "wrong %", 3},
    {"mean_bisector_error", "|dA-dB|", -2},
    {"p95_bisector_error", "95 %", -2},
    {"max_bisector_error", "largest", -2},
    {"mean_relative_distance", "distance", -2},
    {"min_relative_distance", "lowest", -1},
    {"bisector_points", "points", 0},
};

// One row for each method; all share the exact distances.
nlohmann::ordered_json measure(const std::string& mesh, const IntrinsicTriangulation& base,
                               const std::vector<SurfacePoint>& sites, std::uint64_t seed,
                               const std::vector<bench::Method>& methods,
                               const CompareOptions& compare) {
    const Surface& surface = base.input();
    const std::vector<SurfacePoint> on_base = base.to_intrinsic(sites);
    std::vector<Propagation> propagations;
    std::vector<Diagram> diagrams;
    for (const bench::Method& method : methods) {
        propagations.push_back(propagate(base.surface(), on_base, method.options));
        diagrams.push_back(
            diagram_on_input(base, build_diagram(base.surface(), on_base, propagations.back(),
                                                 {.num_threads = compare.num_threads})));
    }
    std::vector<Approximation> approximations;
    for (std::size_t i = 0; i < diagrams.size(); ++i) {
        approximations.push_back({propagations[i], diagrams[i], &base});
    }
    const auto errors = compare_with_exact(surface, sites, approximations, compare);
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < errors.size(); ++i) {
        rows.push_back({{"mesh", mesh},
                        {"faces", surface.num_faces()},
                        {"sites", sites.size()},
                        {"seed", seed},
                        {"method", methods[i].name},
                        {"certified_error", propagations[i].certified_error},
                        {"wrong_label_percent", 100 * errors[i].wrong_label_area},
                        {"mean_bisector_error", errors[i].bisectors.mean},
                        {"p95_bisector_error", errors[i].bisectors.p95},
                        {"max_bisector_error", errors[i].bisectors.max},
                        {"mean_relative_distance", errors[i].mean_relative_distance},
                        {"min_relative_distance", errors[i].min_relative_distance},
                        {"bisector_points", errors[i].bisectors.num_points}});
    }
    return rows;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Error of the diagram against exact geodesics; |dA-dB| over the mean cell radius",
                 "bench-accuracy");
    bench::Options options;
    options.sites = {30, 100};
    options.steiner_points = {2, 5, 8, 12};
    bench::add_options(app, options);
    std::vector<double> max_errors{0, agvd::default_max_error, 1e-3};
    app.add_option("--max-error", max_errors, "Window engine: largest errors; 0: exact")
        ->capture_default_str();
    CompareOptions compare;
    app.add_option("--threads", compare.num_threads, "Number of threads; 0: all cores")
        ->capture_default_str();
    app.add_option("--samples", compare.area_samples, "Number of points whose labels are compared")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    return cli::run(app, argc, argv, [&] {
        nlohmann::ordered_json rows = nlohmann::ordered_json::array();
        const auto methods = bench::methods(
            {{Engine::Window, Engine::Steiner}, max_errors, options.steiner_points, {1}});
        bench::print_heading(columns);
        for (const auto& path : options.meshes) {
            const Surface surface = bench::load(path, 0);
            const IntrinsicTriangulation base(surface);
            for (const Index count : options.sites) {
                cli::stop_if_interrupted();
                const auto sites = bench::random_sites(surface, count, options.place, options.seed);
                for (const auto& row :
                     measure(path.stem(), base, sites, options.seed, methods, compare)) {
                    bench::print_row(columns, row);
                    rows.push_back(row);
                }
            }
        }
        bench::write_json(options, "accuracy", rows);
    });
}
