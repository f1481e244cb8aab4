#include "remesh/sites/sites.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "remesh/sites/sampling.h"
#include "remesh/sites/shares.h"
#include "remesh/sites/size_field.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;
using remesh::Init;
using remesh::sample_sites;

namespace {

constexpr std::array all_inits{Init::Random, Init::BlueNoise, Init::Farthest};

Surface surface_of(const agvd::TriangleMesh& mesh) { return agvd::build_surface(mesh.view()); }

std::vector<Vec3> positions(const Surface& surface, const std::vector<SurfacePoint>& sites) {
    std::vector<Vec3> result;
    for (const SurfacePoint& s : sites) result.push_back(agvd::position(surface.mesh.view(), s));
    return result;
}

double least_distance(const std::vector<Vec3>& points) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            least = std::min(least, (points[i] - points[j]).norm());
        }
    }
    return least;
}

// Spacing of `count` points packed as densely as can be.
double best_spacing(double area, Index count) {
    return 2 * std::sqrt(area / (2 * std::numbers::sqrt3 * count));
}

// The farthest that any vertex lies from the sites, along the surface.
double covering_radius(const Surface& surface, const std::vector<SurfacePoint>& sites) {
    const std::vector<double> distance =
        agvd::propagate(surface, sites, {.max_error = 0.0}).vertex_distance;
    return *std::max_element(distance.begin(), distance.end());
}

Index count_below(const std::vector<SurfacePoint>& sites, Index face) {
    return static_cast<Index>(std::count_if(
        sites.begin(), sites.end(), [face](const auto& s) { return s.face.value() < face; }));
}

}  // namespace

TEST(SampleSites, GivesTheExactCountOfDifferentPointsInsideFaces) {
    const Surface surface = surface_of(shapes::sphere(1));  // 80 faces.
    for (const Init init : all_inits) {
        for (const Index n : {4u, 5u, 63u, 80u, 3000u}) {
            const auto sites = sample_sites(surface, {.num_samples = n, .init = init});
            ASSERT_EQ(sites.size(), n);
            std::set<std::array<double, 3>> seen;
            for (const SurfacePoint& s : sites) {
                ASSERT_LT(s.face.value(), 80u);
                const auto& [x, y, z] = s.barycentric;
                EXPECT_GT(std::min({x, y, z}), 1e-7);
                EXPECT_NEAR(x + y + z, 1, 1e-15);
                const Vec3 p = agvd::position(surface.mesh.view(), s);
                EXPECT_TRUE(seen.insert({p.x(), p.y(), p.z()}).second);
            }
        }
    }
}

TEST(SampleSites, NeverPutsTwoSitesAtOnePositionEvenWhereThereAreFew) {
    // So far from the origin that the triangle holds a few dozen positions only.
    agvd::TriangleMesh mesh = shapes::grid(1);
    const double far = 0x1p50;
    for (Vec3& p : mesh.positions) p = p + Vec3(far, far, 0);
    const Surface surface = surface_of(mesh);
    for (const Init init : all_inits) {
        EXPECT_THROW((void)sample_sites(surface, {.num_samples = 2000, .init = init}),
                     agvd::ConstraintUnmet);
        const auto sites = sample_sites(surface, {.num_samples = 8, .init = init});
        EXPECT_EQ(sites.size(), 8u);
        EXPECT_GT(least_distance(positions(surface, sites)), 0);
    }
}

TEST(SampleSites, MinimumFollowsTheTopology) {
    EXPECT_EQ(remesh::minimum_samples(0, 0), 4u);
    EXPECT_EQ(remesh::minimum_samples(1, 0), 7u);
    EXPECT_EQ(remesh::minimum_samples(2, 0), 10u);
    EXPECT_EQ(remesh::minimum_samples(3, 0), 10u);
    EXPECT_EQ(remesh::minimum_samples(6, 0), 12u);
    EXPECT_EQ(remesh::minimum_samples(0, 1), 3u);
    EXPECT_EQ(remesh::minimum_samples(0, 2), 6u);
    EXPECT_EQ(remesh::minimum_samples(0, 11), 33u);
    EXPECT_EQ(remesh::minimum_samples(1, 1), 6u);
    remesh::Topology sphere_and_tube;
    sphere_and_tube.components.resize(2);
    sphere_and_tube.components[1].boundary_loops = 2;
    EXPECT_EQ(remesh::minimum_samples(sphere_and_tube), 10u);
}

