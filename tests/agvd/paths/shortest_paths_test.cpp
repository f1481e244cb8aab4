#include "agvd/paths/geodesic_path.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "agvd/core/error.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/paths/distances.h"
#include "agvd/paths/isolines.h"
#include "support/developable.h"
#include "support/exact_field.h"
#include "support/geodesics.h"
#include "support/line_sites.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Each piece lies in one face, the pieces add up to the length, and no bend can be cut short.
void expect_shortest(const Surface& surface, const GeodesicPath& path, double distance) {
    EXPECT_NEAR(path.length, distance, 1e-12 * distance);
    EXPECT_TRUE(path.is_locally_shortest);
    ASSERT_EQ(path.faces.size() + 1, path.points.size());
    double sum = 0;
    for (std::size_t i = 0; i < path.faces.size(); ++i) {
        const auto begin = seen_from(surface, path.points[i], path.faces[i].value());
        const auto end = seen_from(surface, path.points[i + 1], path.faces[i].value());
        ASSERT_TRUE(begin && end) << "piece " << i;
        sum += face_distance(surface, *begin, *end);
    }
    EXPECT_NEAR(sum, distance, 1e-12 * distance);
    EXPECT_LT(geodesics::largest_bend(surface, path.points), 1e-6);
}

// A square whose faces meet across edges of all directions.
TriangleMesh rough_square(Index n) {
    TriangleMesh mesh = shapes::jitter(shapes::grid(n), 0.2 / n, 1);
    const TriangleMesh even = shapes::grid(n);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        Vec3& p = mesh.positions[v];
        const Vec3& q = even.positions[v];
        p.z() = 0;
        if (q.x() == 0 || q.x() == 1 || q.y() == 0 || q.y() == 1) p = q;
    }
    return mesh;
}

// The prism of n sides and radius 1 around z, of which a side is 2 sin(pi / n) wide, unrolled.
Vec2 unrolled(const Vec3& p, Index n) {
    const double side = 2 * std::numbers::pi / n;
    const double turn = std::atan2(p.y(), p.x());
    const double k = std::floor(turn / side);
    const Vec2 corner(std::cos(k * side), std::sin(k * side));
    return {2 * std::sin(side / 2) * k + (Vec2(p.x(), p.y()) - corner).norm(), p.z()};
}

}  // namespace

TEST(ShortestPaths, OnASquareAreTheStraightLinesToTheNearestSite) {
    const TriangleMesh mesh = rough_square(12);
    const Surface surface = build_surface(mesh.view());
    const auto sites = points::scattered(surface, 6, 2);
    const auto starts = points::scattered(surface, 90, 5);
    const auto paths =
        paths_to_sites(surface, sites, support::exact_everywhere(surface, sites), starts);
    ASSERT_EQ(paths.size(), starts.size());
    for (std::size_t i = 0; i < starts.size(); ++i) {
        SCOPED_TRACE(i);
        const Vec3 from = position(mesh.view(), starts[i]);
        Index nearest = 0;
        for (Index s = 0; s < sites.size(); ++s) {
            const auto distance = [&](Index t) {
                return (position(mesh.view(), sites[t]) - from).norm();
            };
            if (distance(s) < distance(nearest)) nearest = s;
        }
        EXPECT_EQ(paths[i].site.value(), nearest);
        const Vec3 to = position(mesh.view(), sites[nearest]);
        const GeodesicPath& path = paths[i].path;
        if (from == to) {
            EXPECT_EQ(path.length, 0);
            continue;
        }
        expect_shortest(surface, path, (to - from).norm());
        EXPECT_LT((position(mesh.view(), path.points.front()) - from).norm(), 1e-15);
        EXPECT_LT((position(mesh.view(), path.points.back()) - to).norm(), 1e-15);
    }
}

