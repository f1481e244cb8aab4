// The evaluation of [meng2023] Sec. 6 and 7: tables and figures, all engines and the exact diagram
// side by side in one run.

#include <algorithm>
#include <functional>
#include <map>

#include "agvd/core/error.h"
#include "bench/face_shapes.h"
#include "bench/paper_case.h"
#include "bench/plot.h"
#include "bench/report.h"
#include "cli.h"
#include "remesh/io/read_mesh.h"
#include "remesh/repair/clean_input.h"

namespace {

namespace fs = std::filesystem;
using namespace agvd;
using Json = nlohmann::ordered_json;
using bench::Column;

struct Arguments {
    fs::path meshes;
    fs::path instead;  // Empty: each section's own meshes.
    fs::path out = ".";
    std::vector<std::string> only;
    int repetitions = 3;
};

// The methods of most sections.
std::vector<bench::Method> methods(std::vector<int> steiner_points,
                                   std::vector<double> lambdas = {1}) {
    return bench::methods({{Engine::Window, Engine::Steiner, Engine::Vertex},
                           {0, 1e-3},
                           std::move(steiner_points),
                           std::move(lambdas)});
}

// Where sections get their meshes and put their rows.
class Workshop {
public:
    Workshop(const Arguments& arguments, std::vector<Column> columns)
        : arguments_(arguments), columns_(std::move(columns)) {
        bench::print_heading(columns_);
    }

    [[nodiscard]] bool is_quick_look() const { return !arguments_.instead.empty(); }

    // A mesh without defects. \param min_faces  subdivided until it has as many.
    [[nodiscard]] Surface mesh(const char* name, Index min_faces = 0, double jitter = 0.1) const {
        constexpr Index few = 100;
        const fs::path path = is_quick_look() ? arguments_.instead : arguments_.meshes / name;
        const auto clean = remesh::clean_input(remesh::read_mesh(path).mesh.view());
        return bench::subdivided(build_surface(clean.mesh.view()),
                                 is_quick_look() ? few : min_faces, jitter);
    }

    // Random vertices, as many as there can be in a quick look.
    [[nodiscard]] std::vector<SurfacePoint> sites(const Surface& surface, Index count) const {
        const Index most = is_quick_look() ? surface.num_vertices() / 4 : count;
        return bench::random_sites(surface, std::min(count, most), bench::Place::Vertices, 1);
    }

    // Measures and keeps one row for each method; `more` is added to each.
    void measure(const std::string& name, const Surface& surface,
                 const std::vector<SurfacePoint>& sites, const std::vector<bench::Method>& by,
                 bench::PaperOptions options = {}, const Json& more = Json::object()) {
        options.repetitions = std::min(options.repetitions, arguments_.repetitions);
        std::size_t i = 0;
        for (Json& row : bench::measure({name, surface, sites}, by, options)) {
            const PropagationOptions& how = by[i++].options;
            row["steiner_points"] =
                how.engine == Engine::Steiner ? Json(how.steiner_points) : Json();
            row["lambda"] = how.engine == Engine::Steiner ? Json(how.lambda) : Json();
            row.update(more);
            bench::print_row(columns_, row);
            rows_.push_back(row);
        }
    }