TEST(SampleSites, EveryComponentGetsWhatMakesItRecognisableAndTheRestGoesByArea) {
    agvd::TriangleMesh small = shapes::torus(8, 6);
    for (Vec3& p : small.positions) p *= 1e-4;
    const agvd::TriangleMesh grid = shapes::grid(3);  // 18 faces, area 1.
    agvd::TriangleMesh large = grid;
    for (Vec3& p : large.positions) p = 2 * p + Vec3(5, 0, 0);  // Area 4.
    const Surface surface = surface_of(shapes::join(shapes::join(small, grid), large));
    for (const Init init : all_inits) {
        const auto sites = sample_sites(
            surface, {.num_samples = 13 + 101, .init = init, .boundary = remesh::Boundary::Free});
        ASSERT_EQ(sites.size(), 114u);
        // The torus needs 7, and gets 21 more from the others: of the 20 and 81 by area.
        EXPECT_EQ(count_below(sites, 96), 28u);
        EXPECT_EQ(count_below(sites, 96 + 18), 28u + 3u + 20u - 3u);
        EXPECT_EQ(sample_sites(surface, {.num_samples = 13, .init = init}).size(), 13u);
    }
}

TEST(SampleSites, FewerThanTheTopologyNeedsGoWhereTheAreaIs) {
    agvd::TriangleMesh large = shapes::grid(3);
    for (Vec3& p : large.positions) p = 2 * p + Vec3(5, 0, 0);  // Area 4; the other: 1.
    const Surface surface = surface_of(shapes::join(shapes::grid(3), large));
    for (const Init init : all_inits) {
        for (const Index n : {1u, 2u, 5u}) {
            const auto sites = sample_sites(
                surface, {.num_samples = n, .init = init, .boundary = remesh::Boundary::Free});
            EXPECT_EQ(sites.size(), n);
            EXPECT_EQ(count_below(sites, 18), n == 5 ? 1u : 0u);
        }
    }
}

TEST(SampleSites, WrongOptionsAndASurfaceWithoutFacesAreRefused) {
    const Surface surface = surface_of(shapes::sphere(0));
    EXPECT_THROW((void)sample_sites(surface, {.num_samples = 0}), agvd::InvalidOption);
    EXPECT_THROW((void)sample_sites(surface, {.num_threads = -1}), agvd::InvalidOption);
    EXPECT_THROW((void)sample_sites(Surface{}), agvd::InvalidInput);
}

TEST(SampleSites, SpreadsByAreaOverFacesAndWithinThem) {
    agvd::TriangleMesh mesh = shapes::grid(2);
    for (Vec3& p : mesh.positions) p = Vec3(p.x() * p.x(), p.y(), 0);  // Faces of unequal area.
    const Surface surface = surface_of(mesh);
    for (const Init init : all_inits) {
        const Index n = 10000;
        std::array<double, 64> hits{};
        const auto sites = sample_sites(
            surface, {.num_samples = n, .init = init, .boundary = remesh::Boundary::Free});
        for (const Vec3& p : positions(surface, sites)) {
            ++hits[static_cast<std::size_t>(p.x() * 8) * 8 + static_cast<std::size_t>(p.y() * 8)];
        }
        double chi_square = 0;
        for (const double h : hits) chi_square += (h - n / 64.0) * (h - n / 64.0) / (n / 64.0);
        EXPECT_LT(chi_square, 63 + 5 * std::sqrt(2 * 63.0));
        if (init != Init::Random) {
            EXPECT_LT(chi_square, 20) << "more even than chance";
        }
    }
}

class SampleSitesOfEvenKind : public testing::TestWithParam<Init> {};
INSTANTIATE_TEST_SUITE_P(Inits, SampleSitesOfEvenKind,
                         testing::Values(Init::BlueNoise, Init::Farthest));