// Points in groups and with starts, lines and regions with starts.
TEST(ShortestPaths, LeadToSitesOfAllKinds) {
    int num_to_points = 0, num_to_shapes = 0, num_inside = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface surface = line_sites::uneven_square(11, seed);
        const auto sites = points::scattered(surface, 4, seed);
        const SitePoints roles{.site = {1, 0, 1, 0}, .start = {0.05, 0, 0.1, 0.02}};
        const double start = seed % 2 == 0 ? 0 : 0.03;
        std::vector<SiteShape> shapes{
            line_sites::random_line(surface, 1 + static_cast<Index>(seed), seed),
            line_sites::random_line(surface, 4, seed + 50),
            line_sites::random_region(surface, 5, seed + 100)};
        for (const Index i : {0u, 1u, 2u}) {
            shapes[i].site = i == 1 ? 0 : i + 1;
            shapes[i].site = std::min(shapes[i].site, Index{2});
            shapes[i].start = i * start;
        }
        for (const double max_error : {0.0, 1e-3}) {
            const Propagation propagation = propagate(surface, sites,
                                                      {.points = roles,
                                                       .shapes = shapes,
                                                       .max_error = max_error,
                                                       .relay_faces = all_faces(surface)});
            const auto starts = points::scattered(surface, 80, seed + 7);
            const auto paths = paths_to_sites(surface, sites, propagation, starts);
            const auto at = [&](const SurfacePoint& p) { return position(surface.mesh.view(), p); };
            for (std::size_t i = 0; i < starts.size(); ++i) {
                SCOPED_TRACE(i);
                const Vec3 from = at(starts[i]);
                double nearest = infinity;
                for (std::size_t k = 0; k < sites.size(); ++k) {
                    nearest = std::min(nearest, roles.start[k] + (from - at(sites[k])).norm());
                }
                for (const SiteShape& shape : shapes) {
                    nearest =
                        std::min(nearest, shape.start + line_sites::in_plane(surface, shape, from));
                }
                const auto& [site, path, at_end] = paths[i];
                const double tolerance = (max_error + 1e-12) * nearest + 1e-15;
                ASSERT_NEAR(path.length + at_end, nearest, tolerance);
                const Vec3 to = at(path.points.back());
                EXPECT_NEAR((at(path.points.front()) - from).norm(), 0, 1e-14);
                EXPECT_NEAR((to - from).norm(), path.length, 1e-12);
                bool is_at_point = false, is_on_shape = false;
                for (Index k = 0; k < sites.size(); ++k) {
                    is_at_point =
                        is_at_point || (SiteId(roles.site[k]) == site && at_end == roles.start[k] &&
                                        (to - at(sites[k])).norm() < 1e-14);
                }
                for (const SiteShape& shape : shapes) {
                    is_on_shape =
                        is_on_shape || (SiteId(shape.site) == site && at_end == shape.start &&
                                        line_sites::in_plane(surface, shape, to) < 1e-14);
                }
                EXPECT_TRUE(is_at_point || is_on_shape);
                num_to_points += is_at_point ? 1 : 0;
                num_to_shapes += is_on_shape ? 1 : 0;
                num_inside += path.length == 0 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(num_to_points, 50);
    EXPECT_GT(num_to_shapes, 500);
    EXPECT_GT(num_inside, 5);
}

TEST(ShortestPaths, ToLinesOnDevelopableSurfacesAreStraight) {
    const developable::Unrolled prism = developable::prism(12, 9);
    const developable::Unrolled pyramid = developable::pyramid(11, 8);
    const std::vector<std::pair<const developable::Unrolled*, std::vector<Index>>> cases{
        {&prism, {24, 36, 48, 60}},
        {&prism, {24, 25, 37, 38}},
        {&pyramid, {1, 12, 23, 34}},
        {&pyramid, {40, 29, 30, 31, 42}}};
    for (const auto& [on, vertices] : cases) {
        const Surface& surface = on->surface;
        SiteShape line = on->line(vertices);
        line.start = 0.25;
        const Propagation propagation = propagate(
            surface, {}, {.shapes = {line}, .max_error = 0, .relay_faces = all_faces(surface)});
        const auto starts = points::scattered(surface, 60, 8);
        const auto paths = paths_to_sites(surface, {}, propagation, starts);
        for (std::size_t i = 0; i < starts.size(); ++i) {
            EXPECT_EQ(paths[i].start, 0.25);
            const double distance = on->distance(line, starts[i]);
            if (distance > 1e-15) expect_shortest(surface, paths[i].path, distance);
            EXPECT_LT(on->distance(line, paths[i].path.points.back()), 1e-14);
        }
    }
}

TEST(ShortestPaths, ToLinesOnRandomMeshesHaveTheDistances) {
    int count = 0;
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            SCOPED_TRACE(std::string(family) + " seed " + std::to_string(seed));
            const Surface surface = build_surface(random_meshes::make(family, seed).view());
            std::vector<SiteShape> shapes =
                line_sites::numbered({line_sites::random_line(surface, 6, seed),
                                      line_sites::random_region(surface, 3, seed + 9)});
            shapes[1].start = 0.1;
            const Propagation propagation = propagate(
                surface, {}, {.shapes = shapes, .max_error = 0, .relay_faces = all_faces(surface)});
            const auto starts = points::scattered(surface, 20, seed);
            const auto paths = paths_to_sites(surface, {}, propagation, starts);
            for (std::size_t i = 0; i < starts.size(); ++i) {
                const PointLabel label = label_at(surface, propagation, starts[i]);
                ASSERT_EQ(paths[i].site.is_valid(), label.site.is_valid());
                if (!label.site.is_valid()) continue;
                const double distance = label.distance.value();
                EXPECT_NEAR(paths[i].path.length + paths[i].start, distance,
                            1e-12 * distance + 1e-15);
                ++count;
            }
        }
    }
    EXPECT_GT(count, 300);
}

