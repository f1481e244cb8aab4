#include <gtest/gtest.h>

#include <algorithm>

#include "agvd/core/error.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/paths/distances.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Against a propagation from each site alone.
void expect_ranks(const Surface& surface, std::span<const SurfacePoint> sites, Index k) {
    std::vector<std::vector<double>> alone;
    for (const SurfacePoint& site : sites) {
        alone.push_back(propagate(surface, std::span(&site, 1), {.max_error = 0}).vertex_distance);
    }
    const KNearest found = k_nearest_sites(surface, sites, k, {.max_error = 0});
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
}
