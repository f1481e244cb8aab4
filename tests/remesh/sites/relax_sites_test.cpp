// What relaxation promises, on surfaces of all kinds.
#include "remesh/sites/sites.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "agvd/core/random.h"
#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "agvd/propagation/propagate.h"
#include "remesh/curves/walk.h"
#include "remesh/dual/triangulate_sites.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/sites/levels.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/relax_network.h"
#include "remesh/sites/relaxation.h"
#include "remesh/sites/sampling.h"
#include "remesh/sites/site_dual.h"
#include "support/files.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;
using remesh::Init;
using remesh::PreparedSurface;
using remesh::relax_sites;
using remesh::RelaxResult;
using remesh::sample_sites;
using remesh::detail::even_out;

namespace {

// A spacing that asks for no vertices besides the surface's own.
constexpr double unrefined = std::numeric_limits<double>::infinity();

std::vector<agvd::TriangleMesh> all_shapes() {
    return {shapes::sphere(4),
            shapes::torus(60, 30),
            shapes::tube(60, 30),
            shapes::grid(40),
            shapes::join(shapes::sphere(3), shapes::torus(40, 20)),
            shapes::jitter(shapes::sphere(4), 0.02, 5)};
}

// A box of height 0.02 over the unit square.
agvd::TriangleMesh thin_plate() {
    agvd::TriangleMesh mesh = shapes::cube();
    for (int i = 0; i < 4; ++i) mesh = shapes::subdivide(mesh);
    for (Vec3& p : mesh.positions) p.z() *= 0.02;
    return mesh;
}

// Coarse to fine, with sites along the boundary.
RelaxResult sample_relaxed(const Surface& surface, const remesh::SamplingOptions& sampling,
                           const remesh::RelaxOptions& options = {}) {
    const remesh::NetworkPlan plan = remesh::plan_network(
        surface, std::vector<std::uint8_t>(surface.num_edges(), 0), sampling.num_samples);
    const PreparedSurface prepared(plan.cut.surface(), unrefined);
    remesh::NetworkSites result = remesh::sample_network_sites(prepared, plan, sampling, options);
    return {std::move(result.sites), std::move(result.levels)};
}

// Of inner sites, by exact distances.
std::size_t num_cells_at_boundary(const Surface& surface, const std::vector<SurfacePoint>& sites) {
    const auto diagram = agvd::build_diagram(surface, sites, agvd::propagate(surface, sites));
    std::set<agvd::SiteId> found;
    for (const agvd::VoronoiEdge& edge : diagram.edges) {
        if (edge.right.is_valid()) continue;
        if (!remesh::detail::boundary_half_edge(surface, sites[edge.left.value()])) {
            found.insert(edge.left);
        }
    }
    return found.size();
}

// The integral of the squared distance from the nearest site, by exact distances.
double energy(const Surface& surface, const std::vector<SurfacePoint>& sites) {
    const agvd::Propagation result = agvd::propagate(surface, sites, {.max_error = 0.0});
    double sum = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        const auto& [u, v, w] = surface.mesh.triangles[f];
        const double a = result.vertex_distance[u], b = result.vertex_distance[v];
        const double c = result.vertex_distance[w];
        sum += surface.length_of(3 * f) * surface.apex[3 * f].y() / 12 *
               (a * a + b * b + c * c + a * b + b * c + c * a);
    }
    return sum;
}

void expect_on_surface(const Surface& surface, const std::vector<SurfacePoint>& sites) {
    for (const SurfacePoint& site : sites) {
        ASSERT_LT(site.face.value(), surface.num_faces());
        const auto& [x, y, z] = site.barycentric;
        EXPECT_GE(std::min({x, y, z}), 0);
        EXPECT_NEAR(x + y + z, 1, 1e-12);
    }
}

}  // namespace

TEST(RelaxSites, TheEnergyFallsAndHardlyEverRises) {
    for (const agvd::TriangleMesh& mesh : all_shapes()) {
        const Surface surface = agvd::build_surface(mesh.view());
        const PreparedSurface prepared(surface, unrefined);
        const bool is_closed = boundary_loops(surface).empty();
        for (const Init init : {Init::Random, Init::BlueNoise}) {
            const auto start = sample_sites(surface, {.num_samples = 180, .init = init});
            const RelaxResult result = relax_sites(prepared, start, {.steps = 60});
            expect_on_surface(surface, result.sites);
            ASSERT_EQ(result.levels.size(), 1u);
            const std::vector<double>& e = result.levels[0].energy;
            EXPECT_EQ(result.levels[0].num_sites, 180u);
            EXPECT_LE(e.size(), 61u);
            // Without sites on the boundary, what the triangles leave out there varies.
            for (std::size_t i = 1; is_closed && i < e.size(); ++i) {
                EXPECT_LE(e[i], 1.03 * e[i - 1]) << i;
            }
            EXPECT_LT(energy(surface, result.sites), 0.97 * energy(surface, start));
        }
    }
}

