// Times the whole pipeline on one surface with good and bad triangles.

#include <numbers>

#include "bench/allocations.h"
#include "bench/coplanar_boxes.h"
#include "bench/report.h"
#include "bench/timing.h"
#include "cli.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"

namespace {

using Json = nlohmann::ordered_json;

const std::vector<bench::Column> columns{{"triangles", "triangles", 0, 20},
                                         {"faces", "faces", 0, 8},
                                         {"seconds", "s", 3, 8},
                                         {"seconds_over_first", "over first", 2, 10},
                                         {"megabytes", "peak MB", 1, 8},
                                         {"megabytes_over_first", "over first", 2, 10},
                                         {"mean_quality", "mean Q", 4, 8},
                                         {"min_angle", "angle", 1, 6},
                                         {"repaired", "repaired", 0, 8}};

Json measure(const bench::NamedMesh& input, agvd::Index samples, int repetitions) {
    remesh::RemeshResult result;
    std::vector<double> seconds;
    std::size_t bytes = 0;
    for (int i = 0; i < repetitions; ++i) {
        cli::stop_if_interrupted();
        const bench::PeakBytes peak;
        seconds.push_back(
            bench::time([&] {
                result = remesh::remesh(
                    input.mesh.view(),
                    {.num_samples = samples, .features = remesh::Features::Off, .num_threads = 1});
            }).cpu);
        bytes = peak.bytes();
    }
    const remesh::Evaluation judged = remesh::evaluate(input.mesh.view(), result.mesh.view());
    constexpr double degrees = 180 / std::numbers::pi;
    return {{"triangles", input.name},
            {"faces", input.mesh.triangles.size()},
            {"seconds", bench::quickest(seconds)},
            {"megabytes", static_cast<double>(bytes) / 1e6},
            {"mean_quality", judged.result.triangles.mean_quality},
            {"min_angle", degrees * judged.result.triangles.min_angle},
            {"repaired", result.cleaned.degenerate_faces + result.cleaned.absorbed_faces}};
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("The whole job on the unit cube, triangulated well and badly (CPU, one thread)",
                 "bench-slivers");
    agvd::Index samples = 2000;
    int repetitions = 3;
    app.add_option("-n,--samples", samples, "Number of sites")->capture_default_str();
    app.add_option("--repetitions", repetitions, "Number of runs of each case; the quickest counts")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    return cli::run(app, argc, argv, [&] {
        bench::print_heading(columns);
        Json first;
        for (const bench::NamedMesh& input : bench::coplanar_boxes()) {
            Json row = measure(input, samples, repetitions);
            if (first.is_null()) first = row;
            for (const char* key : {"seconds", "megabytes"}) {
                row[std::string(key) + "_over_first"] =
                    row[key].get<double>() / first[key].get<double>();
            }
            bench::print_row(columns, row);
        }
    });
}