TEST_P(SampleSitesOfEvenKind, TheBoundaryGetsItsCornersAndEqualSteps) {
    const Surface surface = surface_of(shapes::grid(30));
    const Index n = 400;
    const auto sites = sample_sites(surface, {.num_samples = n, .init = GetParam()});
    ASSERT_EQ(sites.size(), n);
    std::vector<Vec3> rim;
    Index corners = 0;
    for (const SurfacePoint& s : sites) {
        if (!is_on_boundary(surface, s)) continue;
        rim.push_back(agvd::position(surface.mesh.view(), s));
        if (agvd::vertex_of(surface, s)) {
            const Vec3& p = rim.back();
            corners += (p.x() == 0 || p.x() == 1) && (p.y() == 0 || p.y() == 1) ? 1 : 0;
        }
    }
    EXPECT_EQ(corners, 4u);
    // Of equilateral triangles: 400 vertices on a unit square are 0.055 apart.
    EXPECT_NEAR(static_cast<double>(rim.size()), 4 / 0.055, 4);
    EXPECT_GT(least_distance(rim), 0.9 * 4 / static_cast<double>(rim.size()));
    EXPECT_GT(least_distance(positions(surface, sites)), 0.5 * 0.055);
}

// A strip narrower than the sites' distance has nearly all on its rim; a round hole gets three.
TEST(SampleSites, NarrowStripsAndRoundHoles) {
    agvd::TriangleMesh strip = shapes::grid(20);
    for (Vec3& p : strip.positions) p.y() *= 1e-3;
    const Surface narrow = surface_of(strip);
    const auto sites = sample_sites(narrow, {.num_samples = 40});
    EXPECT_GE(std::count_if(sites.begin(), sites.end(),
                            [&](const SurfacePoint& s) { return is_on_boundary(narrow, s); }),
              36);
    const Surface tube = surface_of(shapes::tube(64, 20));
    const auto few = sample_sites(tube, {.num_samples = 6});
    EXPECT_TRUE(std::ranges::all_of(few, [&](const auto& s) { return is_on_boundary(tube, s); }));
}

TEST(SampleSites, BlueNoiseKeepsItsDistance) {
    const Surface surface = surface_of(shapes::sphere(3));
    const Index n = 500;
    const double spacing = best_spacing(4 * std::numbers::pi, n);
    EXPECT_LT(least_distance(positions(
                  surface, sample_sites(surface, {.num_samples = n, .init = Init::Random}))),
              0.2 * spacing);
    EXPECT_GT(least_distance(positions(surface, sample_sites(surface, {.num_samples = n}))),
              0.6 * spacing);
}

TEST_P(SampleSitesOfEvenKind, KeepsItsDistanceAcrossRightAngles) {
    const Surface surface = surface_of(shapes::subdivide(shapes::cube()));
    const auto points =
        positions(surface, sample_sites(surface, {.num_samples = 600, .init = GetParam()}));
    EXPECT_GT(least_distance(points), 0.5 * best_spacing(6, 600));
}

TEST_P(SampleSitesOfEvenKind, BothWallsOfAThinPlateGetTheirShareOnTheirOwn) {
    agvd::TriangleMesh mesh = shapes::subdivide(shapes::subdivide(shapes::cube()));
    for (Vec3& p : mesh.positions) p.z() *= 1e-3;
    const Surface surface = surface_of(mesh);
    const auto points =
        positions(surface, sample_sites(surface, {.num_samples = 1000, .init = GetParam()}));
    std::vector<Vec3> top, bottom;
    for (const Vec3& p : points) {
        if (p.z() > 0.9e-3) top.push_back(p);
        if (p.z() < 0.1e-3) bottom.push_back(p);
    }
    EXPECT_NEAR(static_cast<double>(top.size()), 500, 30);
    EXPECT_NEAR(static_cast<double>(bottom.size()), 500, 30);
    const double spacing = best_spacing(2, 1000);
    EXPECT_GT(least_distance(top), 0.5 * spacing);
    EXPECT_LT(least_distance(points), 0.2 * spacing) << "the walls do not see each other";
}