TEST(ShortestPaths, OnAPrismAreStraightWhenUnrolled) {
    constexpr Index n = 24;
    const TriangleMesh mesh = shapes::tube(n, 20);
    const Surface surface = build_surface(mesh.view());
    const double around = 2 * n * std::sin(std::numbers::pi / n);
    const auto ends = points::scattered(surface, 60, 8);
    std::vector<PointPair> pairs;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) pairs.push_back({ends[i], ends[i + 1]});
    const auto paths = shortest_paths(surface, pairs);
    ASSERT_EQ(paths.size(), pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        SCOPED_TRACE(i);
        Vec2 way = unrolled(position(mesh.view(), pairs[i].to), n) -
                   unrolled(position(mesh.view(), pairs[i].from), n);
        way.x() -= around * std::round(way.x() / around);
        expect_shortest(surface, paths[i], way.norm());
    }
}

TEST(ShortestPaths, HaveTheDistancesThatAreExact) {
    for (const TriangleMesh& mesh : {shapes::jitter(shapes::sphere(3), 0.05, 1),
                                     shapes::jitter(shapes::torus(30, 15), 0.06, 2),
                                     shapes::jitter(shapes::grid(16), 0.05, 3), shapes::cube()}) {
        const Surface surface = build_surface(mesh.view());
        const auto sites = points::scattered(surface, 3, 4);
        const Propagation propagation = support::exact_everywhere(surface, sites);
        std::vector<SurfacePoint> vertices;
        for (Index v = 0; v < surface.num_vertices(); v += 3) {
            vertices.push_back(point_at(surface, v));
        }
        const auto paths = paths_to_sites(surface, sites, propagation, vertices);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const double distance = propagation.vertex_distance[3 * i];
            if (distance == 0) continue;
            SCOPED_TRACE(3 * i);
            EXPECT_EQ(paths[i].site, propagation.vertex_site[3 * i]);
            expect_shortest(surface, paths[i].path, distance);
        }
    }
}

