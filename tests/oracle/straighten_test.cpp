// Straightened paths and the edges of the dual against exact distances.
#include <gtest/gtest.h>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/paths/distances.h"
#include "agvd/paths/geodesic_path.h"
#include "agvd/paths/isolines.h"
#include "agvd/propagation/propagate.h"
#include "paper/oracle.h"
#include "remesh/dual/build_dual.h"
#include "support/geodesics.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

TEST(StraightenAgainstExact, IsNeverShorter) {
    for (const TriangleMesh& mesh : {shapes::jitter(shapes::sphere(3), 0.03, 1),
                                     shapes::jitter(shapes::torus(24, 12), 0.05, 2),
                                     shapes::jitter(shapes::grid(12), 0.03, 3), shapes::cube()}) {
        const Surface surface = build_surface(mesh.view());
        const auto ends = points::scattered(surface, 12, 1);
        Index num_exact = 0, num_paths = 0;
        for (const SurfacePoint& a : ends) {
            const std::vector<double> exact = exact_distances(surface, a, ends);
            for (std::size_t i = 0; i < ends.size(); ++i) {
                if (exact[i] == 0) continue;
                double shortest = std::numeric_limits<double>::infinity();
                for (std::uint64_t seed = 1; seed <= 5; ++seed) {
                    const GeodesicPath start = geodesics::random_path(surface, a, ends[i], seed);
                    const GeodesicPath path = straighten_path(surface, start.points, start.faces);
                    EXPECT_GE(path.length, exact[i] * (1 - 1e-9));
                    EXPECT_LT(geodesics::largest_bend(surface, path.points), 1e-6);
                    shortest = std::min(shortest, path.length);
                }
                ++num_paths;
                if (shortest <= exact[i] * (1 + 1e-9)) ++num_exact;
            }
        }
        EXPECT_GT(3 * num_exact, num_paths);
    }
}

TEST(StraightenAgainstExact, DualEdgesAreShortestPathsUnlessTheSurfaceBends) {
    const TriangleMesh mesh = shapes::jitter(shapes::torus(48, 24), 0.01, 2);
    const Surface surface = build_surface(mesh.view());
    const std::vector<SurfacePoint> sites = uniform_points(surface, 150, 1);
    const Diagram diagram = build_diagram(surface, sites, propagate(surface, sites));
    Index num_exact = 0, num_sides = 0;
    for (const auto& [a, b, c] : remesh::build_dual(diagram)) {
        const std::array targets{sites[b], sites[c]};
        const std::vector<double> exact = exact_distances(surface, sites[a], targets);
        for (std::size_t k = 0; k < 2; ++k) {
            const double length = path_between(surface, sites[a], targets[k]).length;
            EXPECT_GE(length, exact[k] * (1 - 1e-9));
            EXPECT_LE(length, exact[k] * 1.05);
            ++num_sides;
            if (length <= exact[k] * (1 + 1e-9)) ++num_exact;
        }
    }
    EXPECT_GT(num_exact, 0.9 * num_sides);
}

TEST(StraightenAgainstExact, PathsToSitesAreShortest) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(30, 15), 0.03, 2).view());
    const std::vector<SurfacePoint> sites = uniform_points(surface, 5, 1);
    const Propagation propagation = propagate(surface, sites, {.max_error = 0});
    Index num_exact = 0;
    for (const SurfacePoint& from : points::scattered(surface, 60, 4)) {
        const GeodesicPath path = path_to_site(surface, sites, propagation, from);
        const std::vector<double> exact = exact_distances(surface, from, sites);
        const double nearest = *std::min_element(exact.begin(), exact.end());
        EXPECT_GE(path.length, nearest * (1 - 1e-9));
        if (path.length <= nearest * (1 + 1e-9)) ++num_exact;
    }
    EXPECT_GE(num_exact, 50u);
}

TEST(ShortestPathsAgainstExact, HaveTheExactLengths) {
    for (const TriangleMesh& mesh : {shapes::jitter(shapes::sphere(3), 0.06, 5),
                                     shapes::jitter(shapes::torus(30, 15), 0.06, 6),
                                     shapes::jitter(shapes::grid(14), 0.04, 7)}) {
        const Surface surface = build_surface(mesh.view());
        const auto from = points::scattered(surface, 40, 2);
        const std::array to{SurfacePoint{FaceId(7), {0.2, 0.3, 0.5}}};
        std::vector<PointPair> pairs;
        for (const SurfacePoint& point : from) pairs.push_back({point, to[0]});
        const auto between = shortest_paths(surface, pairs);
        const Propagation propagation =
            propagate(surface, to, {.max_error = 0, .relay_faces = all_faces(surface)});
        const auto to_site = paths_to_sites(surface, to, propagation, from);
        const std::vector<double> exact = exact_distances(surface, to[0], from);
        for (std::size_t i = 0; i < from.size(); ++i) {
            EXPECT_NEAR(between[i].length, exact[i], 1e-12 * exact[i]) << i;
            EXPECT_NEAR(to_site[i].path.length, exact[i], 1e-12 * exact[i]) << i;
        }
    }
}

TEST(IsolinesAgainstExact, ArePlacesOfTheirDistance) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(30, 15), 0.06, 6).view());
    const auto sites = points::scattered(surface, 2, 3);
    const Propagation propagation =
        propagate(surface, sites, {.max_error = 0, .relay_faces = all_faces(surface)});
    const std::vector<double> levels = levels_every(propagation, 0.4);
    const Isolines isolines = build_isolines(surface, propagation, levels);
    const DrawnIsolines drawn = draw_isolines(surface, isolines, 1e-2);
    const NearestSites exact = exact_nearest_sites(surface, sites, drawn.points);
    ASSERT_GT(drawn.points.size(), 100u);
    for (std::size_t line = 0; line < isolines.lines.size(); ++line) {
        const double level = levels[isolines.lines[line].level];
        for (Index i = drawn.offsets[line]; i < drawn.offsets[line + 1]; ++i) {
            EXPECT_NEAR(exact.distance[i], level, 1e-9 * level);
        }
    }
}

TEST(DistancesAgainstExact, OfPointsAndOfTheKNearestSites) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.05, 1).view());
    const auto sites = points::scattered(surface, 12, 3);
    const auto targets = points::scattered(surface, 300, 5);
    const NearestSites exact = exact_nearest_sites(surface, sites, targets);
    const Distances found = find_distances(surface, sites, targets, {.max_error = 0});
    EXPECT_EQ(found.point_site, exact.site);
    for (std::size_t i = 0; i < targets.size(); ++i) {
        EXPECT_NEAR(found.point_distance[i], exact.distance[i], 1e-12);
    }
    std::vector<SurfacePoint> vertices;
    for (Index v = 0; v < surface.num_vertices(); ++v) vertices.push_back(point_at(surface, v));
    std::vector<std::vector<double>> alone;
    for (const SurfacePoint& site : sites)
        alone.push_back(exact_distances(surface, site, vertices));
    constexpr Index k = 4;
    const KNearest ranks = k_nearest_sites(surface, sites, k, {.max_error = 0});
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        std::vector<std::pair<double, SiteId>> sorted;
        for (Index s = 0; s < sites.size(); ++s) sorted.emplace_back(alone[s][v], SiteId(s));
        std::sort(sorted.begin(), sorted.end());
        for (Index i = 0; i < k; ++i) {
            EXPECT_EQ(ranks.site[v * k + i], sorted[i].second) << v << ' ' << i;
            EXPECT_NEAR(ranks.distance[v * k + i], sorted[i].first, 1e-12);
        }
    }
}