TEST(RelaxSites, TheCallersRuleEndsALevel) {
    const Surface surface = agvd::build_surface(shapes::sphere(4).view());
    const PreparedSurface prepared(surface, unrefined);
    const auto start = sample_sites(surface, {.num_samples = 180, .init = Init::Random});
    std::vector<std::vector<double>> told;
    const auto goes_on = [&](const remesh::RelaxLevel& level) {
        EXPECT_EQ(level.num_sites, 180u);
        told.push_back(level.energy);
        return told.size() < 4;
    };
    const RelaxResult ended = relax_sites(prepared, start, {.steps = 60, .goes_on = goes_on});
    const RelaxResult four = relax_sites(prepared, start, {.steps = 4});
    EXPECT_EQ(ended.sites, four.sites);
    EXPECT_EQ(ended.levels.at(0).energy, four.levels.at(0).energy);
    ASSERT_EQ(told.size(), 4u);
    for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i].size(), i + 2);
    EXPECT_EQ(told.back(), ended.levels[0].energy);
}

TEST(RelaxSites, SitesStayOnTheirComponent) {
    const agvd::TriangleMesh mesh = shapes::join(shapes::sphere(3), shapes::torus(40, 20));
    const Surface surface = agvd::build_surface(mesh.view());
    const std::size_t num_sphere_faces = shapes::sphere(3).triangles.size();
    const auto on_sphere = [&](const SurfacePoint& s) { return s.face.value() < num_sphere_faces; };
    const auto start = sample_sites(surface, {.num_samples = 150, .init = Init::Random});
    const auto end = relax_sites(PreparedSurface(surface, unrefined), start).sites;
    ASSERT_EQ(start.size(), end.size());
    for (std::size_t i = 0; i < start.size(); ++i) {
        EXPECT_EQ(on_sphere(start[i]), on_sphere(end[i])) << i;
    }
}

TEST(RelaxSites, NoSiteCrossesAThinWall) {
    const Surface surface = agvd::build_surface(thin_plate().view());
    const auto start = sample_sites(surface, {.num_samples = 400});
    const auto end = relax_sites(PreparedSurface(surface, unrefined), start).sites;
    int num_inner = 0;
    for (std::size_t i = 0; i < start.size(); ++i) {
        const Vec3 a = position(surface.mesh.view(), start[i]);
        const Vec3 b = position(surface.mesh.view(), end[i]);
        const double rim = std::min({a.x(), a.y(), 1 - a.x(), 1 - a.y()});
        if (rim < 0.2) continue;  // May have walked around the rim.
        ++num_inner;
        EXPECT_EQ(a.z() > 0.01, b.z() > 0.01) << i;
    }
    EXPECT_GT(num_inner, 50);
}

TEST(RelaxSites, BoundarySitesStayOnTheBoundaryAndFixedOnesWhereTheyAre) {
    const Surface surface = agvd::build_surface(shapes::grid(40).view());
    auto start = sample_sites(surface, {.num_samples = 200});
    Index num_boundary = 0;
    for (Index h = 0; h < surface.twin.size(); ++h) {
        if (surface.twin[h] != agvd::no_index || h % 4 != 0) continue;
        SurfacePoint site{agvd::FaceId(Surface::face(h)), {0, 0, 0}};
        site.barycentric[h % 3] = 0.7;
        site.barycentric[Surface::next(h) % 3] = 0.3;
        start.push_back(site);
        ++num_boundary;
    }
    ASSERT_GT(num_boundary, 10u);
    std::vector<std::uint8_t> is_fixed(start.size(), 0);
    for (std::size_t i = 0; i < start.size(); i += 7) is_fixed[i] = 1;
    const auto end = relax_sites(PreparedSurface(surface, unrefined), start,
                                 {.is_fixed = is_fixed, .boundary = remesh::Boundary::Free})
                         .sites;
    Index num_moved_along = 0;
    for (std::size_t i = 0; i < start.size(); ++i) {
        const bool was = remesh::detail::boundary_half_edge(surface, start[i]).has_value();
        EXPECT_EQ(remesh::detail::boundary_half_edge(surface, end[i]).has_value(), was) << i;
        const bool stays = start[i] == end[i];
        if (is_fixed[i] != 0) {
            EXPECT_TRUE(stays) << i;
        }
        if (was && !stays) ++num_moved_along;
    }
    EXPECT_GT(num_moved_along, num_boundary / 2);
}