TEST(SampleSites, FarthestPointsLeaveTheSmallestGaps) {
    agvd::TriangleMesh uneven = shapes::torus(40, 20);
    for (Vec3& p : uneven.positions) p = Vec3(std::exp(p.x()), p.y(), p.z());
    for (const agvd::TriangleMesh& mesh :
         {shapes::sphere(3), shapes::torus(40, 20), shapes::cube(), uneven}) {
        for (const Index n : {30u, 500u}) {
            const Surface surface = surface_of(mesh);
            double area = 0;
            for (Index f = 0; f < surface.num_faces(); ++f) {
                area += agvd::face_area(surface, f);
            }
            const double fine = 0.3 * std::sqrt(area / n);
            agvd::TriangleMesh split = mesh;
            while (shapes::longest_edge(surface_of(split)) > fine) split = shapes::subdivide(split);
            const Surface judged = surface_of(split);
            const auto radius = [&](Init init) {
                return covering_radius(judged,
                                       sample_sites(judged, {.num_samples = n, .init = init}));
            };
            const double farthest = radius(Init::Farthest);
            EXPECT_LT(farthest, 0.7 * radius(Init::Random));
            EXPECT_LT(farthest, 1.02 * radius(Init::BlueNoise));
            // Discs of this radius around the sites cover the area: no fewer could.
            EXPECT_LT(farthest, 1.5 * best_spacing(area, n) / std::numbers::sqrt3);
        }
    }
}

TEST(SampleSites, TheFirstFarthestPointsAreThoseOfASmallerCount) {
    const Surface surface = surface_of(shapes::sphere(4));
    const auto many = sample_sites(surface, {.num_samples = 60, .init = Init::Farthest});
    const auto few = sample_sites(surface, {.num_samples = 25, .init = Init::Farthest});
    EXPECT_EQ(few, std::vector(many.begin(), many.begin() + 25));
}

TEST(SampleSites, FarthestPointsKeepAwayFromThoseThatAreFixed) {
    const Surface surface = surface_of(shapes::sphere(3));
    const agvd::Component whole = agvd::find_components(surface)[0];
    std::vector<SurfacePoint> fixed;  // Northern hemisphere.
    for (const SurfacePoint& p : sample_sites(surface, {.num_samples = 400})) {
        if (agvd::position(surface.mesh.view(), p).z() > 0) fixed.push_back(p);
    }
    const auto added = remesh::detail::farthest_points(surface, whole, fixed, 100, 0.2, 0, {});
    ASSERT_EQ(added.size(), 100u);
    EXPECT_LT(agvd::position(surface.mesh.view(), added[0]).z(), -0.9);
    for (const SurfacePoint& p : added) {
        EXPECT_LT(agvd::position(surface.mesh.view(), p).z(), 0.1);
    }
}

TEST(SampleSites, SlenderPartsOfAnySizeGetTheirFarthestPoints) {
    agvd::TriangleMesh needle = shapes::subdivide(shapes::cube());
    for (Vec3& p : needle.positions) p = Vec3(p.x(), 1e-9 * p.y(), 1e-12 * p.z());
    const Surface surface = surface_of(shapes::join(shapes::sphere(2), needle));
    const auto sites = sample_sites(surface, {.num_samples = 200, .init = Init::Farthest});
    EXPECT_EQ(sites.size(), 200u);
    EXPECT_EQ(count_below(sites, 320), 184u);
    std::vector<double> along;
    for (const Vec3& p : positions(surface, {sites.end() - 16, sites.end()})) {
        along.push_back(p.x());
    }
    std::sort(along.begin(), along.end());
    EXPECT_LT(along.front(), 0.2);
    EXPECT_GT(along.back(), 0.8);
}

TEST(SampleSites, SameBytesForAnyThreadCountAndOtherOnesForAnotherSeed) {
    const Surface surface = surface_of(shapes::torus(20, 12));
    for (const Init init : all_inits) {
        const auto sites = [&](std::uint64_t seed, int threads) {
            return sample_sites(
                surface, {.num_samples = 3000, .init = init, .seed = seed, .num_threads = threads});
        };
        const auto first = sites(1, 1);
        EXPECT_EQ(first, sites(1, 1));
        EXPECT_EQ(first, sites(1, 2));
        EXPECT_EQ(first, sites(1, 8));
        EXPECT_NE(first, sites(2, 1));
    }
}

