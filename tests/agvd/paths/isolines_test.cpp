#include "agvd/paths/isolines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "agvd/core/error.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/paths/face_strip.h"
#include "support/developable.h"
#include "support/exact_field.h"
#include "support/line_sites.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Of the arc, in its own direction.
double angle_of(const IsolineArc& arc) {
    const Vec2 a = arc.begin - arc.centre, b = arc.end - arc.centre;
    return std::atan2(cross(a, b), a.dot(b));
}

bool is_straight(const IsolineArc& arc) { return arc.radius == infinity; }

double length_of(const IsolineArc& arc) {
    return is_straight(arc) ? (arc.end - arc.begin).norm() : arc.radius * angle_of(arc);
}

double length_of(const Isolines& isolines) {
    double length = 0;
    for (const IsolineArc& arc : isolines.arcs) length += length_of(arc);
    return length;
}

// As in exact_everywhere().
Propagation everywhere(const Surface& surface, std::span<const SurfacePoint> sites,
                       const SitePoints& points, const std::vector<SiteShape>& shapes) {
    return propagate(
        surface, sites,
        {.points = points, .shapes = shapes, .max_error = 0, .relay_faces = all_faces(surface)});
}

// A square of which the vertices inside are moved.
TriangleMesh moved_square(Index n) {
    TriangleMesh mesh = shapes::grid(n);
    const TriangleMesh moved = shapes::jitter(mesh, 0.2 / n, 3);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        Vec3& p = mesh.positions[v];
        if (p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1) {
            p = {moved.positions[v].x(), moved.positions[v].y(), 0};
        }
    }
    return mesh;
}

// Arcs run forwards, follow each other without gaps, and lie in their faces.
void expect_chains(const Surface& surface, const Isolines& isolines, double size) {
    const auto place = [&](const IsolineArc& arc, const Vec2& p) {
        const Index h = 3 * arc.face.value();
        const double up = p.y() / surface.apex[h].y();
        const double along = (p.x() - up * surface.apex[h].x()) / surface.length_of(h);
        EXPECT_GT(std::min({up, along, 1 - up - along}), -1e-9);
        return position(surface.mesh.view(), {arc.face, {1 - up - along, along, up}});
    };
    ASSERT_EQ(isolines.line_arcs.size(), isolines.lines.size() + 1);
    for (std::size_t line = 0; line < isolines.lines.size(); ++line) {
        const Index first = isolines.line_arcs[line], end = isolines.line_arcs[line + 1];
        ASSERT_LT(first, end);
        for (Index i = first; i < end; ++i) {
            const IsolineArc& arc = isolines.arcs[i];
            if (is_straight(arc)) {
                EXPECT_GT(cross(arc.end - arc.begin, arc.centre), 0);
                EXPECT_NEAR((arc.end - arc.begin).dot(arc.centre), 0, 1e-12 * size);
                EXPECT_NEAR(arc.centre.norm(), 1, 1e-12);
            } else {
                EXPECT_GT(angle_of(arc), 0);
                EXPECT_NEAR((arc.begin - arc.centre).norm(), arc.radius, 1e-12 * size);
                EXPECT_NEAR((arc.end - arc.centre).norm(), arc.radius, 1e-12 * size);
            }
            const bool is_last = i + 1 == end;
            if (is_last && !isolines.lines[line].is_closed) continue;
            const IsolineArc& next = isolines.arcs[is_last ? first : i + 1];
            EXPECT_LT((place(arc, arc.end) - place(next, next.begin)).norm(), 1e-7 * size);
        }
    }
}

}  // namespace

TEST(Isolines, OfOneSiteInASquareAreCircles) {
    const TriangleMesh mesh = moved_square(9);
    const Surface surface = build_surface(mesh.view());
    const std::array sites{SurfacePoint{FaceId(80), {0.3, 0.3, 0.4}}};
    const Vec3 centre = position(mesh.view(), sites[0]);
    const double room = std::min({centre.x(), 1 - centre.x(), centre.y(), 1 - centre.y()});
    const std::array levels{0.3 * room, 0.99 * room, 0.001};
    const Isolines isolines =
        build_isolines(surface, support::exact_everywhere(surface, sites), levels);
    ASSERT_EQ(isolines.lines.size(), 3u);
    expect_chains(surface, isolines, 1);
    EXPECT_NEAR(length_of(isolines), 2 * std::numbers::pi * (levels[0] + levels[1] + levels[2]),
                1e-10);
    const DrawnIsolines drawn = draw_isolines(surface, isolines, 1e-5);
    for (std::size_t line = 0; line < 3; ++line) {
        EXPECT_TRUE(isolines.lines[line].is_closed);
        EXPECT_EQ(isolines.lines[line].level, line);
        const Index first = drawn.offsets[line], end = drawn.offsets[line + 1];
        EXPECT_EQ(drawn.points[first], drawn.points[end - 1]);
        for (Index i = first; i < end; ++i) {
            const Vec3 p = position(mesh.view(), drawn.points[i]);
            EXPECT_NEAR((p - centre).norm(), levels[line], 1e-12);
            if (i == first) continue;
            const Vec3 middle = (p + position(mesh.view(), drawn.points[i - 1])) / 2;
            EXPECT_GT((middle - centre).norm(), levels[line] - 1e-5 - 1e-12);
        }
    }
}

