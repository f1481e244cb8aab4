// Quality against time for several numbers of relaxation steps: remeshes each mesh with each number
// of steps, measures the results as remesh-eval does, and writes a table, medians over the meshes,
// and plots. A time is the processor time of a whole run on one thread, the quickest of several.

#include <algorithm>

#include "bench/plot.h"
#include "bench/report.h"
#include "bench/timing.h"
#include "cli.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr double degrees = 57.29577951308232;

struct Arguments {
    std::vector<fs::path> meshes;
    agvd::Index samples = 2000;
    std::vector<int> steps{0, 5, 10, 20, 40, 80, 160};
    int repetitions = 3;
    fs::path out = ".";
};

const std::vector<bench::Column> columns{{"mesh", "mesh"},
                                         {"steps", "steps", 0, 6},
                                         {"seconds", "s", 3, 7},
                                         {"mean_quality", "mean Q", 3, 7},
                                         {"min_quality", "min Q", 3, 7},
                                         {"mean_min_angle", "mean smallest angle", 1, 20},
                                         {"min_angle", "smallest angle", 1, 15},
                                         {"valence_6", "valence 6 %", 1, 12},
                                         {"rms", "RMS %", 4, 8},
                                         {"hausdorff", "Hausdorff %", 3, 12}};

Json measure(const fs::path& path, const agvd::TriangleMesh& mesh, int steps,
             const Arguments& arguments) {
    remesh::RemeshResult result;
    std::vector<double> seconds;
    for (int i = 0; i < arguments.repetitions; ++i) {
        cli::stop_if_interrupted();
        seconds.push_back(bench::time([&] {
                              result =
                                  remesh::remesh(mesh.view(), {.num_samples = arguments.samples,
                                                               .features = remesh::Features::Off,
                                                               .relax_steps = steps,
                                                               .num_threads = 1});
                          }).cpu);
    }
    const remesh::Evaluation judged = remesh::evaluate(mesh.view(), result.mesh.view());
    const remesh::TriangleQuality& quality = judged.result.triangles;
    Json row{{"mesh", path.stem()},
             {"steps", steps},
             {"seconds", bench::quickest(seconds)},
             {"mean_quality", quality.mean_quality},
             {"min_quality", quality.min_quality},
             {"mean_min_angle", degrees * quality.mean_min_angle},
             {"min_angle", degrees * quality.min_angle},
             {"valence_6", 100 * quality.regular_share},
             {"rms", nullptr},
             {"hausdorff", nullptr}};
    if (judged.distance) {  // With CGAL.
        const auto distance = judged.distance->percent_of_diagonal(judged.distance->two_sided());
        row["rms"] = distance.rms;
        row["hausdorff"] = distance.max;
    }
    return row;
}

// The median over the meshes, for each number of steps.
Json medians(const Json& rows, const std::vector<int>& steps) {
    Json result = Json::array();
    for (const int k : steps) {
        Json& row = result.emplace_back(Json{{"mesh", "median"}, {"steps", k}});
        for (std::size_t c = 2; c < columns.size(); ++c) {
            std::vector<double> values;
            for (const Json& one : rows) {
                const Json& value = one[columns[c].key];
                if (one["steps"] == k && value.is_number()) values.push_back(value);
            }
            row[columns[c].key] = values.empty() ? Json() : Json(bench::median(values));
        }
    }
    return result;
}

// Each measure over time, a line for each mesh; the points of a line are the numbers of steps.
std::vector<bench::Plot> plots(const Json& rows, const std::vector<int>& steps) {
    std::string x_label = "seconds, one thread; steps";
    for (const int k : steps) x_label += ' ' + std::to_string(k);
    const auto plot = [&](const char* title, const char* key) {
        bench::Plot result{
            .title = title, .x_label = x_label, .y_label = title, .is_y_from_zero = false};
        for (const Json& row : rows) {
            if (!row[key].is_number()) continue;
            const std::string name = row["mesh"];
            if (result.series.empty() || result.series.back().name != name) {
                result.series.push_back({name, {}});
            }
            result.series.back().points.emplace_back(row["seconds"], row[key]);
        }
        return result;
    };
    return {plot("Mean Q", "mean_quality"), plot("Mean smallest angle, degrees", "mean_min_angle"),
            plot("RMS distance, % of the diagonal", "rms")};
}

void run(const Arguments& arguments) {
    fs::create_directories(arguments.out);
    Json rows = Json::array();
    bench::print_heading(columns);
    const auto add = [&](const Json& row) {
        rows.push_back(row);
        bench::print_row(columns, row);
    };
    for (const fs::path& path : arguments.meshes) {
        const agvd::TriangleMesh mesh = remesh::read_mesh(path).mesh;
        for (const int steps : arguments.steps) add(measure(path, mesh, steps, arguments));
    }
    if (arguments.meshes.size() > 1) {
        for (const Json& row : medians(rows, arguments.steps)) add(row);
    }
    const fs::path base = arguments.out / "relax";
    bench::write_json(base.string() + ".json", "relax", rows);
    cli::write_text(base.string() + ".md", bench::markdown(columns, rows));
    cli::write_text(base.string() + ".svg", bench::to_svg(plots(rows, arguments.steps)));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Quality of remeshed surfaces over the time that relaxation takes (CPU, one thread)",
        "bench-relax");
    Arguments arguments;
    app.add_option("MESHES", arguments.meshes, "Meshes to read")->required();
    app.add_option("-n,--samples", arguments.samples, "Number of sites")->capture_default_str();
    app.add_option("-k,--steps", arguments.steps, "Numbers of relaxation steps, ascending")
        ->check(CLI::Range(0, 1'000'000))
        ->capture_default_str();
    app.add_option("--repetitions", arguments.repetitions,
                   "Number of runs of each case; the quickest counts")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--out", arguments.out,
                   "Folder for relax.json, relax.md and relax.svg; it is made if it does not exist")
        ->type_name("FOLDER")
        ->capture_default_str();
    return cli::run(app, argc, argv, [&] { run(arguments); });
}
