#include "agvd/paths/geodesic_path.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>

#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/paths/face_strip.h"
#include "agvd/propagation/propagate.h"
#include "support/delta_shapes.h"
#include "support/geodesics.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

constexpr double pi = std::numbers::pi;

// A fan around vertex 0 with corners of `corner` radians and spokes of length 1: a cone, a disc or
// a saddle, flat or not in space is all the same to it.
Surface fan(Index spokes, double corner) {
    const double total = spokes * corner;
    TriangleMesh mesh;
    mesh.positions.emplace_back(0, 0, 0);
    for (Index i = 0; i < spokes; ++i) {
        const double turn = 2 * pi * i / spokes;
        // Every spoke has length 1 and every rim edge the chord of the corner.
        const double chord = 2 * std::sin(corner / 2);
        if (total <= 2 * pi) {
            const double radius = chord / (2 * std::sin(pi / spokes));
            mesh.positions.emplace_back(radius * std::cos(turn), radius * std::sin(turn),
                                        -std::sqrt(std::max(0.0, 1 - radius * radius)));
        } else {
            // Up and down in turn: cos(corner) = r^2 cos(2 pi / spokes) - h^2, r^2 + h^2 = 1.
            const double radius_sq = (std::cos(corner) + 1) / (1 + std::cos(2 * pi / spokes));
            const double height = std::sqrt(1 - radius_sq);
            const double radius = std::sqrt(radius_sq);
            mesh.positions.emplace_back(radius * std::cos(turn), radius * std::sin(turn),
                                        i % 2 == 0 ? height : -height);
        }
        mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % spokes});
    }
    return build_surface(mesh.view());
}

// At `share` of the spoke to rim vertex i.
SurfacePoint on_spoke(Index i, double share) { return {FaceId(i), {1 - share, share, 0}}; }

GeodesicPath straightened(const Surface& surface, const std::vector<SurfacePoint>& points) {
    return straighten_path(surface, points);
}

GeodesicPath random_start(const Surface& surface, const SurfacePoint& from, const SurfacePoint& to,
                          std::uint64_t seed) {
    const GeodesicPath path = geodesics::random_path(surface, from, to, seed);
    return straighten_path(surface, path.points, path.faces);
}

GeodesicPath through_vertex(const Surface& surface, const SurfacePoint& from, Index vertex,
                            const SurfacePoint& to) {
    return straightened(surface, {from, point_at(surface, vertex), to});
}

void expect_locally_shortest(const Surface& surface, const GeodesicPath& path) {
    EXPECT_TRUE(path.is_locally_shortest);
    EXPECT_NEAR(geodesics::length(surface, path.points), path.length, 1e-9 * path.length);
    EXPECT_LT(geodesics::largest_bend(surface, path.points), 1e-6);
    ASSERT_EQ(path.faces.size() + 1, path.points.size());
    double sum = 0;
    for (std::size_t i = 0; i < path.faces.size(); ++i) {
        const auto begin = seen_from(surface, path.points[i], path.faces[i].value());
        const auto end = seen_from(surface, path.points[i + 1], path.faces[i].value());
        ASSERT_TRUE(begin && end);
        const MeshView mesh = surface.mesh.view();
        sum += (position(mesh, *begin) - position(mesh, *end)).norm();
    }
    EXPECT_NEAR(sum, path.length, 1e-9 * path.length);
}

}  // namespace

TEST(GeodesicPath, InThePlaneAnyWayBecomesTheStraightLine) {
    TriangleMesh mesh = shapes::jitter(shapes::grid(8), 0.03, 1);
    for (Vec3& p : mesh.positions) p.z() = 0;
    // Convex, or the straight line might leave it.
    for (Vec3& p : mesh.positions) {
        if (p.x() < 0.05 || p.x() > 0.95) p.x() = std::round(p.x());
        if (p.y() < 0.05 || p.y() > 0.95) p.y() = std::round(p.y());
    }
    const Surface surface = build_surface(mesh.view());
    const auto ends = points::scattered(surface, 40, 3);
    for (Index i = 0; i + 1 < ends.size(); ++i) {
        SCOPED_TRACE(i);
        const GeodesicPath path = random_start(surface, ends[i], ends[i + 1], i);
        const double distance =
            (position(mesh.view(), ends[i]) - position(mesh.view(), ends[i + 1])).norm();
        EXPECT_NEAR(path.length, distance, 1e-12);
        expect_locally_shortest(surface, path);
    }
}