TEST(Isolines, OfManySitesLieAtTheirLevels) {
    const TriangleMesh mesh = moved_square(11);
    const Surface surface = build_surface(mesh.view());
    const auto sites = points::scattered(surface, 7, 2);
    const Propagation propagation = support::exact_everywhere(surface, sites);
    const auto levels = levels_every(propagation, 0.031);
    ASSERT_GT(levels.size(), 5u);
    const Isolines isolines = build_isolines(surface, propagation, levels);
    expect_chains(surface, isolines, 1);
    const DrawnIsolines drawn = draw_isolines(surface, isolines, 1e-3);
    for (std::size_t line = 0; line < isolines.lines.size(); ++line) {
        const double level = levels[isolines.lines[line].level];
        for (Index i = drawn.offsets[line]; i < drawn.offsets[line + 1]; ++i) {
            const Vec3 p = position(mesh.view(), drawn.points[i]);
            double nearest = infinity;
            for (const SurfacePoint& site : sites) {
                nearest = std::min(nearest, (p - position(mesh.view(), site)).norm());
            }
            EXPECT_NEAR(nearest, level, 1e-9 * level);
        }
        if (isolines.lines[line].is_closed) continue;
        for (const Index i : {drawn.offsets[line], drawn.offsets[line + 1] - 1}) {
            const Vec3 p = position(mesh.view(), drawn.points[i]);
            EXPECT_LT(std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()}), 1e-9);
        }
    }
}

TEST(Isolines, OnAPrismAreCirclesWhenUnrolled) {
    constexpr Index n = 20;
    const TriangleMesh mesh = shapes::tube(n, 16);
    const Surface surface = build_surface(mesh.view());
    const double side = 2 * std::sin(std::numbers::pi / n);
    const std::array sites{SurfacePoint{FaceId(300), {0.3, 0.3, 0.4}}};
    const auto unrolled = [&](const Vec3& p) {
        const double k = std::floor(std::atan2(p.y(), p.x()) / (2 * std::numbers::pi / n));
        const Vec2 corner(std::cos(k * 2 * std::numbers::pi / n),
                          std::sin(k * 2 * std::numbers::pi / n));
        return Vec2(side * k + (Vec2(p.x(), p.y()) - corner).norm(), p.z());
    };
    const Vec2 centre = unrolled(position(mesh.view(), sites[0]));
    const std::array levels{0.4, 2.0, 3.05};
    const Isolines isolines =
        build_isolines(surface, support::exact_everywhere(surface, sites), levels);
    expect_chains(surface, isolines, 1);
    const DrawnIsolines drawn = draw_isolines(surface, isolines, 1e-4);
    std::array<int, 3> num_points{};
    for (std::size_t line = 0; line < isolines.lines.size(); ++line) {
        for (Index i = drawn.offsets[line]; i < drawn.offsets[line + 1]; ++i) {
            Vec2 way = unrolled(position(mesh.view(), drawn.points[i])) - centre;
            way.x() -= n * side * std::round(way.x() / (n * side));
            EXPECT_NEAR(way.norm(), levels[isolines.lines[line].level], 1e-9);
            ++num_points[isolines.lines[line].level];
        }
    }
    for (const int count : num_points) EXPECT_GT(count, 8);
}

