// The evaluation of [meng2023] Sec. 6 and 7: tables and figures, with all engines and the exact
// diagram in one execution. A section is one figure or table; each writes JSON and a table, some
// also a plot.

#include <algorithm>

#include "agvd/core/error.h"
#include "bench/exact.h"
#include "bench/face_shapes.h"
#include "cli.h"
#include "make_data/data_files.h"
#include "paper/paper_case.h"
#include "paper/paper_columns.h"
#include "paper/paper_plots.h"
#include "remesh/clean/clean_input.h"
#include "remesh/meshfile/mesh_file.h"

namespace {

namespace fs = std::filesystem;
using namespace agvd;
using Json = nlohmann::ordered_json;
using bench::Column;

constexpr Index label_points = 100'000;

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
    return bench::methods({{Engine::Window, Engine::Steiner},
                           {0, 1e-3},
                           std::move(steiner_points),
                           std::move(lambdas)});
}

// These, and Steiner points on the intrinsic base.
std::vector<bench::Method> methods_and_base(std::vector<int> on_mesh, std::vector<int> on_base) {
    std::vector<bench::Method> all = methods(std::move(on_mesh));
    const auto base =
        bench::on_base(bench::methods({{Engine::Steiner}, {}, std::move(on_base), {1}}));
    all.insert(all.end(), base.begin(), base.end());
    return all;
}

// Where sections get their meshes and put their rows.
class Workshop {
public:
    Workshop(const Arguments& arguments, std::vector<Column> columns)
        : arguments_(arguments), columns_(std::move(columns)) {
        bench::print_heading(columns_);
    }

    [[nodiscard]] bool is_quick_look() const { return !arguments_.instead.empty(); }

    // A mesh without defects.
    // \param min_faces  subdivided until it has as many.
    [[nodiscard]] Surface mesh(const char* name, Index min_faces = 0, double jitter = 0.1) const {
        constexpr Index few = 100;
        const fs::path path = is_quick_look() ? arguments_.instead : arguments_.meshes / name;
        const auto clean = remesh::clean_input(remesh::read_mesh(path).mesh.view());
        return bench::subdivided(build_surface(clean.mesh.view()),
                                 is_quick_look() ? few : min_faces, jitter);
    }

    // Random vertices, fewer in a quick run.
    [[nodiscard]] std::vector<SurfacePoint> sites(const Surface& surface, Index count) const {
        const Index most = is_quick_look() ? surface.num_vertices() / 4 : count;
        return bench::random_sites(surface, std::min(count, most), bench::Place::Vertices, 1);
    }