// Before the first step, as far as labels tell: those that the diagram sees in the end are few.
TEST(RelaxSites, SitesWhoseCellsMeetTheBoundaryMoveOntoIt) {
    const Surface surface = agvd::build_surface(shapes::grid(60).view());
    const PreparedSurface prepared(surface, unrefined);
    constexpr std::array<Index, 4> corners{0, 60, 60 * 61, 61 * 61 - 1};
    const auto start =
        sample_sites(surface, {.num_samples = 200, .boundary = remesh::Boundary::Free});
    EXPECT_GT(num_cells_at_boundary(surface, start), 30u);
    const auto end = relax_sites(prepared, start).sites;
    EXPECT_LE(num_cells_at_boundary(surface, end), 6u);
    for (const Index v : corners) {
        EXPECT_TRUE(std::any_of(end.begin(), end.end(), [&](const SurfacePoint& site) {
            return agvd::vertex_of(surface, site) == v;
        })) << v;
    }
    const auto free = relax_sites(prepared, start, {.boundary = remesh::Boundary::Free}).sites;
    EXPECT_GT(num_cells_at_boundary(surface, free), 30u);
}

TEST(RelaxSites, FromOneSpotItGetsAsFarAsFromBlueNoise) {
    std::map<std::string, agvd::TriangleMesh> meshes{
        {"sphere", shapes::sphere(5)},
        {"organic", remesh::read_mesh(files::find_mesh("data/organic.ply")).mesh}};
    const auto bunny = files::find_mesh("bunny.off");
    if (std::filesystem::exists(bunny)) {
        meshes["bunny"] = remesh::read_mesh(bunny).mesh;
    } else {
        std::printf("%s is not there: the others have to do\n", bunny.c_str());
    }
    for (const auto& [name, mesh] : meshes) {
        const Surface surface = agvd::build_surface(mesh.view());
        const PreparedSurface prepared(surface, unrefined);
        const Index count = 1000;
        const std::vector<SurfacePoint> spot(count, SurfacePoint{agvd::FaceId(7), {0.2, 0.3, 0.5}});
        const auto from_spot = relax_sites(prepared, spot, {.steps = 100});
        const auto from_noise = sample_relaxed(surface, {.num_samples = count}, {.steps = 100});
        EXPECT_LT(energy(surface, from_spot.sites), 1.02 * energy(surface, from_noise.sites))
            << name;
    }
}

TEST(RelaxSites, FromOneSpotOfASheetItGetsAsFarAsFromBlueNoise) {
    const Surface surface = agvd::build_surface(shapes::grid(60).view());
    const PreparedSurface prepared(surface, unrefined);
    const std::vector<SurfacePoint> spot(300, SurfacePoint{agvd::FaceId(7), {0.2, 0.3, 0.5}});
    const auto from_spot = relax_sites(prepared, spot, {.steps = 100});
    const auto from_noise = sample_relaxed(surface, {.num_samples = 300}, {.steps = 100});
    const double told = from_noise.levels.back().energy.back();
    EXPECT_NEAR(told, energy(surface, from_noise.sites), 0.5 * told);
    for (const double e : from_spot.levels.back().energy) {
        EXPECT_GT(e, 0.5 * told);
        EXPECT_LT(e, 2.5 * told);
    }
    // Sites that the boundary has from the start are better by 3 %.
    EXPECT_LT(energy(surface, from_spot.sites), 1.05 * energy(surface, from_noise.sites));
}

