// Lines and regions as sites: truth is the distance to segments and triangles in the plane and on
// unrolled surfaces, and elsewhere that to ever denser points on the line, which falls by h^2.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "agvd/core/error.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "support/dirty_shapes.h"
#include "support/line_sites.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;
using namespace line_sites;

namespace {

// Points on the edges, `num` intervals on each.
std::vector<SurfacePoint> points_along(const Surface& surface, const SiteShape& line, Index num) {
    std::vector<SurfacePoint> points;
    for (const Index edge : line.edges) {
        for (Index i = 0; i <= num; ++i) {
            points.push_back(point_on(surface.edge_half[edge], static_cast<double>(i) / num));
        }
    }
    return points;
}

}  // namespace

TEST(SiteShapes, HaveTheirDistanceInThePlane) {
    int count = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface surface = uneven_square(12, seed);
        const std::vector<SiteShape> shapes =
            numbered({random_line(surface, 1 + static_cast<Index>(seed), seed),
                      random_line(surface, 9, seed + 100),
                      random_region(surface, 1 + static_cast<Index>(seed), seed + 200)});
        const auto points = points::scattered(surface, 3, seed);
        std::vector<SiteShape> with_points = shapes;
        for (SiteShape& shape : with_points) shape.site += 3;
        for (const double max_error : {0.0, 1e-4}) {
            for (const bool has_points : {false, true}) {
                const auto given = std::span(points).first(has_points ? 3 : 0);
                const Propagation found = propagate(
                    surface, given,
                    {.shapes = has_points ? with_points : shapes, .max_error = max_error});
                EXPECT_LE(found.certified_error, max_error);
                for (Index v = 0; v < surface.num_vertices(); ++v) {
                    const Vec3& p = surface.mesh.positions[v];
                    std::vector<double> distance;
                    for (const SurfacePoint& q : given) {
                        distance.push_back((position(surface.mesh.view(), q) - p).norm());
                    }
                    for (const SiteShape& shape : shapes) {
                        distance.push_back(in_plane(surface, shape, p));
                    }
                    const double least = *std::min_element(distance.begin(), distance.end());
                    const double tolerance = 1e-13 + max_error * least;
                    ASSERT_NEAR(found.vertex_distance[v], least, tolerance) << v;
                    ASSERT_NEAR(distance[found.vertex_site[v].value()], least, tolerance) << v;
                    ++count;
                }
            }
        }
    }
    EXPECT_EQ(count, 30 * 4 * 13 * 13);
}

TEST(SiteShapes, AreNearerThanPointsOnThemByTheSquareOfTheirSpacing) {
    int count = 0;
    std::array<double, 3> excess{};  // Sums of what the points are farther, with 4, 16, 64 an edge.
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            SCOPED_TRACE(std::string(family) + " seed " + std::to_string(seed));
            const Surface surface = build_surface(random_meshes::make(family, seed).view());
            const SiteShape line = random_line(surface, 1 + 2 * static_cast<Index>(seed), seed);
            const Propagation exact = propagate(surface, {}, {.shapes = {line}, .max_error = 0});
            const Propagation near = propagate(surface, {}, {.shapes = {line}});
            double longest = 0;
            for (const Index e : line.edges) longest = std::max(longest, surface.length[e]);
            for (std::size_t fine = 0; fine < 3; ++fine) {
                const Index num = Index{4} << (2 * fine);
                const Propagation of_points =
                    propagate(surface, points_along(surface, line, num), {.max_error = 0});
                for (Index v = 0; v < surface.num_vertices(); ++v) {
                    const double d = exact.vertex_distance[v], p = of_points.vertex_distance[v];
                    if (!(p < infinity)) {
                        EXPECT_EQ(d, p);
                        continue;
                    }
                    const double tolerance = 1e-11 * (p + longest);
                    ASSERT_LE(d, p + tolerance) << v;
                    ASSERT_GE(d, p - longest / num / 2 - tolerance) << v;
                    ASSERT_GE(near.vertex_distance[v], d - tolerance) << v;
                    ASSERT_LE(near.vertex_distance[v], d * (1 + near.certified_error) + tolerance);
                    if (d > longest / 2) excess[fine] += (p - d) / longest;
                    ++count;
                }
            }
        }
    }
    EXPECT_GT(count, 1000);
    EXPECT_GT(excess[0], 0.5);
    EXPECT_LT(excess[1], excess[0] / 12);
    EXPECT_LT(excess[2], excess[1] / 12);
}