TEST(GeodesicPath, InsideOneFaceItIsTheSegment) {
    const Surface surface = build_surface(shapes::tetrahedron().view());
    const SurfacePoint a{FaceId(1), {0.2, 0.3, 0.5}}, b{FaceId(1), {0.6, 0.4, 0}};
    const GeodesicPath path = straightened(surface, {a, b});
    const MeshView mesh = surface.mesh.view();
    EXPECT_NEAR(path.length, (position(mesh, a) - position(mesh, b)).norm(), 1e-15);
    EXPECT_TRUE(path.is_locally_shortest);
    EXPECT_EQ(path.points.size(), 2u);
}

TEST(GeodesicPath, OverAConeItPassesTheApexOnTheNarrowSide) {
    // 1 + 4 corners of pi / 4: the straight line passes on the side of the one, whichever way round
    // the path was at first.
    const Surface surface = fan(5, pi / 4);
    const SurfacePoint a = on_spoke(0, 0.5), b = on_spoke(1, 0.8);
    const double chord = std::sqrt(0.25 + 0.64 - 2 * 0.5 * 0.8 * std::cos(pi / 4));
    std::vector<SurfacePoint> around{a};
    for (const Index i : {0U, 4U, 3U, 2U}) around.push_back(on_spoke(i, 0.6));
    around.push_back(b);
    for (const GeodesicPath& path :
         {straightened(surface, around), through_vertex(surface, a, 0, b)}) {
        EXPECT_NEAR(path.length, chord, 1e-14);
        expect_locally_shortest(surface, path);
    }
}

TEST(GeodesicPath, OverASaddleItGoesThroughTheVertex) {
    const Surface surface = fan(8, pi / 3);  // 480 degrees, 240 on each side.
    ASSERT_TRUE(surface.can_be_pseudo_source[0]);
    const SurfacePoint a = on_spoke(0, 0.5), b = on_spoke(4, 0.75);
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const GeodesicPath path = random_start(surface, a, b, seed);
        EXPECT_NEAR(path.length, 1.25, 1e-14);
        expect_locally_shortest(surface, path);
        EXPECT_EQ(path.points.size(), 3u);
    }
    // 2 of 8 corners are less than pi: past the vertex.
    const SurfacePoint c = on_spoke(2, 0.75);
    const double chord = std::sqrt(0.25 + 0.5625 - 2 * 0.5 * 0.75 * std::cos(2 * pi / 3));
    const GeodesicPath path = through_vertex(surface, a, 0, c);
    EXPECT_NEAR(path.length, chord, 1e-14);
    expect_locally_shortest(surface, path);
}

TEST(GeodesicPath, AtAReflexCornerOfTheBoundaryItBends) {
    TriangleMesh mesh = shapes::grid(4);
    std::vector<Triangle> left;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 center =
            (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
        if (center.x() < 0.5 || center.y() < 0.5) left.push_back(t);
    }
    mesh.triangles = left;
    // Vertices of the part cut out are left in no face.
    const Surface surface = build_surface(mesh.view());
    const auto nearest = [&](const Vec3& place) {
        for (Index f = 0; f < surface.num_faces(); ++f) {
            SurfacePoint center{FaceId(f), {1.0 / 3, 1.0 / 3, 1.0 / 3}};
            if ((position(mesh.view(), center) - place).norm() < 0.12) return center;
        }
        return SurfacePoint{};
    };
    const SurfacePoint a = nearest({0.4, 0.9, 0}), b = nearest({0.9, 0.4, 0});
    const Vec3 corner(0.5, 0.5, 0);
    const double around =
        (position(mesh.view(), a) - corner).norm() + (position(mesh.view(), b) - corner).norm();
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const GeodesicPath path = random_start(surface, a, b, seed);
        EXPECT_NEAR(path.length, around, 1e-14);
        expect_locally_shortest(surface, path);
    }
}

TEST(GeodesicPath, BothWaysRoundATubeAreKept) {
    const Index sides = 12, layers = 6;
    const Surface surface = build_surface(shapes::tube(sides, layers).view());
    const double side = 2 * std::sin(pi / sides);
    const auto vertex = [&](Index i, Index j) { return i % sides * (layers + 1) + j; };
    for (const Index passed : {4U, 8U, 16U}) {  // The short way, the long way, a turn more.
        for (const bool is_forward : {true, false}) {
            std::vector<SurfacePoint> start{point_at(surface, 0)};
            const auto at = [&](Index i) { return is_forward ? i : 10 * sides - i; };
            const auto to = [&](Index i, Index j) {
                start.push_back(point_at(surface, vertex(i, j)));
            };
            for (Index i = 1; i <= passed; ++i) to(at(i), 0);
            for (Index j = 1; j <= layers; ++j) to(at(passed), j);
            const GeodesicPath path = straightened(surface, start);
            EXPECT_NEAR(path.length, std::hypot(2, passed * side), 1e-13);
            expect_locally_shortest(surface, path);
        }
    }
}

