#include <gtest/gtest.h>

#include <algorithm>

#include "agvd/core/error.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/paths/distances.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Distances from one site alone: of its points, and of each of its shapes in a run of its own.
std::vector<double> distances_from(Index site, const Surface& surface,
                                   std::span<const SurfacePoint> points,
                                   const KNearestOptions& options) {
    std::vector<double> nearest(surface.num_vertices(), infinity);
    const auto take = [&](std::span<const SurfacePoint> own, PropagationOptions propagating) {
        propagating.max_error = 0;
        const Propagation found = propagate(surface, own, propagating);
        for (Index v = 0; v < nearest.size(); ++v) {
            nearest[v] = std::min(nearest[v], found.vertex_distance[v]);
        }
    };
    const SitePoints& roles = options.points;
    for (Index i = 0; i < points.size(); ++i) {
        if (roles.site_of(i) != site) continue;
        PropagationOptions alone;
        if (!roles.start.empty()) alone.points.start = {roles.start[i]};
        take(points.subspan(i, 1), alone);
    }
    for (SiteShape shape : options.shapes) {
        if (shape.site != site) continue;
        shape.site = 0;
        take({}, {.shapes = {shape}});
    }
    return nearest;
}

// Against a propagation from each site alone.
void expect_ranks(const Surface& surface, std::span<const SurfacePoint> points, Index k,
                  KNearestOptions options = {}) {
    Index num_sites = 0;
    for (Index i = 0; i < points.size(); ++i) {
        num_sites = std::max(num_sites, options.points.site_of(i) + 1);
    }
    for (const SiteShape& shape : options.shapes) num_sites = std::max(num_sites, shape.site + 1);
    std::vector<std::vector<double>> alone;
    for (Index site = 0; site < num_sites; ++site) {
        alone.push_back(distances_from(site, surface, points, options));
    }
    options.max_error = 0;
    const KNearest found = k_nearest_sites(surface, points, k, options);
    EXPECT_EQ(found.k, k);
    EXPECT_EQ(found.certified_error, 0);
    ASSERT_EQ(found.site.size(), std::size_t{k} * surface.num_vertices());
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        std::vector<double> distances;
        for (const auto& of_site : alone) {
            if (of_site[v] < infinity) distances.push_back(of_site[v]);
        }
        std::sort(distances.begin(), distances.end());
        for (Index i = 0; i < k; ++i) {
            const SiteId site = found.site[v * k + i];
            if (i >= distances.size()) {
                EXPECT_FALSE(site.is_valid());
                EXPECT_EQ(found.distance[v * k + i], infinity);
                continue;
            }
            EXPECT_NEAR(found.distance[v * k + i], distances[i], 1e-12) << v << ' ' << i;
            ASSERT_TRUE(site.is_valid());
            EXPECT_NEAR(alone[site.value()][v], distances[i], 1e-12) << v << ' ' << i;
            for (Index j = 0; j < i; ++j) EXPECT_NE(found.site[v * k + j], site);
        }
    }
}

}  // namespace

TEST(KNearest, AreThoseOfEachSiteAlone) {
    for (const TriangleMesh& mesh : {shapes::jitter(shapes::sphere(3), 0.05, 1),
                                     shapes::jitter(shapes::torus(24, 12), 0.06, 2),
                                     shapes::jitter(shapes::grid(14), 0.04, 3), shapes::cube()}) {
        const Surface surface = build_surface(mesh.view());
        const auto sites = points::scattered(surface, 14, 4);
        for (const Index k : {1u, 2u, 4u}) expect_ranks(surface, sites, k);
    }
}

TEST(KNearest, AreFewerWhereFewerSitesReach) {
    const Surface surface = build_surface(
        shapes::join(shapes::sphere(2), shapes::moved(shapes::sphere(1), {5, 0, 0})).view());
    const std::array sites{point_at(surface, 0), point_at(surface, 9),
                           point_at(surface, surface.num_vertices() - 1)};
    expect_ranks(surface, sites, 3);
}

