// Lines and regions as sites: truth is the distance to segments and triangles in the plane and on
// unrolled surfaces, and elsewhere that to ever denser points on the line, which falls by h^2.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "agvd/core/error.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "support/developable.h"
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

// Of a line that two sites have the first owns it. With a start the other one does.
TEST(SiteShapes, MayShareEdges) {
    int num_shared = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface surface = uneven_square(12, seed);
        const SiteShape line = random_line(surface, 12, seed);
        SiteShape part = random_line(surface, 5, seed + 100);
        part.edges.insert(part.edges.end(), line.edges.begin() + 3, line.edges.begin() + 8);
        SiteShape region = random_region(surface, 6, seed + 200);
        for (Index h = 3 * region.faces[0]; h < 3 * region.faces[0] + 3; ++h) {
            part.edges.push_back(surface.edge[h]);
        }
        std::vector<SiteShape> shapes = numbered({line, part, region, line});
        const bool is_late = seed % 2 == 0;
        if (is_late) shapes[0].start = 0.05;
        const Propagation found = propagate(surface, {}, {.shapes = shapes, .max_error = 0});
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            const Vec3& p = surface.mesh.positions[v];
            std::vector<double> distance;
            for (const SiteShape& shape : shapes) {
                distance.push_back(shape.start + in_plane(surface, shape, p));
            }
            const double least = *std::min_element(distance.begin(), distance.end());
            ASSERT_NEAR(found.vertex_distance[v], least, 1e-13) << v;
            ASSERT_NEAR(distance[found.vertex_site[v].value()], least, 1e-13) << v;
            if (distance[3] > 0) continue;
            const auto first = std::find(distance.begin(), distance.end(), 0.0);
            EXPECT_EQ(found.vertex_site[v].value(), first - distance.begin()) << v;
            EXPECT_EQ(first == distance.begin(), !is_late) << v;
            ++num_shared;
        }
    }
    EXPECT_GT(num_shared, 200);
}

// A line and a region with starts, of which others own parts; a point on the line that starts
// earlier.
TEST(SiteShapes, MayStartAtADistance) {
    int num_inside = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface surface = uneven_square(12, seed);
        std::vector<SiteShape> shapes =
            numbered({random_line(surface, 9, seed), random_line(surface, 9, seed + 100),
                      random_region(surface, 12, seed + 200)},
                     3);
        shapes[0].start = 0.07;
        shapes[1].start = seed % 2 == 0 ? 0 : 0.2;
        shapes[2].start = 0.11;
        auto points = points::scattered(surface, 3, seed);
        points[0] = point_on(surface.edge_half[shapes[0].edges[0]], 0.3);
        points[1] = {FaceId(shapes[2].faces[0]), {0.3, 0.3, 0.4}};
        const std::vector<double> starts{0.02, 0.05, 0.1};
        const auto least_at = [&](const Vec3& p, std::vector<double>& distance) {
            distance.clear();
            for (std::size_t i = 0; i < points.size(); ++i) {
                distance.push_back(starts[i] +
                                   (position(surface.mesh.view(), points[i]) - p).norm());
            }
            for (const SiteShape& shape : shapes) {
                distance.push_back(shape.start + in_plane(surface, shape, p));
            }
            return *std::min_element(distance.begin(), distance.end());
        };
        std::vector<double> distance;
        for (const double max_error : {0.0, 1e-4}) {
            const Propagation found = propagate(surface, points,
                                                {.points = {.start = starts},
                                                 .shapes = shapes,
                                                 .max_error = max_error,
                                                 .relay_faces = all_faces(surface)});
            EXPECT_LE(found.certified_error, max_error);
            for (Index v = 0; v < surface.num_vertices(); ++v) {
                const double least = least_at(surface.mesh.positions[v], distance);
                const double tolerance = 1e-13 + max_error * least;
                ASSERT_NEAR(found.vertex_distance[v], least, tolerance) << v;
                ASSERT_NEAR(distance[found.vertex_site[v].value()], least, tolerance) << v;
            }
            for (const SurfacePoint& p : points::scattered(surface, 200, seed + 5)) {
                const double least = least_at(position(surface.mesh.view(), p), distance);
                const PointLabel label = label_at(surface, found, p);
                const double tolerance = 1e-13 + max_error * least;
                ASSERT_NEAR(label.distance.value(), least, tolerance);
                ASSERT_NEAR(distance[label.site.value()], least, tolerance);
                num_inside += label.site == SiteId(5) && least == 0.11 ? 1 : 0;
            }
        }
        const Propagation near = propagate(surface, points,
                                           {.points = {.start = starts},
                                            .shapes = shapes,
                                            .engine = Engine::Steiner,
                                            .steiner_points = 31});
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            const double least = least_at(surface.mesh.positions[v], distance);
            ASSERT_NEAR(near.vertex_distance[v], least, 1e-3);
        }
    }
    EXPECT_GT(num_inside, 50);
}

// Lines along ridges, rings and diagonals of a prism and of a pyramid.
TEST(SiteShapes, HaveTheirDistanceOnDevelopableSurfaces) {
    const developable::Unrolled prism = developable::prism(12, 9);
    const developable::Unrolled pyramid = developable::pyramid(11, 8);
    const std::vector<std::pair<const developable::Unrolled*, std::vector<Index>>> cases{
        {&prism, {24, 36, 48, 60}},   {&prism, {49, 50, 51, 52, 53}},  {&prism, {24, 37, 50}},
        {&prism, {24, 25, 37, 38}},   {&pyramid, {1, 12, 23, 34}},     {&pyramid, {0, 5, 16}},
        {&pyramid, {34, 35, 36, 37}}, {&pyramid, {40, 29, 30, 31, 42}}};
    for (const auto& [on, vertices] : cases) {
        const SiteShape line = on->line(vertices);
        ASSERT_EQ(line.edges.size() + 1, vertices.size());
        for (const double max_error : {0.0, 1e-4}) {
            const Propagation found =
                propagate(on->surface, {}, {.shapes = {line}, .max_error = max_error});
            for (Index v = 0; v < on->surface.num_vertices(); ++v) {
                const double exact = on->distance(line, point_at(on->surface, v));
                ASSERT_NEAR(found.vertex_distance[v], exact, 1e-13 + max_error * exact) << v;
            }
        }
    }
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
    EXPECT_THROW((void)propagated({.edges = {0}, .site = 2, .start = -1}), InvalidSites);
    EXPECT_THROW((void)propagated({.edges = {0}, .site = 2, .start = infinity}), InvalidSites);
    EXPECT_THROW(
        (void)propagated({.edges = {0}, .site = 2}, {.engine = Engine::Steiner, .max_error = 0.1}),
        InvalidOption);
    EXPECT_NO_THROW((void)propagated({.edges = {15}, .faces = {7}, .site = 2}));
    EXPECT_NO_THROW((void)propagated({.edges = {15}, .site = 1}));
}