// In a cell the path crosses faces that have relays of other sites too; sites lie inside faces.
TEST(ShortestPaths, OfManySitesHaveTheDistancesOfTheirPoints) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(4), 0.03, 1).view());
    for (const Index count : {1u, 30u, 400u}) {
        const auto sites = uniform_points(surface, count, 3);
        const auto starts = uniform_points(surface, 400, 6);
        const auto paths =
            paths_to_sites(surface, sites, support::exact_everywhere(surface, sites), starts);
        const Distances distances = find_distances(surface, sites, starts, {.max_error = 0});
        for (std::size_t i = 0; i < starts.size(); ++i) {
            SCOPED_TRACE(i);
            EXPECT_EQ(paths[i].site, distances.point_site[i]);
            expect_shortest(surface, paths[i].path, distances.point_distance[i]);
        }
    }
}

// Arcs of isolines end where windows meet: from there the straight line to an image passes a vertex
// at no distance, and rounding must not choose the side.
TEST(ShortestPaths, OfPointsBetweenWindowsHaveTheirDistances) {
    std::size_t num_paths = 0;
    for (const TriangleMesh& mesh : {shapes::jitter(shapes::sphere(4), 0.05, 1),
                                     shapes::jitter(shapes::torus(40, 20), 0.06, 2),
                                     shapes::jitter(shapes::grid(24), 0.05, 3)}) {
        const Surface surface = build_surface(mesh.view());
        for (const Index num_sites : {1u, 3u}) {
            const auto sites = points::scattered(surface, num_sites, 4);
            const Propagation propagation = support::exact_everywhere(surface, sites);
            const auto levels = levels_every(propagation, 0.25);
            const auto starts =
                draw_isolines(surface, build_isolines(surface, propagation, levels), 1).points;
            const auto paths = paths_to_sites(surface, sites, propagation, starts);
            const Distances distances = find_distances(surface, sites, starts, {.max_error = 0});
            for (std::size_t i = 0; i < starts.size(); ++i) {
                SCOPED_TRACE(i);
                expect_shortest(surface, paths[i].path, distances.point_distance[i]);
            }
            num_paths += paths.size();
        }
    }
    EXPECT_GT(num_paths, 10'000);
}

// Lines along edges and diagonals meet flat vertices one after the other, and the site at last.
TEST(ShortestPaths, OverVerticesOfASquareAreStraight) {
    const TriangleMesh mesh = shapes::grid(16);
    const Surface surface = build_surface(mesh.view());
    std::vector<SurfacePoint> vertices;
    for (Index v = 0; v < surface.num_vertices(); ++v) vertices.push_back(point_at(surface, v));
    for (const Index site : {0u, 16u, 144u, 200u}) {
        const std::array sites{vertices[site]};
        const auto paths =
            paths_to_sites(surface, sites, support::exact_everywhere(surface, sites), vertices);
        for (Index v = 0; v < vertices.size(); ++v) {
            SCOPED_TRACE(v);
            const double distance = (mesh.positions[v] - mesh.positions[site]).norm();
            expect_shortest(surface, paths[v].path, distance);
        }
    }
}

TEST(ShortestPaths, BetweenPairsAreThoseToASite) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(40, 20), 0.05, 2).view());
    const auto ends = points::scattered(surface, 14, 9);
    std::vector<PointPair> pairs;
    for (std::size_t i = 1; i < ends.size(); ++i) pairs.push_back({ends[i], ends[i % 2]});
    const auto paths = shortest_paths(surface, pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        SCOPED_TRACE(i);
        if (pairs[i].from == pairs[i].to) continue;
        const std::array site{pairs[i].to};
        const std::array from{pairs[i].from};
        const auto alone =
            paths_to_sites(surface, site, support::exact_everywhere(surface, site), from);
        expect_shortest(surface, paths[i], alone[0].path.length);
    }
}