TEST(KNearest, CountSitesAtOnePlace) {
    const Surface surface = build_surface(shapes::grid(4).view());
    const std::array sites{point_at(surface, 3), point_at(surface, 20), point_at(surface, 3)};
    expect_ranks(surface, sites, 2);
    const KNearest found = k_nearest_sites(surface, sites, 2, {.max_error = 0});
    EXPECT_EQ(found.site[2 * 3], SiteId(0));
    EXPECT_EQ(found.site[2 * 3 + 1], SiteId(2));
}

TEST(KNearest, SitesMayBeGroupsAndHaveStarts) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(24, 12), 0.06, 2).view());
    const auto points = points::scattered(surface, 18, 4);
    KNearestOptions options;
    for (Index i = 0; i < points.size(); ++i) {
        options.points.site.push_back(i % 5);
        options.points.start.push_back(i % 4 * 0.05);
    }
    for (const Index k : {1u, 2u, 4u, 6u}) expect_ranks(surface, points, k, options);
}

// What lies behind a line is seen, other than in a diagram.
TEST(KNearest, SitesMayBeLinesAndRegions) {
    const Surface surface = build_surface(shapes::grid(12).view());
    KNearestOptions options;
    options.shapes.resize(3);
    for (Index edge = 0; edge < surface.num_edges(); ++edge) {
        const Index h = surface.edge_half[edge];
        const Vec3 &a = surface.mesh.positions[surface.tail(h)],
                   &b = surface.mesh.positions[surface.head(h)];
        if (a.x() == 0.5 && b.x() == 0.5) options.shapes[0].edges.push_back(edge);
        if (a.y() == 0.25 && b.y() == 0.25 && std::max(a.x(), b.x()) < 0.4) {
            options.shapes[1].edges.push_back(edge);
        }
    }
    options.shapes[2].faces = {0, 1, 2, 3};
    ASSERT_EQ(options.shapes[0].edges.size(), 12u);
    ASSERT_GT(options.shapes[1].edges.size(), 2u);
    const auto points = points::scattered(surface, 6, 4);
    options.shapes[0].site = 6;
    options.shapes[1].site = 7;
    options.shapes[2].site = 2;  // With a point.
    options.shapes[1].start = 0.1;
    for (const Index k : {1u, 3u, 8u}) expect_ranks(surface, points, k, options);
}

TEST(KNearest, FirstIsThatOfPropagate) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(4), 0.02, 1).view());
    const auto sites = points::scattered(surface, 60, 4);
    const Propagation one = propagate(surface, sites, {.max_error = 0});
    const KNearest found = k_nearest_sites(surface, sites, 3, {.max_error = 0});
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        EXPECT_EQ(found.site[3 * v], one.vertex_site[v]);
        EXPECT_NEAR(found.distance[3 * v], one.vertex_distance[v], 1e-13);
    }
}

TEST(KNearest, AreTheSameForAnyNumberOfThreads) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.05, 1).view());
    const auto sites = points::scattered(surface, 30, 4);
    const KNearest once = k_nearest_sites(surface, sites, 3, {.num_threads = 1});
    const KNearest again = k_nearest_sites(surface, sites, 3, {.num_threads = 3});
    EXPECT_EQ(once.site, again.site);
    EXPECT_EQ(once.distance, again.distance);
}

TEST(KNearest, RefuseNone) {
    const Surface surface = build_surface(shapes::cube().view());
    const std::array sites{point_at(surface, 0)};
    EXPECT_THROW((void)k_nearest_sites(surface, sites, 0), InvalidOption);
    EXPECT_THROW((void)k_nearest_sites(surface, sites, 1, {.max_error = 1}), InvalidOption);
    EXPECT_THROW((void)k_nearest_sites(surface, std::array{SurfacePoint{FaceId(12), {}}}, 1),
                 InvalidSites);
    KNearestOptions options;
    options.points.site = {1};
    EXPECT_THROW((void)k_nearest_sites(surface, sites, 1, options), InvalidSites);
}