TEST(SampleSites, CanBeStopped) {
    const Surface surface = surface_of(shapes::sphere(0));
    EXPECT_THROW((void)sample_sites(surface, {.progress = [](double) { return false; }}),
                 agvd::Cancelled);
}

namespace {

// Lengths of 1 for x < 1/2 and twice that beyond, with a steep rise in between.
remesh::SizeField field_on(const Surface& surface) {
    auto base = std::make_shared<const agvd::IntrinsicTriangulation>(surface);
    std::vector<double> length;
    for (const Vec3& p : surface.mesh.positions) length.push_back(p.x() < 0.5 ? 1 : 2);
    return {std::move(base), std::move(length)};
}

}  // namespace

TEST(SampleSites, FollowTargetLengths) {
    const Surface surface = surface_of(shapes::grid(60));
    const remesh::SizeField field = field_on(surface);
    Index num_tried = 0;
    for (const Init init : all_inits) {
        for (const remesh::Boundary boundary : {remesh::Boundary::Keep, remesh::Boundary::Free}) {
            const auto sites = sample_sites(
                surface,
                {.num_samples = 1000, .init = init, .boundary = boundary, .sizes = &field});
            EXPECT_EQ(sites.size(), 1000u);
            std::vector<Vec3> fine, coarse, fine_rim, coarse_rim;
            for (const SurfacePoint& site : sites) {
                const Vec3 p = agvd::position(surface.mesh.view(), site);
                (p.x() < 0.5 ? fine : coarse).push_back(p);
                if (agvd::is_on_boundary(surface, site)) {
                    (p.x() < 0.5 ? fine_rim : coarse_rim).push_back(p);
                }
            }
            // Four times as many.
            EXPECT_NEAR(static_cast<double>(fine.size()) / 1000, 0.8, 0.035) << init_name(init);
            if (init != Init::Random) {
                EXPECT_NEAR(least_distance(coarse) / least_distance(fine), 2, 0.6);
            }
            if (init != Init::Random && boundary == remesh::Boundary::Keep) {
                EXPECT_NEAR(static_cast<double>(fine_rim.size()),
                            2 * static_cast<double>(coarse_rim.size()), 8);
                EXPECT_GT(coarse_rim.size(), 20u);
            }
            ++num_tried;
        }
    }
    EXPECT_EQ(num_tried, 6u);
}

TEST(SampleSites, SmallComponentsGetWhatMakesThemRecognisable) {
    // A large sphere, a tiny one and a tiny torus: a thousandth of the area.
    agvd::TriangleMesh tiny = shapes::sphere(3), ring = shapes::torus(40, 20);
    for (Vec3& p : tiny.positions) p = 0.02 * p + Vec3(2, 0, 0);
    for (Vec3& p : ring.positions) p = 0.02 * p + Vec3(3, 0, 0);
    const Surface surface = surface_of(shapes::join(shapes::join(shapes::sphere(4), tiny), ring));
    const auto counts = [&](Index count, Init init) {
        std::array<Index, 3> result{};
        for (const SurfacePoint& site :
             sample_sites(surface, {.num_samples = count, .init = init})) {
            const double x = agvd::position(surface.mesh.view(), site).x();
            ++result[x < 1.5 ? 0 : x < 2.5 ? 1 : 2];
        }
        return result;
    };
    for (const Init init : all_inits) {
        const auto ample = counts(2000, init);
        EXPECT_EQ(ample[1], 16u);
        EXPECT_EQ(ample[2], 28u);
        EXPECT_EQ(ample[0], 1956u);
        // At most a quarter for small parts beyond what they need, and no less than that.
        const auto few = counts(60, init);
        EXPECT_EQ(few[0] + few[1] + few[2], 60u);
        EXPECT_GE(few[1], 8u);
        EXPECT_LE(few[1], 11u);
        EXPECT_GE(few[2], 14u);
        EXPECT_LE(few[2], 18u);
        const auto least = counts(15, init);
        EXPECT_GE(least[0], 4u);
        EXPECT_GE(least[1], 4u);
        EXPECT_GE(least[2], 7u);
    }
}