// Where sites start does not matter, be it ever so uneven.
TEST(RelaxSites, TheEnergyDoesNotDependOnTheStart) {
    const Index count = 500;
    for (const agvd::TriangleMesh& mesh :
         {shapes::jitter(shapes::sphere(5), 0.01, 3), shapes::torus(120, 60)}) {
        const Surface surface = agvd::build_surface(mesh.view());
        const PreparedSurface prepared(surface, unrefined);
        const SurfacePoint spot{agvd::FaceId(7), {0.2, 0.3, 0.5}};
        const auto half = sample_sites(surface, {.num_samples = count / 2});
        const auto in_disc = [&](double share) {
            const agvd::Propagation from_spot = agvd::propagate(surface, {{spot}}, {});
            std::vector<std::pair<double, Index>> faces;
            for (Index f = 0; f < surface.num_faces(); ++f) {
                faces.emplace_back(from_spot.vertex_distance[surface.mesh.triangles[f][0]], f);
            }
            std::sort(faces.begin(), faces.end());
            const auto num_faces = static_cast<Index>(share * surface.num_faces());
            std::vector<SurfacePoint> sites;
            for (Index i = 0; i < count; ++i) {
                const double u = 0.01 + 0.98 * agvd::random_unit(3, 0, 3 * i);
                const double v = agvd::random_unit(3, 0, 3 * i + 1) * (1 - u);
                const Index f = faces[agvd::random_bits(3, 1, i) % num_faces].second;
                sites.push_back({agvd::FaceId(f), {u, v, 1 - u - v}});
            }
            return sites;
        };
        std::map<std::string, std::vector<SurfacePoint>> starts;
        starts["random"] = sample_sites(surface, {.num_samples = count, .init = Init::Random});
        starts["farthest"] = sample_sites(surface, {.num_samples = count, .init = Init::Farthest});
        starts["one spot"].assign(count, spot);
        starts["one face"] = in_disc(1.5 / surface.num_faces());
        starts["disc of 5 %"] = in_disc(0.05);
        starts["disc of 20 %"] = in_disc(0.2);
        starts["half of the surface"] = in_disc(0.5);
        starts["half on one spot"] = half;
        starts["half on one spot"].resize(count, spot);
        starts["every one twice"] = half;
        starts["every one twice"].insert(starts["every one twice"].end(), half.begin(), half.end());
        for (const int steps : {remesh::RelaxOptions{}.steps, 100}) {
            const double best = energy(
                surface, sample_relaxed(surface, {.num_samples = count}, {.steps = steps}).sites);
            for (const auto& [name, start] : starts) {
                const auto end = relax_sites(prepared, start, {.steps = steps}).sites;
                EXPECT_LT(energy(surface, end), 1.025 * best) << name << ", " << steps;
            }
        }
    }
}

TEST(EvenOut, StartsAsEvenAsRandomOnesStayAsTheyAre) {
    for (const agvd::TriangleMesh& mesh : all_shapes()) {
        const Surface surface = agvd::build_surface(mesh.view());
        const PreparedSurface prepared(surface, unrefined);
        for (const Index count : {20u, 150u, 600u}) {
            for (const Init init : {Init::Random, Init::BlueNoise, Init::Farthest}) {
                const auto start = sample_sites(surface, {.num_samples = count, .init = init});
                auto sites = start;
                even_out(prepared, sites, {}, 0);
                EXPECT_EQ(sites, start) << count;
            }
            const auto relaxed = sample_relaxed(surface, {.num_samples = count}).sites;
            auto sites = relaxed;
            even_out(prepared, sites, {}, 0);
            EXPECT_EQ(sites, relaxed) << count;
        }
    }
}

TEST(EvenOut, EveryPartGetsItsShareAndFixedSitesStay) {
    const agvd::TriangleMesh mesh = shapes::join(shapes::sphere(4), shapes::torus(40, 20));
    const Surface surface = agvd::build_surface(mesh.view());
    const Index num_sphere_faces = static_cast<Index>(shapes::sphere(4).triangles.size());
    const SurfacePoint spot{agvd::FaceId(7), {0.2, 0.3, 0.5}};
    std::vector<SurfacePoint> sites(400, spot);
    std::vector<std::uint8_t> is_fixed(400, 0);
    is_fixed[0] = is_fixed[300] = 1;
    even_out(PreparedSurface(surface, unrefined), sites, is_fixed, 0);
    EXPECT_EQ(std::count(sites.begin(), sites.end(), spot), 2);
    expect_on_surface(surface, sites);
    EXPECT_EQ(sites[0], spot);
    EXPECT_EQ(sites[300], spot);
    const auto even = sample_sites(surface, {.num_samples = 400});
    const auto on_sphere = [&](const std::vector<SurfacePoint>& all) {
        return std::count_if(all.begin(), all.end(), [&](const SurfacePoint& s) {
            return s.face.value() < num_sphere_faces;
        });
    };
    EXPECT_NEAR(static_cast<double>(on_sphere(sites)), static_cast<double>(on_sphere(even)), 3);
}