// A path around a spike moves up one ring of the spike in each round: on a long spike the crossings
// of all rounds are bounded.
TEST(GeodesicPath, WindingAroundASpikeItStopsAtTheBound) {
    const Index sides = 3, turns = 200;
    for (const Index rings : {200U, 1000U}) {
        SCOPED_TRACE(rings);
        TriangleMesh spike = shapes::tube(sides, rings);
        for (Index i = 0; i < spike.positions.size(); ++i) {
            Vec3& p = spike.positions[i];
            const double width = 1 - 0.99 * (i % (rings + 1)) / rings;
            p = {width * p.x(), width * p.y(), 1 - width};
        }
        const Surface surface = build_surface(spike.view());
        const auto at_base = [&](Index i) { return i % sides * (rings + 1); };
        std::vector<SurfacePoint> points{point_at(surface, 0)};
        for (Index i = 1; i <= turns * sides; ++i) points.push_back(point_at(surface, at_base(i)));
        points.push_back(point_at(surface, 1));
        const double start = geodesics::length(surface, points);
        const std::size_t num_crossed = strip_along(surface, points, {}).crossed.size();
        std::size_t num_polls = 0;
        const Progress count = [&](double) { return ++num_polls > 0; };
        const GeodesicPath path = straighten_path(surface, points, {}, count);
        EXPECT_LT(path.length, 0.8 * start);
        EXPECT_EQ(path.is_locally_shortest, rings == 200);
        EXPECT_LE(num_polls, 1 + (400 * num_crossed + 200'000) / Ticker::interval);
    }
}

// Two corners of a face may be one vertex.
TEST(GeodesicPath, AVertexAtTwoCornersIsMeantWhereItIsNearest) {
    Index num_loops = 0;
    for (const char* family : delta_shapes::families()) {
        for (std::uint64_t seed = 0; seed < 12; ++seed) {
            const Surface input = build_surface(delta_shapes::make(family, seed).view());
            const agvd::IntrinsicTriangulation base(input);
            const Surface& surface = base.surface();
            const auto at = [](Index leaving) {
                SurfacePoint corner{FaceId(Surface::face(leaving)), {0, 0, 0}};
                corner.barycentric[leaving % 3] = 1;
                return corner;
            };
            for (Index h = 0; h < 3 * surface.num_faces(); ++h) {
                const Index next = Surface::next(h);
                if (surface.tail(h) != surface.tail(next)) continue;
                ++num_loops;
                EXPECT_LT(straightened(surface, {at(h), at(next)}).length,
                          1e-9 * surface.length_of(h))
                    << family << ' ' << seed;
            }
        }
    }
    EXPECT_GT(num_loops, 20u);
}

TEST(GeodesicPath, OnRandomMeshesEveryPathIsLocallyShortest) {
    const std::uint64_t num_seeds = std::getenv("AGVD_LONG") != nullptr ? 1000 : 30;
    std::size_t num_paths = 0, num_unproved = 0;
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 1; seed <= num_seeds; ++seed) {
            SCOPED_TRACE(std::string(family) + ' ' + std::to_string(seed));
            const Surface surface = build_surface(random_meshes::make(family, seed).view());
            Dice dice(seed);
            for (int i = 0; i < 4; ++i) {
                const SurfacePoint a =
                    points::anywhere(dice, dice.count(0, surface.num_faces() - 1));
                std::vector<bool> is_near(surface.num_faces(), false);
                std::vector<Index> open{a.face.value()};
                for (std::size_t k = 0; k < open.size(); ++k) {
                    if (is_near[open[k]]) continue;
                    is_near[open[k]] = true;
                    for (Index h = 3 * open[k]; h < 3 * open[k] + 3; ++h) {
                        if (surface.twin[h] != no_index) {
                            open.push_back(Surface::face(surface.twin[h]));
                        }
                    }
                }
                const SurfacePoint b = points::anywhere(
                    dice, open[dice.count(0, static_cast<Index>(open.size()) - 1)]);
                const GeodesicPath before = geodesics::random_path(surface, a, b, seed);
                const double start = geodesics::length(surface, before.points);
                const GeodesicPath path = straighten_path(surface, before.points, before.faces);
                double rounding = 0;  // Of coordinates; points that lie beside a vertex are moved.
                for (const Vec3& p : surface.mesh.positions) {
                    rounding = std::max(rounding, 1e-11 * p.norm());
                }
                EXPECT_LE(path.length, start + rounding);
                EXPECT_NEAR(geodesics::length(surface, path.points), path.length, rounding);
                ++num_paths;
                if (!path.is_locally_shortest) {
                    ++num_unproved;
                } else if (path.length > 1e6 * rounding) {
                    EXPECT_LT(geodesics::largest_bend(surface, path.points), 1e-5);
                }
            }
        }
    }
    // Rounding hides it on faces of no height.
    EXPECT_LE(num_unproved, num_paths / 1000);
}