    // Measures and keeps one row for each method; `more` is added to each. Without CGAL no labels
    // are compared.
    void measure(const std::string& name, const Surface& surface,
                 const std::vector<SurfacePoint>& sites, const std::vector<bench::Method>& by,
                 bench::PaperOptions options = {}, const Json& more = Json::object()) {
        if (!bench::has_exact()) options.label_points = 0;
        options.repetitions = std::min(options.repetitions, arguments_.repetitions);
        std::vector<Json> measured = bench::measure({name, surface, sites}, by, options);
        bench::paper::add_ratios(measured);
        for (Json& row : measured) {
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

// Fig. 1: 30 sites on 50k faces, here those of data/organic.ply.
void fig1(Workshop& shop) {
    const Surface surface =
        shop.is_quick_look() ? shop.mesh("") : build_surface(make_data::organic().view());
    shop.measure("organic", surface, shop.sites(surface, 30), methods({8}),
                 {.with_other_codes = true, .label_points = label_points});
}

// These, and labels of vertices.
std::vector<bench::Method> methods_and_labels(std::vector<int> steiner_points) {
    std::vector<bench::Method> all = methods(std::move(steiner_points));
    all.push_back({"vertex labels", {.max_error = 0}, bench::Drawing::VertexLabels});
    return all;
}

// Table 1: 100 sites on meshes of three of its four sizes.
void table1(Workshop& shop) {
    const std::pair<const char*, Index> meshes[] = {
        {"fertility.off", 30'000}, {"3holes.off", 100'000}, {"fandisk.off", 200'000}};
    for (const auto& [name, faces] : meshes) {
        const Surface surface = shop.mesh(name, faces);
        shop.measure(fs::path(name).stem(), surface, shop.sites(surface, 100),
                     methods_and_labels({5, 8, 12}),
                     {.repetitions = faces < 200'000 ? 3 : 2,
                      .with_other_codes = true,
                      .label_points = label_points});
    }
}

// The fourth size: one run, without errors, which take far longer.
void million(Workshop& shop) {
    const Surface surface = shop.mesh("bunny.off", 1'000'000);
    shop.measure("bunny", surface, shop.sites(surface, 100), methods_and_labels({8}),
                 {.repetitions = 1, .with_errors = false, .with_other_codes = true});
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

// Fig. 9: 30 sites on a cow of at least 50k faces.
void fig9(Workshop& shop) {
    const Surface surface = shop.mesh("spot.obj", 50'000);
    shop.measure("spot", surface, shop.sites(surface, 30), methods({5, 8, 12}),
                 {.label_points = label_points});
}

// Fig. 10: 2 to 30 Steiner points per edge.
void fig10(Workshop& shop) {
    const Surface surface = shop.mesh("3holes.off", 100'000);
    shop.measure("3holes", surface, shop.sites(surface, 100),
                 methods({2, 3, 5, 8, 10, 12, 15, 20, 25, 30}),
                 {.repetitions = 2, .bisector_points = 1000});
}

// Fig. 12: triangles retired every lambda #F pops.
void fig12(Workshop& shop) {
    const Surface surface = shop.mesh("fertility.off", 30'000);
    shop.measure("fertility", surface, shop.sites(surface, 50),
                 methods({8}, {0.01, 0.03, 0.1, 0.3, 1, 3, 10, 100}), {.with_errors = false});
}

// Fig. 13: one surface and set of sites in three resolutions, each in three qualities. The table
// has no |dA - dB|.
void fig13(Workshop& shop) {
    const Surface coarse = shop.mesh("spot.obj");
    const auto corners = shop.sites(coarse, 30);
    for (const Index faces : {20'000u, 90'000u, 300'000u}) {
        for (const double jitter : {0.0, 0.3, 0.45}) {
            const Surface surface = shop.mesh("spot.obj", faces, jitter);
            std::vector<SurfacePoint> sites;  // The coarse mesh's vertices keep their numbers.
            sites.reserve(corners.size());
            for (const SurfacePoint& corner : corners) {
                sites.push_back(point_at(surface, bench::nearest_corner(coarse, corner)));
            }
            const bench::FaceShapes shapes = bench::face_shapes(surface);
            shop.measure("spot", surface, sites, methods_and_base({8}, {8, 12}),
                         {.repetitions = 2, .bisector_points = 1000},
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
        shop.measure(fs::path(name).stem(), surface, shop.sites(surface, 50),
                     methods_and_base({8, 12}, {8, 12}), {.bisector_points = 1000},
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

struct Section {
    const char* name;
    void (*run)(Workshop&);
    std::vector<Column> columns;
    std::vector<bench::Plot> (*plots)(const Json&) = nullptr;
    //! Of the file, if not empty: a row for each case, told apart by `same`, with these columns of
    //! each method.
    std::vector<Column> same = {}, by = {};
};

const std::vector<Section>& sections() {
    using namespace bench::paper;
    static const std::vector<Column> quality{{"mean_lo", "Lo", 2, 5}, {"mean_tau", "tau", 2, 6}};
    static const std::vector<Column> thinness{{"mean_tau", "tau", 1, 6}, {"max_tau", "max", 0, 7}};
    static const std::vector<Column> last{{"dual_p0", "dual", 2, 7},
                                          {"over_exact_distances", "/exact", 2, 7}};
    static const auto costs = join({case_columns(), cost_columns()});
    static const auto with_errors = join({costs, error_columns()});
    static const auto with_labels = join({costs, error_columns(), label_columns(), code_columns()});
    static const auto with_ratios =
        join({costs, ratio_columns(), error_columns(), label_columns()});
    static const std::vector<Section> all{
        {"fig1", fig1, join({with_ratios, code_columns()})},
        {"table1", table1, with_labels},
        {"million", million, join({costs, code_columns()})},
        {"table2",
         table2,
         costs,
         bench::plots_over_sites,
         {{"mesh", "mesh"}, {"sites", "t"}},
         {{"total_p0", "P0", 1}, {"peak_mb", "MB", 1}}},
        {"fig9", fig9, with_ratios},
        {"fig10", fig10, with_errors, bench::plots_over_points},
        {"fig12", fig12, costs, bench::plots_over_lambda},
        {"fig13",
         fig13,
         join({case_columns(), quality, cost_columns(), error_columns()}),
         bench::plots_over_quality,
         {{"faces", "faces"}, {"mean_lo", "Lo", 2}},
         {{"delta_percent", "δ %", 3}, {"total_p0", "P0", 1}, {"peak_mb", "MB", 1}}},
        {"fig14", fig14, join({case_columns(), thinness, cost_columns(), error_columns()})},
        {"fig15", fig15, join({costs, last})},
    };
    return all;
}

void run_section(const Section& section, const Arguments& arguments) {
    cli::print(std::string("\n") + section.name + '\n');
    Workshop shop(arguments, section.columns);
    section.run(shop);
    const fs::path base = arguments.out / section.name;
    bench::write_json(base.string() + ".json", section.name, shop.rows());
    cli::write_text(base.string() + ".md", section.by.empty()
                                               ? bench::markdown(shop.columns(), shop.rows())
                                               : bench::paper::methods_side_by_side(
                                                     section.same, section.by, shop.rows()));
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
    app.add_option("--only", arguments.only, "Sections to run; default: all")
        ->check(CLI::IsMember(names));
    app.add_option(
           "--out", arguments.out,
           "Folder for SECTION.json, SECTION.md and SECTION.svg; it is made if it does not exist")
        ->type_name("FOLDER")
        ->capture_default_str();
    app.add_option("--repetitions", arguments.repetitions,
                   "Largest number of runs of each case; the quickest counts")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--instead", arguments.instead,
                   "Run on this small mesh instead of the meshes of the sections")
        ->type_name("FILE");
    return cli::run(app, argc, argv, [&] {
        if (arguments.meshes.empty() && arguments.instead.empty()) {
            throw InvalidOption("MESHES is missing; name the folder of the meshes");
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