// From above, as the points on a line are farther than the line.
TEST(SiteShapes, AreFoundBySteinerPointsWithAnErrorThatFalls) {
    std::array<double, 3> excess{};
    int count = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.03, seed).view());
        const std::vector<SiteShape> shapes =
            numbered({random_line(surface, 9, seed), random_region(surface, 7, seed + 50)}, 2);
        const auto points = points::scattered(surface, 2, seed);
        const Propagation exact = propagate(surface, points, {.shapes = shapes, .max_error = 0});
        for (std::size_t fine = 0; fine < 3; ++fine) {
            const Propagation found = propagate(surface, points,
                                                {.shapes = shapes,
                                                 .engine = Engine::Steiner,
                                                 .steiner_points = (4 << (2 * fine)) - 1});
            for (Index v = 0; v < surface.num_vertices(); ++v) {
                ASSERT_GE(found.vertex_distance[v], exact.vertex_distance[v] - 1e-12) << v;
                excess[fine] += found.vertex_distance[v] - exact.vertex_distance[v];
                ++count;
            }
            for (const Index face : shapes[1].faces) {
                for (const Index v : surface.mesh.triangles[face]) {
                    EXPECT_EQ(found.vertex_distance[v], 0);
                }
            }
        }
    }
    EXPECT_EQ(count, 8 * 3 * 642);
    EXPECT_LT(excess[0], count * 1e-2);
    EXPECT_LT(excess[1], excess[0] / 8);
    EXPECT_LT(excess[2], excess[1] / 8);
}

// Contract of Propagation::mixed_faces, and all is reached.
TEST(SiteShapes, ReachAllWhereSpikesLeaveNoDigits) {
    int num_tried = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const std::optional<Surface> spiked = shapes::spiked_surface(seed);
        if (!spiked) continue;
        const Surface& surface = *spiked;
        const std::vector<SiteShape> shapes =
            numbered({random_line(surface, 5, seed), random_region(surface, 3, seed)});
        for (const double max_error : {0.0, 1e-3}) {
            const Propagation found =
                propagate(surface, {}, {.shapes = shapes, .max_error = max_error});
            std::vector<bool> is_mixed(surface.num_faces(), false);
            for (const Index f : found.mixed_faces) is_mixed[f] = true;
            for (Index f = 0; f < surface.num_faces(); ++f) {
                const Triangle& t = surface.mesh.triangles[f];
                for (const Index v : t) {
                    EXPECT_TRUE(std::isfinite(found.vertex_distance[v]));
                    EXPECT_TRUE(is_mixed[f] || found.vertex_site[v] == found.vertex_site[t[0]]);
                }
            }
            ++num_tried;
        }
    }
    EXPECT_GE(num_tried, 40);
}

TEST(SiteShapes, AreChecked) {
    const Surface surface = build_surface(shapes::grid(2).view());
    const auto points = points::scattered(surface, 2, 1);
    const auto propagated = [&](const SiteShape& shape, const PropagationOptions& given = {}) {
        PropagationOptions options = given;
        options.shapes = {shape};
        return propagate(surface, points, options);
    };
    EXPECT_THROW((void)propagated({.site = 2}), InvalidSites);
    EXPECT_THROW((void)propagated({.edges = {16}, .site = 2}), InvalidSites);
    EXPECT_THROW((void)propagated({.faces = {8}, .site = 2}), InvalidSites);
    EXPECT_THROW((void)propagated({.edges = {0}, .site = 3}), InvalidSites);
    EXPECT_THROW(
        (void)propagated({.edges = {0}, .site = 2}, {.engine = Engine::Steiner, .max_error = 0.1}),
        InvalidOption);
    EXPECT_NO_THROW((void)propagated({.edges = {15}, .faces = {7}, .site = 2}));
    EXPECT_NO_THROW((void)propagated({.edges = {15}, .site = 1}));
}