// Its faces do not lie in space.
TEST(ShortestPaths, OnAnIntrinsicTriangulationAreAsLong) {
    TriangleMesh mesh = shapes::jitter(shapes::torus(16, 8), 0.1, 2);
    shapes::add_flat_vertices(mesh, 60, 3);
    const Surface surface = build_surface(mesh.view());
    const IntrinsicTriangulation base(surface);
    const auto ends = points::scattered(surface, 60, 9);
    const auto on_base = base.to_intrinsic(ends);
    std::vector<PointPair> pairs, pairs_on_base;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
        pairs.push_back({ends[i], ends[i + 1]});
        pairs_on_base.push_back({on_base[i], on_base[i + 1]});
    }
    const auto paths = shortest_paths(surface, pairs);
    const auto paths_on_base = shortest_paths(base.surface(), pairs_on_base);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        EXPECT_NEAR(paths_on_base[i].length, paths[i].length, 1e-9) << i;
    }
}

TEST(ShortestPaths, WithErrorsInTheDistancesAreLongerByNoMore) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(40, 20), 0.06, 2).view());
    const auto sites = points::scattered(surface, 2, 4);
    const auto starts = points::scattered(surface, 60, 5);
    const auto exact =
        paths_to_sites(surface, sites, support::exact_everywhere(surface, sites), starts);
    constexpr double error = 1e-2;
    const Propagation rough =
        propagate(surface, sites, {.max_error = error, .relay_faces = all_faces(surface)});
    const auto paths = paths_to_sites(surface, sites, rough, starts);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const double distance = exact[i].path.length;
        if (distance > 0) expect_shortest(surface, exact[i].path, distance);
        EXPECT_GE(paths[i].path.length, distance * (1 - 1e-12)) << i;
        EXPECT_LE(paths[i].path.length, exact[i].path.length * (1 + error)) << i;
    }
}

TEST(ShortestPaths, AreTheSameForAnyNumberOfThreads) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.05, 1).view());
    const auto sites = points::scattered(surface, 3, 4);
    const auto starts = points::scattered(surface, 50, 5);
    const Propagation propagation = support::exact_everywhere(surface, sites);
    const auto once = paths_to_sites(surface, sites, propagation, starts, {.num_threads = 1});
    const auto again = paths_to_sites(surface, sites, propagation, starts, {.num_threads = 3});
    for (std::size_t i = 0; i < starts.size(); ++i) {
        EXPECT_EQ(once[i].site, again[i].site);
        EXPECT_EQ(once[i].path.points, again[i].path.points);
        EXPECT_EQ(once[i].path.length, again[i].path.length);
    }
}

TEST(ShortestPaths, EndWhereNoSiteReaches) {
    const TriangleMesh mesh =
        shapes::join(shapes::grid(2), shapes::moved(shapes::grid(2), {3, 0, 0}));
    const Surface surface = build_surface(mesh.view());
    const std::array sites{point_at(surface, 0)};
    const std::array starts{SurfacePoint{FaceId(15), {0.2, 0.3, 0.5}}, point_at(surface, 4)};
    const auto paths =
        paths_to_sites(surface, sites, support::exact_everywhere(surface, sites), starts);
    EXPECT_FALSE(paths[0].site.is_valid());
    EXPECT_TRUE(paths[0].path.points.empty());
    EXPECT_NEAR(paths[1].path.length, std::sqrt(0.5), 1e-15);
    const std::array pairs{PointPair{starts[1], sites[0]}, PointPair{starts[0], sites[0]}};
    try {
        (void)shortest_paths(surface, pairs);
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find("pair 1 "), std::string::npos) << error.what();
    }
}

TEST(ShortestPaths, RefuseWhatIsNoPointAndNoError) {
    const Surface surface = build_surface(shapes::cube().view());
    const std::array pairs{PointPair{{FaceId(12), {1, 0, 0}}, {FaceId(0), {1, 0, 0}}}};
    EXPECT_THROW((void)shortest_paths(surface, pairs), InvalidSites);
    EXPECT_THROW((void)shortest_paths(surface, {}, {.max_error = 1}), InvalidOption);
    EXPECT_TRUE(shortest_paths(surface, {}).empty());
}