// Two parallels and two half circles; around a square region four sides and four quarters.
TEST(Isolines, OfASegmentAndASquareAreParallelsAndArcs) {
    const Surface surface = build_surface(shapes::grid(10).view());
    SiteShape segment, square;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        const Vec3 middle =
            (surface.mesh.positions[surface.tail(h)] + surface.mesh.positions[surface.head(h)]) / 2;
        if (middle.y() == 0.5 && std::abs(middle.x() - 0.5) < 0.2) segment.edges.push_back(e);
    }
    for (Index f = 0; f < surface.num_faces(); ++f) {
        const Vec3 centre = position(surface.mesh.view(), {FaceId(f), {.3, .3, .4}});
        if (std::abs(centre.x() - 0.5) < 0.1 && std::abs(centre.y() - 0.5) < 0.1) {
            square.faces.push_back(f);
        }
    }
    ASSERT_EQ(segment.edges.size(), 4u);
    ASSERT_EQ(square.faces.size(), 8u);
    // One passes through vertices.
    const std::vector<double> levels{0.03, 0.1, 0.2, 0.28};
    for (const SiteShape& shape : {segment, square}) {
        const double straight = 0.8;
        const Isolines isolines =
            build_isolines(surface, everywhere(surface, {}, {}, {shape}), levels);
        expect_chains(surface, isolines, 1);
        ASSERT_EQ(isolines.lines.size(), levels.size());
        for (std::size_t line = 0; line < levels.size(); ++line) {
            EXPECT_TRUE(isolines.lines[line].is_closed);
            double parallels = 0, round = 0;
            for (Index i = isolines.line_arcs[line]; i < isolines.line_arcs[line + 1]; ++i) {
                const IsolineArc& arc = isolines.arcs[i];
                (is_straight(arc) ? parallels : round) += length_of(arc);
                for (const Vec2& end : {arc.begin, arc.end}) {
                    const Vec3 p =
                        position(surface.mesh.view(), to_surface(surface, arc.face.value(), end));
                    EXPECT_NEAR(line_sites::in_plane(surface, shape, p), levels[line],
                                1e-9 * levels[line]);
                }
            }
            EXPECT_NEAR(parallels, straight, 1e-9);
            EXPECT_NEAR(round, 2 * std::numbers::pi * levels[line], 1e-9);
        }
    }
}

// Points, groups, starts, lines and regions at once.
TEST(Isolines, OfAllKindsOfSitesLieAtTheirLevels) {
    Index num_straight = 0, num_round = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface surface = line_sites::uneven_square(11, seed);
        const auto points = points::scattered(surface, 3, seed);
        const SitePoints roles{.site = {1, 0, 1}, .start = {0.05, 0, 0.1}};
        std::vector<SiteShape> shapes{
            line_sites::random_line(surface, 1 + static_cast<Index>(seed), seed),
            line_sites::random_region(surface, 4, seed + 100)};
        shapes[0].site = 2;
        shapes[1].site = seed % 2 == 0 ? 3 : 0;
        shapes[0].start = seed % 3 == 0 ? 0.04 : 0;
        shapes[1].start = seed % 4 == 0 ? 0.06 : 0;
        const Propagation propagation = everywhere(surface, points, roles, shapes);
        const auto levels = levels_every(propagation, 0.021);
        ASSERT_GT(levels.size(), 4u);
        const Isolines isolines = build_isolines(surface, propagation, levels);
        expect_chains(surface, isolines, 1);
        for (const IsolineArc& arc : isolines.arcs) ++(is_straight(arc) ? num_straight : num_round);
        const DrawnIsolines drawn = draw_isolines(surface, isolines, 1e-3);
        for (std::size_t line = 0; line < isolines.lines.size(); ++line) {
            const double level = levels[isolines.lines[line].level];
            for (Index i = drawn.offsets[line]; i < drawn.offsets[line + 1]; ++i) {
                const Vec3 p = position(surface.mesh.view(), drawn.points[i]);
                double nearest = infinity;
                for (std::size_t k = 0; k < points.size(); ++k) {
                    const Vec3 site = position(surface.mesh.view(), points[k]);
                    nearest = std::min(nearest, roles.start[k] + (p - site).norm());
                }
                for (const SiteShape& shape : shapes) {
                    nearest =
                        std::min(nearest, shape.start + line_sites::in_plane(surface, shape, p));
                }
                ASSERT_NEAR(nearest, level, 1e-9 * level);
            }
            if (isolines.lines[line].is_closed) continue;
            for (const Index i : {drawn.offsets[line], drawn.offsets[line + 1] - 1}) {
                const Vec3 p = position(surface.mesh.view(), drawn.points[i]);
                EXPECT_LT(std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()}), 1e-9);
            }
        }
    }
    EXPECT_GT(num_straight, 3000);
    EXPECT_GT(num_round, 3000);
}