TEST(GeodesicPath, BetweenPointsIsNoLongerThanAlongEdges) {
    const Surface surface = build_surface(shapes::tube(12, 6).view());
    const double side = 2 * std::sin(pi / 12);
    const GeodesicPath path =
        path_between(surface, point_at(surface, 0), point_at(surface, 4 * 7 + 6));
    EXPECT_NEAR(path.length, std::hypot(2, 4 * side), 1e-13);
    expect_locally_shortest(surface, path);
    const Surface two = build_surface(
        shapes::join(shapes::cube(), shapes::moved(shapes::cube(), {3, 0, 0})).view());
    EXPECT_THROW((void)path_between(two, point_at(two, 0), point_at(two, 8)), InvalidInput);
    EXPECT_THROW((void)straightened(two, {point_at(two, 0), point_at(two, 8)}), InvalidInput);
    EXPECT_THROW((void)straightened(two, {}), InvalidInput);
}

TEST(GeodesicPath, ToASiteInThePlaneIsTheSegmentToTheNearest) {
    TriangleMesh mesh = shapes::jitter(shapes::grid(20), 0.01, 1);
    for (Vec3& p : mesh.positions) {
        p.z() = 0;
        if (p.x() < 0.02 || p.x() > 0.98) p.x() = std::round(p.x());
        if (p.y() < 0.02 || p.y() > 0.98) p.y() = std::round(p.y());
    }
    const Surface surface = build_surface(mesh.view());
    const std::vector<SurfacePoint> sites = uniform_points(surface, 30, 2);
    const Propagation propagation = propagate(surface, sites, {.max_error = 0});
    for (const SurfacePoint& from : points::scattered(surface, 300, 3)) {
        const GeodesicPath path = path_to_site(surface, sites, propagation, from);
        double nearest = infinity;
        for (const SurfacePoint& site : sites) {
            nearest = std::min(nearest,
                               (position(mesh.view(), site) - position(mesh.view(), from)).norm());
        }
        EXPECT_NEAR(path.length, nearest, 1e-9);
        EXPECT_NEAR(
            (position(mesh.view(), path.points.front()) - position(mesh.view(), from)).norm(), 0,
            1e-11);
        if (path.length > 0) expect_locally_shortest(surface, path);
    }
}

TEST(GeodesicPath, ToASiteHasTheLengthOfTheDistance) {
    for (const TriangleMesh& mesh : {shapes::jitter(shapes::sphere(3), 0.03, 1),
                                     shapes::jitter(shapes::torus(40, 20), 0.03, 2)}) {
        const Surface surface = build_surface(mesh.view());
        const std::vector<SurfacePoint> sites = uniform_points(surface, 6, 1);
        const Propagation propagation = propagate(surface, sites, {.max_error = 0});
        Index num_longer = 0;
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            const GeodesicPath path =
                path_to_site(surface, sites, propagation, point_at(surface, v));
            EXPECT_GE(path.length, propagation.vertex_distance[v] * (1 - 1e-9));
            if (path.length > propagation.vertex_distance[v] * (1 + 1e-9)) ++num_longer;
        }
        EXPECT_LE(num_longer, surface.num_vertices() / 20);
    }
}

TEST(GeodesicPath, ToASiteIsFoundOnRandomMeshes) {
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            SCOPED_TRACE(std::string(family) + ' ' + std::to_string(seed));
            const Surface surface = build_surface(random_meshes::make(family, seed).view());
            const std::vector<SurfacePoint> sites = uniform_points(surface, 8, seed);
            const Propagation propagation = propagate(surface, sites);
            Dice dice(seed);
            for (int i = 0; i < 20; ++i) {
                const SurfacePoint from =
                    points::anywhere(dice, dice.count(0, surface.num_faces() - 1));
                if (!propagation.vertex_site[surface.tail(3 * from.face.value())].is_valid()) {
                    continue;
                }
                const GeodesicPath path = path_to_site(surface, sites, propagation, from);
                const double straight = (position(surface.mesh.view(), path.points.front()) -
                                         position(surface.mesh.view(), path.points.back()))
                                            .norm();
                EXPECT_GE(path.length, straight * (1 - 1e-9) - 1e-12);
            }
        }
    }
}