TEST(RelaxSites, TheSameBytesForAnyNumberOfThreads) {
    for (const agvd::TriangleMesh& mesh : all_shapes()) {
        const Surface surface = agvd::build_surface(mesh.view());
        const PreparedSurface prepared(surface, unrefined);
        const auto run = [&](int threads) {
            return sample_relaxed(surface, {.num_samples = 700, .num_threads = threads},
                                  {.num_threads = threads})
                .sites;
        };
        const auto one = run(1);
        EXPECT_EQ(one, run(2));
        EXPECT_EQ(one, run(8));
    }
}

TEST(RelaxSites, CoarseToFineGivesTheExactCount) {
    for (const agvd::TriangleMesh& mesh : all_shapes()) {
        const Surface surface = agvd::build_surface(mesh.view());
        const PreparedSurface prepared(surface, unrefined);
        bool is_coarse = false;
        for (const Index count : {40u, 200u, 333u, 500u, 1000u}) {
            const RelaxResult result =
                sample_relaxed(surface, {.num_samples = count}, {.steps = 8});
            EXPECT_EQ(result.sites.size(), count);
            expect_on_surface(surface, result.sites);
            is_coarse = is_coarse || result.levels.size() == 2;
        }
        EXPECT_TRUE(is_coarse);
    }
}

TEST(RelaxSites, ManySitesOnFewFaces) {
    for (const agvd::TriangleMesh& mesh : {shapes::cube(), shapes::grid(2), shapes::sphere(1)}) {
        const Surface surface = agvd::build_surface(mesh.view());
        const PreparedSurface prepared(surface, unrefined);
        const auto start = sample_sites(surface, {.num_samples = 300, .init = Init::Random});
        const auto result = relax_sites(prepared, start, {.steps = 20});
        expect_on_surface(surface, result.sites);
        EXPECT_LT(result.levels[0].energy.back(), 0.8 * result.levels[0].energy.front());
    }
}

TEST(RelaxSites, ZeroStepsAndNoSitesChangeNothing) {
    const Surface surface = agvd::build_surface(shapes::sphere(2).view());
    const PreparedSurface prepared(surface, unrefined);
    const auto start = sample_sites(surface, {.num_samples = 30});
    EXPECT_EQ(relax_sites(prepared, start, {.steps = 0}).sites, start);
    EXPECT_TRUE(relax_sites(prepared, {}).sites.empty());
}

TEST(RelaxSites, WrongOptionsAndSitesAreRefused) {
    const Surface surface = agvd::build_surface(shapes::sphere(2).view());
    const PreparedSurface prepared(surface, unrefined);
    const auto start = sample_sites(surface, {.num_samples = 30});
    EXPECT_THROW((void)relax_sites(prepared, start, {.steps = -1}), agvd::InvalidOption);
    EXPECT_THROW((void)relax_sites(prepared, start, {.tolerance = -1}), agvd::InvalidOption);
    EXPECT_THROW((void)relax_sites(prepared, start, {.is_fixed = {1}}), agvd::InvalidOption);
    EXPECT_THROW((void)relax_sites(prepared, start, {.num_threads = -1}), agvd::InvalidOption);
    EXPECT_THROW((void)relax_sites(prepared, {{agvd::FaceId(99999), {1, 0, 0}}}),
                 agvd::InvalidInput);
    EXPECT_THROW((void)relax_sites(prepared, start, {.progress = [](double) { return false; }}),
                 agvd::Cancelled);
}

// Steps tell a larger fraction; what lies between them, such as labels, asks again at the same one.
TEST(RelaxSites, ProgressIsAskedBetweenStepsToo) {
    const Surface surface = agvd::build_surface(shapes::torus(200, 100).view());
    const PreparedSurface prepared(surface, unrefined);
    const auto start = sample_sites(surface, {.num_samples = 50});
    std::vector<double> told;
    (void)relax_sites(prepared, start, {.steps = 12, .progress = [&](double fraction) {
                                            told.push_back(fraction);
                                            return true;
                                        }});
    ASSERT_FALSE(told.empty());
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_GT(told.back(), 0.9);
    EXPECT_LE(told.back(), 1);
    EXPECT_GT(std::count(told.begin(), told.end(), told[told.size() / 2]), 1);
}