// Lines along ridges and rings of a prism and of a pyramid.
TEST(Isolines, OfLinesOnDevelopableSurfacesAreThoseOfThePlane) {
    const developable::Unrolled prism = developable::prism(12, 9);
    const developable::Unrolled pyramid = developable::pyramid(11, 8);
    const std::vector<std::pair<const developable::Unrolled*, std::vector<Index>>> cases{
        {&prism, {24, 36, 48, 60}},       {&prism, {49, 50, 51, 52, 53}},
        {&prism, {24, 25, 37, 38}},       {&pyramid, {1, 12, 23, 34}},
        {&pyramid, {0, 5, 16}},           {&pyramid, {34, 35, 36, 37}},
        {&pyramid, {40, 29, 30, 31, 42}},
    };
    for (const auto& [on, vertices] : cases) {
        const Surface& surface = on->surface;
        const SiteShape line = on->line(vertices);
        ASSERT_EQ(line.edges.size() + 1, vertices.size());
        const Propagation propagation = everywhere(surface, {}, {}, {line});
        const auto levels = levels_every(propagation, 0.17);
        const Isolines isolines = build_isolines(surface, propagation, levels);
        expect_chains(surface, isolines, 1);
        const DrawnIsolines drawn = draw_isolines(surface, isolines, 1e-3);
        std::vector<int> num_points(levels.size(), 0);
        for (std::size_t l = 0; l < isolines.lines.size(); ++l) {
            const double level = levels[isolines.lines[l].level];
            for (Index i = drawn.offsets[l]; i < drawn.offsets[l + 1]; ++i) {
                ASSERT_NEAR(on->distance(line, drawn.points[i]), level, 1e-9 * level);
                ++num_points[isolines.lines[l].level];
            }
        }
        for (const int count : num_points) EXPECT_GT(count, 4);
    }
}

TEST(Isolines, OfLinesOnClosedSurfacesAreClosed) {
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 6; ++seed) {
            SCOPED_TRACE(std::string(family) + " seed " + std::to_string(seed));
            const Surface surface = build_surface(random_meshes::make(family, seed).view());
            const auto shapes =
                line_sites::numbered({line_sites::random_line(surface, 6, seed),
                                      line_sites::random_region(surface, 3, seed + 9)},
                                     2);
            const auto points = points::scattered(surface, 2, seed);
            const Propagation propagation =
                everywhere(surface, points, {.start = {0, 0.1}}, shapes);
            double farthest = 0;
            for (const double d : propagation.vertex_distance) {
                if (d < infinity) farthest = std::max(farthest, d);
            }
            const Isolines isolines =
                build_isolines(surface, propagation, levels_every(propagation, farthest / 7));
            EXPECT_FALSE(isolines.lines.empty());
            for (std::size_t line = 0; line < isolines.lines.size(); ++line) {
                if (isolines.lines[line].is_closed) continue;
                const IsolineArc& first = isolines.arcs[isolines.line_arcs[line]];
                const IsolineArc& last = isolines.arcs[isolines.line_arcs[line + 1] - 1];
                EXPECT_TRUE(is_on_boundary(
                    surface,
                    snapped(surface, to_surface(surface, first.face.value(), first.begin))));
                EXPECT_TRUE(is_on_boundary(
                    surface, snapped(surface, to_surface(surface, last.face.value(), last.end))));
            }
        }
    }
}

TEST(Isolines, OfClosedSurfacesAreClosed) {
    for (const TriangleMesh& mesh : {shapes::jitter(shapes::sphere(3), 0.06, 1),
                                     shapes::jitter(shapes::torus(30, 15), 0.06, 2), shapes::cube(),
                                     shapes::torus(12, 8), shapes::sphere(2)}) {
        const Surface surface = build_surface(mesh.view());
        for (const Index count : {1u, 5u}) {
            const auto sites = points::scattered(surface, count, 4);
            const Propagation propagation = support::exact_everywhere(surface, sites);
            for (const double step : {0.05, 0.1}) {
                const Isolines isolines =
                    build_isolines(surface, propagation, levels_every(propagation, step));
                EXPECT_GT(isolines.lines.size(), 5u);
                expect_chains(surface, isolines, 1);
                for (const Isoline& line : isolines.lines) EXPECT_TRUE(line.is_closed);
            }
        }
    }
}

// Each level passes through vertices, and touches edges.
TEST(Isolines, MayMeetVertices) {
    const Surface surface = build_surface(shapes::grid(8).view());
    const std::array sites{point_at(surface, 40)};  // In the middle.
    const std::array levels{0.125, 0.25, 0.375, 0.125 * std::sqrt(2)};
    const Isolines isolines =
        build_isolines(surface, support::exact_everywhere(surface, sites), levels);
    expect_chains(surface, isolines, 1);
    EXPECT_EQ(isolines.lines.size(), 4u);
    for (const Isoline& line : isolines.lines) EXPECT_TRUE(line.is_closed);
    EXPECT_NEAR(length_of(isolines), 2 * std::numbers::pi * (0.75 + 0.125 * std::sqrt(2)), 1e-8);
}

