// Relaxation of uneven starts: the final energy, divided by that of the default start after the
// same number of steps. It shows whether uneven starts (all sites on one spot, in one face, on a
// part of the surface) are evened out.

#include <algorithm>
#include <cmath>

#include "agvd/core/random.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "bench/report.h"
#include "cli.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/relax_network.h"
#include "remesh/sites/sites.h"

namespace {

using namespace agvd;
using Json = nlohmann::ordered_json;

struct Arguments {
    std::vector<std::filesystem::path> meshes;
    Index samples = 2000;
    std::vector<int> steps{40, 100};
};

struct Start {
    std::string name;
    std::vector<SurfacePoint> sites;
};

// Random points, even by area, on the faces nearest to the spot that have this share of the area.
std::vector<SurfacePoint> around(const Surface& surface, const SurfacePoint& spot, double share,
                                 Index count) {
    const Propagation from_spot = propagate(surface, {{spot}}, {.num_threads = 1});
    std::vector<std::pair<double, Index>> faces;
    double area = 0;
    const auto area_of = [&](Index f) {
        return surface.length_of(3 * f) * surface.apex[3 * f].y() / 2;
    };
    for (Index f = 0; f < surface.num_faces(); ++f) {
        faces.emplace_back(from_spot.vertex_distance[surface.mesh.triangles[f][0]], f);
        area += area_of(f);
    }
    std::sort(faces.begin(), faces.end());
    std::vector<double> area_up_to{0};
    while (area_up_to.size() <= faces.size() && area_up_to.back() < share * area) {
        area_up_to.push_back(area_up_to.back() + area_of(faces[area_up_to.size() - 1].second));
    }
    std::vector<SurfacePoint> sites;
    for (Index i = 0; i < count; ++i) {
        const double at = random_unit(3, 0, i) * area_up_to.back();
        const auto up_to = std::upper_bound(area_up_to.begin() + 1, area_up_to.end() - 1, at);
        const Index f = faces[static_cast<std::size_t>(up_to - area_up_to.begin()) - 1].second;
        sites.push_back(
            {FaceId(f), uniform_barycentric(random_unit(3, 1, i), random_unit(3, 2, i))});
    }
    return sites;
}

std::vector<Start> starts(const Surface& surface, Index count) {
    const SurfacePoint spot{FaceId(surface.num_faces() / 2), {0.2, 0.3, 0.5}};
    const auto sample = [&](Index number, remesh::Init init) {
        return remesh::sample_sites(surface, {.num_samples = number, .init = init});
    };
    const auto half = sample(count / 2, remesh::Init::BlueNoise);
    std::vector<Start> all{{"random", sample(count, remesh::Init::Random)},
                           {"farthest", sample(count, remesh::Init::Farthest)},
                           {"all on one spot", std::vector(count, spot)},
                           {"all in one face", around(surface, spot, 1e-12, count)},
                           {"all on 5 % of the area", around(surface, spot, 0.05, count)},
                           {"all on 20 %", around(surface, spot, 0.2, count)},
                           {"all on half of it", around(surface, spot, 0.5, count)},
                           {"half on one spot", half},
                           {"each site twice", half}};
    all[7].sites.resize(count, spot);
    all[8].sites.insert(all[8].sites.end(), half.begin(), half.end());
    return all;
}

double last_energy(const remesh::RelaxResult& result) { return result.levels.back().energy.back(); }

// Adds to the row of each start a value for each number of steps.
void measure(const std::filesystem::path& path, const Arguments& arguments, Json& rows) {
    const Surface surface = bench::load(path, 0);
    const remesh::PreparedSurface prepared(surface,
                                           remesh::mean_spacing(surface, arguments.samples));
    const remesh::NetworkPlan plan = remesh::plan_network(
        surface, std::vector<std::uint8_t>(surface.num_edges(), 0), arguments.samples);
    const remesh::PreparedSurface on_plan(plan.cut.surface(),
                                          remesh::mean_spacing(surface, arguments.samples));
    const std::vector<Start> all = starts(surface, arguments.samples);
    if (rows.empty()) {
        for (const Start& start : all) rows.push_back({{"start", start.name}});
    }
    for (const int steps : arguments.steps) {
        // No early end: each start takes all of its steps.
        const remesh::RelaxOptions options{.steps = steps, .tolerance = 0};
        const double usual =
            remesh::sample_network_sites(on_plan, plan, {.num_samples = arguments.samples}, options)
                .levels.back()
                .energy.back();
        for (std::size_t i = 0; i < all.size(); ++i) {
            cli::stop_if_interrupted();
            rows[i][path.stem().string() + ' ' + std::to_string(steps)] =
                last_energy(remesh::relax_sites(prepared, all[i].sites, options)) / usual;
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Energy after relaxation from uneven starts, divided by that of the default start",
                 "bench-starts");
    Arguments arguments;
    app.add_option("MESHES", arguments.meshes, "Meshes to read")->required();
    app.add_option("-n,--samples", arguments.samples, "Number of sites")->capture_default_str();
    app.add_option("-k,--steps", arguments.steps, "Numbers of relaxation steps")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    return cli::run(app, argc, argv, [&] {
        std::vector<bench::Column> columns{{"start", "start", 0, 24}};
        Json rows = Json::array();
        for (const auto& path : arguments.meshes) {
            measure(path, arguments, rows);
            for (const int steps : arguments.steps) {
                const std::string key = path.stem().string() + ' ' + std::to_string(steps);
                columns.push_back({key, key, 3, 15});
            }
        }
        bench::print_heading(columns);
        for (const Json& row : rows) bench::print_row(columns, row);
    });
}