TEST(Relaxation, SitesAreDrawnToThePlanesOfTheirCells) {
    agvd::TriangleMesh cube = shapes::cube();
    for (int i = 0; i < 5; ++i) cube = shapes::subdivide(cube);
    const Surface surface = agvd::build_surface(cube.view());
    const PreparedSurface prepared(surface, unrefined);
    const std::vector<SurfacePoint> sites = sample_sites(surface, {.num_samples = 300});
    const agvd::DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const remesh::detail::CellMeasures cells =
        remesh::detail::measure_cells(prepared, labels, static_cast<Index>(sites.size()), 1);
    const auto distance_after_steps = [&](const remesh::detail::CellMeasures& known) {
        const agvd::Progress none;
        remesh::detail::Relaxation relaxation(
            surface,
            {sites, remesh::detail::triangulate_sites(surface, labels, nullptr, sites, {},
                                                      remesh::detail::Narrow::Leave)
                        .triangles},
            {}, 1, none);
        relaxation.set_density(&known, {});
        for (int step = 0; step < 5; ++step) relaxation.step();
        double sum = 0;
        for (std::size_t i = 0; i < sites.size(); ++i) {
            sum += cells.planes[i].at(agvd::position(surface.mesh.view(), relaxation.sites()[i]));
        }
        return sum;
    };
    remesh::detail::CellMeasures without_planes = cells;
    for (auto& planes : without_planes.planes) planes = {};
    EXPECT_LT(distance_after_steps(cells), 0.9 * distance_after_steps(without_planes));
}

TEST(Relaxation, CellsTellHowBentTheyAre) {
    const auto bending_of = [](const agvd::TriangleMesh& mesh, std::initializer_list<Vec3> places) {
        const Surface surface = agvd::build_surface(mesh.view());
        const PreparedSurface prepared(surface, unrefined);
        std::vector<SurfacePoint> sites;
        for (const Vec3& place : places) {
            const auto nearest = std::min_element(
                mesh.positions.begin(), mesh.positions.end(), [&](const Vec3& a, const Vec3& b) {
                    return (a - place).norm() < (b - place).norm();
                });
            sites.push_back(
                agvd::point_at(surface, static_cast<Index>(nearest - mesh.positions.begin())));
        }
        const agvd::DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
        return remesh::detail::measure_cells(prepared, labels, static_cast<Index>(sites.size()), 1)
            .bending;
    };
    const agvd::TriangleMesh sphere = shapes::sphere(4);
    EXPECT_NEAR(bending_of(sphere, {{0, 0, 1}})[0], 1, 1e-9);
    for (const double bending : bending_of(sphere, {{0, 0, 1}, {0, 0, -1}})) {
        EXPECT_NEAR(bending, 0.5, 0.01);
    }
    for (const double bending : bending_of(shapes::grid(20), {{0, 0, 0}, {1, 1, 0}})) {
        EXPECT_NEAR(bending, 0, 1e-9);
    }
}

TEST(Relaxation, CellsMeasureTheSameForAnyNumberOfThreads) {
    const Surface surface =
        agvd::build_surface(shapes::jitter(shapes::torus(60, 30), 0.01, 3).view());
    const PreparedSurface prepared(surface, unrefined);
    const std::vector<SurfacePoint> sites = sample_sites(surface, {.num_samples = 101});
    const agvd::DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const auto alone = remesh::detail::measure_cells(prepared, labels, 101, 1);
    EXPECT_NEAR(std::accumulate(alone.area.begin(), alone.area.end(), 0.0),
                remesh::analyze_topology(surface.mesh.view()).components[0].area, 1e-12);
    for (const int threads : {2, 8}) {
        const auto shared = remesh::detail::measure_cells(prepared, labels, 101, threads);
        EXPECT_EQ(shared.area, alone.area);
        EXPECT_EQ(shared.bending, alone.bending);
        for (std::size_t i = 0; i < sites.size(); ++i) {
            EXPECT_EQ(shared.planes[i].spread, alone.planes[i].spread);
            EXPECT_EQ(shared.planes[i].lift, alone.planes[i].lift);
            EXPECT_EQ(shared.planes[i].constant, alone.planes[i].constant);
        }
    }
}
