#include "paper/site_distances.h"

#include <gtest/gtest.h>

#include <cmath>

#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "support/line_sites.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

std::vector<SiteDistanceQuery> all_pairs(std::span<const SurfacePoint> sites,
                                         std::span<const SurfacePoint> targets, double guess) {
    std::vector<SiteDistanceQuery> queries;
    for (Index s = 0; s < sites.size(); ++s) {
        for (const SurfacePoint& target : targets) queries.push_back({SiteId(s), target, guess});
    }
    return queries;
}

TEST(SiteDistances, AreEuclideanInThePlane) {
    const Surface surface = build_surface(shapes::grid(7).view());
    const auto sites = points::scattered(surface, 6, 1);
    const auto targets = points::scattered(surface, 60, 2);
    const auto queries = all_pairs(sites, targets, 0.3);
    const auto found = site_distances(surface, sites, {}, queries);
    for (std::size_t q = 0; q < queries.size(); ++q) {
        const Vec3 from = position(surface.mesh.view(), sites[queries[q].site.value()]);
        const Vec3 to = position(surface.mesh.view(), queries[q].point);
        EXPECT_NEAR(found[q], (to - from).norm(), 1e-12) << q;
    }
}

TEST(SiteDistances, FromLinesAndRegionsAreThoseToSegmentsInThePlane) {
    const Surface surface = line_sites::uneven_square(9, 4);
    const auto sites = points::scattered(surface, 1, 1);
    const auto targets = points::scattered(surface, 60, 2);
    const std::vector<SiteShape> shapes{line_sites::random_line(surface, 7, 1),
                                        line_sites::random_region(surface, 4, 2)};
    for (const double guess : {0.0, 0.3, infinity}) {
        std::vector<SiteDistanceQuery> queries;
        for (const SurfacePoint& target : targets) {
            for (const Index s : {2u, 0u, 1u}) queries.push_back({SiteId(s), target, guess});
        }
        const auto found = site_distances(surface, sites, shapes, queries);
        for (std::size_t q = 0; q < queries.size(); q += 3) {
            const Vec3 p = position(surface.mesh.view(), queries[q].point);
            EXPECT_NEAR(found[q], line_sites::in_plane(surface, shapes[1], p), 1e-13);
            EXPECT_NEAR(found[q + 1], (position(surface.mesh.view(), sites[0]) - p).norm(), 1e-12);
            EXPECT_NEAR(found[q + 2], line_sites::in_plane(surface, shapes[0], p), 1e-13);
        }
    }
}

TEST(SiteDistances, AreThoseOfThePropagationAtVertices) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(24, 12), 0.02, 5).view());
    const auto sites = points::scattered(surface, 5, 3);
    std::vector<SurfacePoint> vertices;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        vertices.push_back(point_at(surface, v));
    }
    const auto found = site_distances(surface, sites, {}, all_pairs(sites, vertices, 0.5));
    for (Index s = 0; s < sites.size(); ++s) {
        const auto exact = propagate(surface, {&sites[s], 1}, {.max_error = 0}).vertex_distance;
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            EXPECT_NEAR(found[s * surface.num_vertices() + v], exact[v], 1e-9) << s << ' ' << v;
        }
    }
}

TEST(SiteDistances, AreTheSameBothWaysAndForAnyGuessAndThreads) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(24, 12), 0.02, 5).view());
    const auto a = points::scattered(surface, 9, 3);
    const auto b = points::scattered(surface, 12, 4);
    const auto there = site_distances(surface, a, {}, all_pairs(a, b, 1));
    const auto back = site_distances(surface, b, {}, all_pairs(b, a, 1));
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) {
            EXPECT_NEAR(there[i * b.size() + j], back[j * a.size() + i], 1e-9);
        }
    }
    for (const double guess : {0.0, 0.1, 100.0, infinity}) {
        const auto other = site_distances(surface, a, {}, all_pairs(a, b, guess));
        for (std::size_t q = 0; q < there.size(); ++q) EXPECT_NEAR(other[q], there[q], 1e-9);
    }
    EXPECT_EQ(site_distances(surface, a, {}, all_pairs(a, b, 1), 1), there);
    EXPECT_EQ(site_distances(surface, a, {}, all_pairs(a, b, 1), 8), there);
}

// Folds run along y up to y = 1. The faces near both points hold a path across all folds; a shorter
// one goes around their ends.
TEST(SiteDistances, AShorterPathOutsideOfWhatIsNearIsFound) {
    TriangleMesh mesh = shapes::grid(40);
    for (Vec3& p : mesh.positions) {
        const auto column = static_cast<int>(std::lround(40 * p.x()));
        p.x() -= 0.5;
        p.y() *= 2;
        p.z() = column % 2 == 1 && p.y() < 0.99 ? 0.2 : 0;
    }
    const Surface surface = build_surface(mesh.view());
    const SurfacePoint site = point_at(surface, 10 * 41), target = point_at(surface, 30 * 41);
    const double exact = propagate(surface, {&site, 1}, {.max_error = 0}).vertex_distance[30 * 41];
    for (const double guess : {0.0, 0.6, 10.0}) {
        const auto found =
            site_distances(surface, {&site, 1}, {}, all_pairs({&site, 1}, {&target, 1}, guess));
        EXPECT_NEAR(found[0], exact, 1e-9) << guess;
    }
}

TEST(SiteDistances, OtherComponentsAreNotReached) {
    const Surface surface =
        build_surface(shapes::join(shapes::sphere(1), shapes::sphere(1)).view());
    const auto site = point_at(surface, 0);
    const auto other = point_at(surface, surface.num_vertices() - 1);
    const std::vector<SiteDistanceQuery> queries{{SiteId(0), other, 1}, {SiteId(0), site, 1}};
    EXPECT_EQ(site_distances(surface, {&site, 1}, {}, queries), (std::vector<double>{infinity, 0}));
}

TEST(SiteDistances, PointsThatCrowdAFaceAreToldApart) {
    const Surface surface = build_surface(shapes::grid(1).view());
    const SurfacePoint site{FaceId(0), {0.3, 0.3, 0.4}};
    std::vector<SurfacePoint> targets;
    for (const double b : {0.2, 0.2 + 1e-9, 0.2 + 1e-5, 1e-9, 0.999}) {
        for (const Index face : {0u, 1u}) {
            targets.push_back({FaceId(face), {1 - b, 0, b}});
            targets.push_back({FaceId(face), {(1 - b) / 2, (1 - b) / 2, b}});
            targets.push_back({FaceId(face), {1 - b - 1e-7, 1e-7, b}});
        }
    }
    const auto found = site_distances(surface, {&site, 1}, {}, all_pairs({&site, 1}, targets, 1));
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const double exact =
            (position(surface.mesh.view(), targets[i]) - position(surface.mesh.view(), site))
                .norm();
        EXPECT_NEAR(found[i], exact, 5e-6) << i;
    }
}

}  // namespace