TEST(Isolines, AreTheSameForAnyNumberOfThreads) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(4), 0.02, 1).view());
    const auto sites = points::scattered(surface, 3, 4);
    const Propagation propagation = support::exact_everywhere(surface, sites);
    const auto levels = levels_every(propagation, 0.1);
    const Isolines once = build_isolines(surface, propagation, levels, {.num_threads = 1});
    const Isolines again = build_isolines(surface, propagation, levels, {.num_threads = 3});
    ASSERT_EQ(once.arcs.size(), again.arcs.size());
    EXPECT_EQ(once.line_arcs, again.line_arcs);
    for (std::size_t i = 0; i < once.arcs.size(); ++i) {
        EXPECT_EQ(once.arcs[i].begin, again.arcs[i].begin);
        EXPECT_EQ(once.arcs[i].face, again.arcs[i].face);
    }
}

TEST(Isolines, WithErrorsAreNearTheirLevels) {
    const TriangleMesh mesh = moved_square(24);
    const Surface surface = build_surface(mesh.view());
    const std::array sites{SurfacePoint{FaceId(600), {0.3, 0.3, 0.4}}};
    constexpr double error = 1e-2;
    const Propagation propagation =
        propagate(surface, sites, {.max_error = error, .relay_faces = all_faces(surface)});
    const std::array levels{0.2, 0.3};
    const Isolines isolines = build_isolines(surface, propagation, levels);
    const Vec3 centre = position(mesh.view(), sites[0]);
    const DrawnIsolines drawn = draw_isolines(surface, isolines, 1e-4);
    EXPECT_GE(isolines.lines.size(), 2u);
    for (std::size_t line = 0; line < isolines.lines.size(); ++line) {
        const double level = levels[isolines.lines[line].level];
        for (Index i = drawn.offsets[line]; i < drawn.offsets[line + 1]; ++i) {
            const double distance = (position(mesh.view(), drawn.points[i]) - centre).norm();
            EXPECT_LE(distance, level * (1 + 1e-9));
            EXPECT_GE(distance, level / (1 + error) * (1 - 1e-9));
        }
    }
}

// One site, several, and with errors: relays elsewhere change nothing.
TEST(Isolines, NeedRelaysInTheFacesThatTheyMayCross) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(4), 0.01, 3).view());
    for (const Index num_sites : {1, 7}) {
        for (const double max_error : {0.0, 1e-3}) {
            const auto sites = points::scattered(surface, num_sites, 2);
            PropagationOptions options{.max_error = max_error};
            const std::vector<double> levels{0.3, 0.8};
            const std::vector<Index> faces =
                faces_at_levels(surface, propagate(surface, sites, options), levels);
            options.relay_faces = faces;
            const Propagation some = propagate(surface, sites, options);
            options.relay_faces = all_faces(surface);
            const Propagation all = propagate(surface, sites, options);
            EXPECT_LT(3 * faces.size(), surface.num_faces() * num_sites);
            const Isolines a = build_isolines(surface, some, levels);
            const Isolines b = build_isolines(surface, all, levels);
            EXPECT_EQ(a.line_arcs, b.line_arcs);
            ASSERT_EQ(a.arcs.size(), b.arcs.size());
            for (std::size_t i = 0; i < a.arcs.size(); ++i) {
                EXPECT_EQ(a.arcs[i].begin, b.arcs[i].begin);
                EXPECT_EQ(a.arcs[i].centre, b.arcs[i].centre);
            }
        }
    }
}

TEST(Isolines, NeedRelaysAndLevels) {
    const Surface surface = build_surface(shapes::sphere(2).view());
    const std::array sites{point_at(surface, 0)};
    const Propagation exact = support::exact_everywhere(surface, sites);
    for (const double level : {0.0, -1.0, std::nan(""), infinity}) {
        EXPECT_THROW((void)build_isolines(surface, exact, std::array{level}), InvalidOption);
        EXPECT_THROW((void)levels_every(exact, level), InvalidOption);
    }
    EXPECT_THROW((void)levels_every(exact, 1e-9), InvalidOption);
    EXPECT_THROW((void)draw_isolines(surface, {}, 0), InvalidOption);
    EXPECT_THROW((void)build_isolines(surface, propagate(surface, sites), std::array{1.0}),
                 InvalidInput);
    EXPECT_TRUE(build_isolines(surface, exact, std::array{100.0}).lines.empty());
}