    [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
    [[nodiscard]] const Json& rows() const { return rows_; }
    [[nodiscard]] Json& rows() { return rows_; }

private:
    const Arguments& arguments_;
    std::vector<Column> columns_;
    Json rows_ = Json::array();
};

constexpr int wide = 24;
const std::vector<Column> case_columns{{"mesh", "mesh", 0, wide},
                                       {"faces", "faces", 0, 8},
                                       {"sites", "t", 0, 5},
                                       {"method", "method", 0, 16}};
const std::vector<Column> cost_columns{{"total_p0", "all, P0", 1, 8},
                                       {"propagate_p0", "distances", 1, 9},
                                       {"diagram_p0", "diagram", 1, 8},
                                       {"peak_mb", "MB", 2, 8},
                                       {"bytes_per_face", "B/face", 0, 6}};
const std::vector<Column> error_columns{
    {"delta_percent", "delta %", 3, 8},        {"frechet_radii", "F/radius", 3, 9},
    {"hausdorff_radii", "Hausdorff", 4, 9},    {"wrong_percent", "wrong %", 3, 8},
    {"mean_bisector_error", "|dA-dB|", -1, 8}, {"p95_bisector_error", "95 %", -1, 8},
    {"max_bisector_error", "largest", -1, 8}};

std::vector<Column> join(std::initializer_list<std::vector<Column>> parts) {
    std::vector<Column> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

// One series of y over x for each method, of the rows that `wanted` lets through.
std::vector<bench::Series> series(const Json& rows, const std::string& x, const std::string& y,
                                  const std::function<std::string(const Json&)>& name_of) {
    std::vector<bench::Series> all;
    for (const Json& row : rows) {
        const std::string name = name_of(row);
        if (name.empty() || !row.contains(y) || !row[y].is_number()) continue;
        auto found = std::find_if(all.begin(), all.end(),
                                  [&](const bench::Series& s) { return s.name == name; });
        if (found == all.end()) found = all.insert(all.end(), {name, {}});
        const double at = row[x].is_number() ? row[x].get<double>() : 0;
        found->points.emplace_back(at, row[y].get<double>());
    }
    return all;
}

// Table 1: 100 sites on four meshes.
void table1(Workshop& shop) {
    const std::pair<const char*, Index> meshes[] = {{"fertility.off", 30'000},
                                                    {"3holes.off", 100'000},
                                                    {"fandisk.off", 200'000},
                                                    {"bunny.off", 1'000'000}};
    for (const auto& [name, faces] : meshes) {
        const Surface surface = shop.mesh(name, faces);
        const int repetitions = faces < 200'000 ? 3 : faces < 1'000'000 ? 2 : 1;
        shop.measure(fs::path(name).stem(), surface, shop.sites(surface, 100), methods({5, 8, 12}),
                     {.repetitions = repetitions});
    }
}

// Table 2: 2 to 2000 sites on two meshes.
void table2(Workshop& shop) {
    for (const auto& [name, faces] :
         {std::pair{"fertility.off", Index{30'000}}, {"3holes.off", 100'000}}) {
        const Surface surface = shop.mesh(name, faces);
        for (const Index count : {2u, 4u, 8u, 10u, 50u, 100u, 500u, 1000u, 1500u, 2000u}) {
            shop.measure(fs::path(name).stem(), surface, shop.sites(surface, count), methods({8}),
                         {.repetitions = 2, .with_errors = false});
        }
    }
}

// Fig. 10: 2 to 30 Steiner points per edge.
void fig10(Workshop& shop) {
    const Surface surface = shop.mesh("3holes.off", 100'000);
    shop.measure("3holes", surface, shop.sites(surface, 100),
                 methods({2, 3, 5, 8, 10, 12, 15, 20, 25, 30}), {.repetitions = 2});
}

// Fig. 12: triangles retired every lambda #F pops.
void fig12(Workshop& shop) {
    const Surface surface = shop.mesh("fertility.off", 30'000);
    shop.measure("fertility", surface, shop.sites(surface, 50),
                 methods({8}, {0.01, 0.03, 0.1, 0.3, 1, 3, 10, 100}), {.with_errors = false});
}

// Fig. 13: one surface and set of sites in three resolutions, each in three qualities.
void fig13(Workshop& shop) {
    const Surface coarse = shop.mesh("spot.obj");
    const auto corners = shop.sites(coarse, 30);
    for (const Index faces : {20'000u, 90'000u, 300'000u}) {
        for (const double jitter : {0.0, 0.3, 0.45}) {
            const Surface surface = shop.mesh("spot.obj", faces, jitter);
            std::vector<SurfacePoint> sites;  // The coarse mesh's vertices keep their numbers.
            for (const SurfacePoint& corner : corners) {
                const auto k =
                    std::max_element(corner.barycentric.begin(), corner.barycentric.end()) -
                    corner.barycentric.begin();
                const Triangle& triangle = coarse.mesh.triangles[corner.face.value()];
                sites.push_back(bench::point_at(surface, triangle[static_cast<std::size_t>(k)]));
            }
            const bench::FaceShapes shapes = bench::face_shapes(surface);
            shop.measure("spot", surface, sites, methods({8}), {.repetitions = 2},
                         {{"mean_lo", shapes.mean_lo}, {"mean_tau", shapes.mean_tau}});
        }
    }
}

// Fig. 14: meshes of long thin triangles. Exact searches are costly there: few points.
void fig14(Workshop& shop) {
    for (const char* name :
         {"dirty/58011.stl", "dirty/65004.stl", "dirty/72214.stl", "dirty/79741.stl"}) {
        const Surface surface = shop.mesh(name);
        const bench::FaceShapes shapes = bench::face_shapes(surface);
        shop.measure(fs::path(name).stem(), surface, shop.sites(surface, 50), methods({8, 12}),
                     {.bisector_points = 1000},
                     {{"mean_tau", shapes.mean_tau}, {"max_tau", shapes.max_tau}});
    }
}

// Fig. 15: 2000 sites on 200k faces, and the dual.
void fig15(Workshop& shop) {
    const Surface surface = shop.mesh("fandisk.off", 200'000);
    shop.measure("fandisk", surface, shop.sites(surface, 2000), methods({8}),
                 {.with_errors = false, .with_dual = true});
    double exact_distances = 0;
    for (Json& row : shop.rows()) {
        if (row["method"] == "window exact") exact_distances = row["propagate_p0"];
    }
    for (Json& row : shop.rows()) {
        row["over_exact_distances"] = row["total_p0"].get<double>() / exact_distances;
    }
}

std::string method_of(const Json& row) { return row["method"]; }

std::vector<bench::Plot> plots_over_sites(const Json& rows) {
    const auto largest = [&](const Json& row) {
        return row["mesh"] == rows.back()["mesh"] ? method_of(row) : "";
    };
    return {{"Time", "sites", "all, P0", true, true, series(rows, "sites", "total_p0", largest)},
            {"Memory", "sites", "MB beyond the mesh", true, true,
             series(rows, "sites", "peak_mb", largest)}};
}

// One name for all of the Steiner engine, whose points are told by x.
std::string engine_of(const Json& row) {
    return row["steiner_points"].is_number() ? "steiner" : method_of(row);
}

std::vector<bench::Plot> plots_over_points(const Json& rows) {
    const auto plot = [&](const char* title, const char* label, const char* key) {
        return bench::Plot{title, "Steiner points per edge",
                           label, false,
                           true,  series(rows, "steiner_points", key, engine_of)};
    };
    return {plot("Time", "all, P0", "total_p0"), plot("Error of Eq. 9", "%", "delta_percent"),
            plot("Area in wrong cells", "%", "wrong_percent")};
}

std::vector<bench::Plot> plots_over_lambda(const Json& rows) {
    const auto plot = [&](const char* title, const char* label, const char* key) {
        return bench::Plot{title, "lambda", label,
                           true,  false,    series(rows, "lambda", key, engine_of)};
    };
    return {plot("Time", "all, P0", "total_p0"), plot("Memory", "MB beyond the mesh", "peak_mb")};
}

std::vector<bench::Plot> plots_over_quality(const Json& rows) {
    const auto at = [](const char* method) {
        return [=](const Json& row) {
            return row["method"] == method ? std::to_string(row["faces"].get<int>()) + " faces"
                                           : std::string();
        };
    };
    return {{"steiner m=8", "mean Lo", "delta, %", false, true,
             series(rows, "mean_lo", "delta_percent", at("steiner m=8"))},
            {"window 0.001", "mean Lo", "delta, %", false, true,
             series(rows, "mean_lo", "delta_percent", at("window 0.001"))}};
}

struct Section {
    const char* name;
    void (*run)(Workshop&);
    std::vector<Column> columns;
    std::vector<bench::Plot> (*plots)(const Json&) = nullptr;
};

const std::vector<Section>& sections() {
    static const std::vector<Section> all{
        {"table1", table1, join({case_columns, cost_columns, error_columns})},
        {"table2", table2, join({case_columns, cost_columns}), plots_over_sites},
        {"fig10", fig10, join({case_columns, cost_columns, error_columns}), plots_over_points},
        {"fig12", fig12, join({case_columns, cost_columns}), plots_over_lambda},
        {"fig13", fig13,
         join({case_columns,
               {{"mean_lo", "Lo", 2, 5}, {"mean_tau", "tau", 2, 6}},
               cost_columns,
               error_columns}),
         plots_over_quality},
        {"fig14", fig14,
         join({case_columns,
               {{"mean_tau", "tau", 1, 6}, {"max_tau", "max", 0, 7}},
               cost_columns,
               error_columns})},
        {"fig15", fig15,
         join({case_columns,
               cost_columns,
               {{"dual_p0", "dual", 2, 7}, {"over_exact_distances", "/exact", 2, 7}}})},
    };
    return all;
}

void run_section(const Section& section, const Arguments& arguments) {
    cli::print(std::string("\n") + section.name + '\n');
    Workshop shop(arguments, section.columns);
    section.run(shop);
    const fs::path base = arguments.out / section.name;
    bench::write_json(base.string() + ".json", section.name, shop.rows());
    cli::write_text(base.string() + ".md", bench::markdown(shop.columns(), shop.rows()));
    if (section.plots != nullptr) {
        cli::write_text(base.string() + ".svg", bench::to_svg(section.plots(shop.rows())));
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Tables and figures of the paper's evaluation: time (one thread, in P0), memory (allocated "
        "beyond the mesh) and error against the exact diagram",
        "bench-paper");
    Arguments arguments;
    std::vector<std::string> names;
    for (const Section& section : sections()) names.emplace_back(section.name);
    app.add_option("MESHES", arguments.meshes, "Folder of the meshes")->type_name("FOLDER");
    app.add_option("--only", arguments.only, "Sections to run; all without this")
        ->check(CLI::IsMember(names));
    app.add_option("--out", arguments.out,
                   "Folder for SECTION.json, SECTION.md and SECTION.svg; made if need be")
        ->type_name("FOLDER")
        ->capture_default_str();
    app.add_option("--repetitions", arguments.repetitions,
                   "At most so many runs of each case; the quickest counts")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--instead", arguments.instead,
                   "Run on this small mesh instead of each section's; a quick look")
        ->type_name("FILE");
    return cli::run(app, argc, argv, [&] {
        if (arguments.meshes.empty() && arguments.instead.empty()) {
            throw InvalidOption("name the folder of the meshes");
        }
        fs::create_directories(arguments.out);
        for (const Section& section : sections()) {
            const auto& only = arguments.only;
            if (!only.empty() && std::find(only.begin(), only.end(), section.name) == only.end()) {
                continue;
            }
            run_section(section, arguments);
        }
    });
}
