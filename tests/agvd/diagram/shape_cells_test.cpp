// Cells of lines and regions: in the plane their borders are parts of parabolas and lines by
// formula, elsewhere their points are as far from both sites.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "agvd/core/error.h"
#include "agvd/diagram/cut_cells.h"
#include "agvd/diagram/diagram.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "support/checks.h"
#include "support/developable.h"
#include "support/dice.h"
#include "support/line_sites.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;
using namespace line_sites;

namespace {

// Where a part of a line starts too late, what is left of its cell may not be connected.
constexpr int parts_with_starts = 6;

// Lines and regions that have no vertex in common, and points.
struct MixedSites {
    std::vector<SurfacePoint> points;
    std::vector<SiteShape> shapes;
};

std::vector<Index> vertices_of(const Surface& surface, const SiteShape& shape) {
    std::vector<Index> vertices;
    for (const Index e : shape.edges) {
        vertices.push_back(surface.tail(surface.edge_half[e]));
        vertices.push_back(surface.head(surface.edge_half[e]));
    }
    for (const Index f : shape.faces) {
        for (const Index v : surface.mesh.triangles[f]) vertices.push_back(v);
    }
    return vertices;
}

MixedSites mixed_sites(const Surface& surface, std::uint64_t seed) {
    MixedSites sites{points::scattered(surface, 4, seed), {}};
    std::vector<bool> is_taken(surface.num_vertices(), false);
    for (std::uint64_t i = 0; i < 4; ++i) {
        const SiteShape shape = i % 2 == 0 ? random_line(surface, 5, seed * 4 + i)
                                           : random_region(surface, 4, seed * 4 + i);
        const std::vector<Index> own = vertices_of(surface, shape);
        if (std::any_of(own.begin(), own.end(), [&](Index v) { return is_taken[v]; })) continue;
        for (const Index v : own) is_taken[v] = true;
        sites.shapes.push_back(shape);
    }
    sites.shapes = numbered(sites.shapes, 4);
    return sites;
}

// From one site, within the point's face.
double distance_through_relays(const Surface& surface, const Propagation& propagation,
                               const SurfacePoint& p, SiteId site) {
    const std::optional<Index> mixed = mixed_index_of(propagation, p.face.value());
    if (!mixed) return infinity;
    double least = infinity;
    for (const Relay& relay : relays_of(propagation, *mixed)) {
        if (relay.site != site) continue;
        const PlanarRelay planar = to_planar(relay, to_face_frame(surface, relay.half_edge));
        least = std::min(least,
                         reach(planar, position_in_frame(surface, p, 3 * p.face.value())).distance);
    }
    return least;
}

// The faces across the sides of a region, some of them.
SiteShape beside(const Surface& surface, const SiteShape& region) {
    SiteShape other;
    for (const Index face : region.faces) {
        for (Index h = 3 * face; h < 3 * face + 3 && other.faces.size() < 4; ++h) {
            if (surface.twin[h] == no_index) continue;
            const Index across = Surface::face(surface.twin[h]);
            const bool is_inside =
                std::find(region.faces.begin(), region.faces.end(), across) != region.faces.end();
            if (!is_inside) other.faces.push_back(across);
        }
    }
    return other;
}

// Two shapes with common edges: regions side by side, one in the other, a line with a part of
// another one, and a region with a line that runs along it.
std::vector<SiteShape> touching_shapes(const Surface& surface, std::uint64_t seed) {
    const SiteShape region = random_region(surface, 6, seed + 7);
    const SiteShape line = random_line(surface, 8, seed + 3);
    SiteShape other;
    switch (seed % 4) {
        case 0:
            return {region, beside(surface, region)};
        case 1:
            other.faces = {region.faces[0], region.faces[1]};
            return {region, other};
        case 2:
            other = random_line(surface, 4, seed + 5);
            other.edges.insert(other.edges.end(), line.edges.begin() + 2, line.edges.begin() + 5);
            return {line, other};
        default:
            other = line;
            other.edges.push_back(surface.edge[3 * region.faces[0]]);
    }
    return {region, other};
}

}  // namespace

TEST(CellsOfLines, EndAtTheParabola) {
    for (const Index n : {3, 8, 13}) {
        SCOPED_TRACE(n);
        const Surface surface = uneven_square(n, n);
        SiteShape bottom{.site = 1};
        for (Index e = 0; e < surface.num_edges(); ++e) {
            const Index h = surface.edge_half[e];
            const auto& at = surface.mesh.positions;
            if (at[surface.tail(h)].y() == 0 && at[surface.head(h)].y() == 0) {
                bottom.edges.push_back(e);
            }
        }
        ASSERT_EQ(bottom.edges.size(), n);
        Index middle = 0;  // The vertex nearest to the middle.
        const Vec3 centre(0.5, 0.5, 0);
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            const auto& at = surface.mesh.positions;
            if ((at[v] - centre).norm() < (at[middle] - centre).norm()) middle = v;
        }
        const Vec3 focus = surface.mesh.positions[middle];
        const std::vector<SurfacePoint> point{point_at(surface, middle)};
        const Propagation propagation =
            propagate(surface, point, {.shapes = {bottom}, .max_error = 0});
        const Diagram diagram =
            build_diagram(surface, point, propagation, {.chord_tolerance = 1e-5});
        checks::expect_valid_complex(surface, diagram);
        // The parabola is y = ((x - fx)^2 + fy^2) / 2 fy.
        const auto integral = [&](double x) {
            return (std::pow(x - focus.x(), 3) / 3 + focus.y() * focus.y() * x) / (2 * focus.y());
        };
        // At most 16 chords in a face.
        EXPECT_NEAR(diagram.cell_area[1], integral(1) - integral(0), 4e-4 / (n * n));
        Index count = 0;
        for (Index e = 0; e < diagram.edges.size(); ++e) {
            if (!diagram.edges[e].right.is_valid()) continue;
            for (Index i = diagram.edge_points[e]; i < diagram.edge_points[e + 1]; ++i) {
                const Vec3 p = position(surface.mesh.view(), diagram.points[i]);
                EXPECT_NEAR((p - focus).norm(), p.y(), 1e-11);
                EXPECT_NEAR(diagram.point_distance[i], p.y(), 1e-11);
                ++count;
            }
        }
        EXPECT_GT(count, 2 * n);
    }
}

// Of every second seed shapes and points have starts.
TEST(CellsOfLines, AreThoseOfTheFormulaInThePlane) {
    int count = 0, num_shapes = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface surface = uneven_square(14, seed / 2);
        auto [points, shapes] = mixed_sites(surface, seed / 2);
        SitePoints roles;
        if (seed % 2 == 1) {
            roles.start = {0, 0.03, 0, 0.05};
            for (SiteShape& shape : shapes) shape.start = 0.02 * (shape.site - 3);
        }
        num_shapes += static_cast<int>(shapes.size());
        const Propagation propagation =
            propagate(surface, points, {.points = roles, .shapes = shapes, .max_error = 0});
        const Diagram diagram = build_diagram(surface, points, propagation);
        checks::expect_valid_complex(surface, diagram, seed % 2 == 1 ? parts_with_starts : 1);
        EXPECT_EQ(diagram.num_sites, 4 + shapes.size());
        const auto start_of_point = [&](Index s) {
            return roles.start.empty() ? 0 : roles.start[s];
        };
        for (Index e = 0; e < diagram.edges.size(); ++e) {
            if (!diagram.edges[e].right.is_valid()) continue;
            for (Index i = diagram.edge_points[e]; i < diagram.edge_points[e + 1]; ++i) {
                const Vec3 p = position(surface.mesh.view(), diagram.points[i]);
                for (const SiteId s : {diagram.edges[e].left, diagram.edges[e].right}) {
                    const double distance =
                        s.value() < 4
                            ? start_of_point(s.value()) +
                                  (position(surface.mesh.view(), points[s.value()]) - p).norm()
                            : shapes[s.value() - 4].start +
                                  in_plane(surface, shapes[s.value() - 4], p);
                    ASSERT_NEAR(diagram.point_distance[i], distance, 1e-10);
                    ++count;
                }
            }
        }
    }
    EXPECT_GT(num_shapes, 80);
    EXPECT_GT(count, 10000);
}

// Points of the cut cells against distances by formula. Shapes with common edges tie on whole
// areas, in front of their common vertices: the lower number owns these, but for strips in which
// the distances differ by rounding.
TEST(CellsOfLines, ThatTouchHoldTheirNearestPoints) {
    int count = 0, num_tied = 0, num_of_higher = 0;
    for (std::uint64_t seed = 0; seed < 48; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface surface = uneven_square(12, seed);
        std::vector<SiteShape> shapes = touching_shapes(surface, seed);
        if (seed % 8 < 4) std::swap(shapes[0], shapes[1]);
        shapes = numbered(shapes);
        const Diagram diagram =
            build_diagram(surface, {}, propagate(surface, {}, {.shapes = shapes, .max_error = 0}),
                          {.chord_tolerance = 1e-3});
        const CutCells cut = cut_cells(surface, diagram);
        std::array<double, 2> area{};
        Dice dice(seed);
        for (Index f = 0; f < cut.mesh.triangles.size(); ++f) {
            const auto [a, b, c] = cut.mesh.triangles[f];
            const auto& at = cut.mesh.positions;
            const double size = (at[b] - at[a]).cross(at[c] - at[a]).norm() / 2;
            const Index site = cut.face_site[f].value();
            area[site] += size;
            if (size < 1e-6) continue;
            const double u = dice.number(0.1, 0.8), v = dice.number(0.1, 0.9 - u);
            const Vec3 p = at[a] + u * (at[b] - at[a]) + v * (at[c] - at[a]);
            const std::array distance{in_plane(surface, shapes[0], p),
                                      in_plane(surface, shapes[1], p)};
            ASSERT_NEAR(distance[site], std::min(distance[0], distance[1]), 1e-3) << p.transpose();
            ++count;
            if (std::abs(distance[0] - distance[1]) > 1e-12) continue;
            ++num_tied;
            num_of_higher += site == 1 ? 1 : 0;
        }
        EXPECT_NEAR(area[0], diagram.cell_area[0], 1e-12);
        EXPECT_NEAR(area[1], diagram.cell_area[1], 1e-12);
    }
    EXPECT_GT(count, 10000);
    EXPECT_GT(num_tied, 2000);
    EXPECT_LT(num_of_higher, 0.02 * num_tied);
}

// All corners of a region's face are of another region, which is all around it.
TEST(CellsOfLines, MayBeOneFaceInAnotherRegion) {
    const Surface surface = uneven_square(6, 1);
    const Index face = 31;
    SiteShape ring;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (f != face) ring.faces.push_back(f);
    }
    const auto shapes = numbered({ring, {.faces = {face}}});
    const Diagram diagram =
        build_diagram(surface, {}, propagate(surface, {}, {.shapes = shapes, .max_error = 0}));
    EXPECT_NEAR(diagram.cell_area[1], surface_area(surface) - (1 - diagram.cell_area[1]), 1e-12);
    const CutCells cut = cut_cells(surface, diagram);
    for (Index f = 0; f < cut.face_site.size(); ++f) {
        EXPECT_EQ(cut.face_site[f].value(), cut.face_origin[f] == face ? 1u : 0u) << f;
    }
}

// Two lines on a prism and two on a pyramid, one with a start: the points of the bisector are as
// far from both by the formula of the plane.
TEST(CellsOfLines, AreThoseOfTheFormulaOnDevelopableSurfaces) {
    const developable::Unrolled prism = developable::prism(12, 9);
    const developable::Unrolled pyramid = developable::pyramid(11, 8);
    struct Case {
        const developable::Unrolled& on;
        SiteShape a, b;
    };
    const std::vector<Case> cases{
        {prism, prism.line({24, 36, 48, 60}), prism.line({78, 79, 80, 68}, 1)},
        {prism, prism.line({13, 26, 39}), prism.line({43, 44}, 1)},
        {pyramid, pyramid.line({1, 12, 23, 34}), pyramid.line({28, 29, 30, 41}, 1)},
        {pyramid, pyramid.line({0, 5, 16}), pyramid.line({66, 67, 68}, 1)}};
    for (Case c : cases) {
        for (const double start : {0.0, 0.1}) {
            c.b.start = start;
            const Surface& surface = c.on.surface;
            const Diagram diagram = build_diagram(
                surface, {}, propagate(surface, {}, {.shapes = {c.a, c.b}, .max_error = 0}));
            checks::expect_valid_complex(surface, diagram);
            int count = 0;
            for (Index e = 0; e < diagram.edges.size(); ++e) {
                if (!diagram.edges[e].right.is_valid()) continue;
                for (Index i = diagram.edge_points[e]; i < diagram.edge_points[e + 1]; ++i) {
                    const double to_a = c.on.distance(c.a, diagram.points[i]);
                    EXPECT_NEAR(to_a, c.on.distance(c.b, diagram.points[i]) + start, 1e-11);
                    EXPECT_NEAR(diagram.point_distance[i], to_a, 1e-11);
                    ++count;
                }
            }
            EXPECT_GT(count, 10);
        }
    }
}

TEST(CellsOfLines, AreACellComplexOnRandomMeshes) {
    int count = 0;
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            SCOPED_TRACE(std::string(family) + " seed " + std::to_string(seed));
            const Surface surface = build_surface(random_meshes::make(family, seed).view());
            auto [points, shapes] = mixed_sites(surface, seed);
            for (SiteShape& shape : shapes) {
                if (seed % 2 == 1) shape.start = 0.02 * (shape.site - 3);
            }
            std::vector<PropagationOptions> all{{.max_error = 0}, {}, {.engine = Engine::Steiner}};
            for (PropagationOptions& options : all) {
                options.shapes = shapes;
                checks::expect_valid_complex(
                    surface, build_diagram(surface, points, propagate(surface, points, options)),
                    seed % 2 == 1 ? parts_with_starts : 1);
                ++count;
            }
        }
    }
    EXPECT_GE(count, 300);
}

// No site is nearer there than those of the border. On coarse meshes, where a face holds several
// parts of a cell, this is so for most points only.
TEST(CellsOfLines, HaveBordersOfEqualDistances) {
    int count = 0;
    const TriangleMesh meshes[] = {shapes::jitter(shapes::sphere(4), 0.01, 3),
                                   shapes::jitter(shapes::torus(80, 40), 0.01, 4)};
    for (const TriangleMesh& mesh : meshes) {
        const Surface surface = build_surface(mesh.view());
        const double radius = std::sqrt(surface_area(surface) / (std::numbers::pi * 8));
        for (std::uint64_t seed = 0; seed < 6; ++seed) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            const auto [points, shapes] = mixed_sites(surface, seed);
            const Propagation propagation =
                propagate(surface, points, {.shapes = shapes, .max_error = 0});
            const Diagram diagram = build_diagram(surface, points, propagation);
            checks::expect_valid_complex(surface, diagram);
            for (Index e = 0; e < diagram.edges.size(); ++e) {
                const auto [left, right, tail, head] = diagram.edges[e];
                for (Index i = diagram.edge_points[e]; i < diagram.edge_points[e + 1]; ++i) {
                    const SurfacePoint& p = diagram.points[i];
                    const double least = label_at(surface, propagation, p).distance.value();
                    ASSERT_NEAR(diagram.point_distance[i], least, 1e-10 * radius);
                    for (const SiteId site : {left, right}) {
                        ASSERT_NEAR(distance_through_relays(surface, propagation, p, site), least,
                                    1e-10 * radius);
                    }
                    ++count;
                }
            }
        }
    }
    EXPECT_GT(count, 5000);
}

// Other sites lie at all vertices of an edge, and of a region: what is left are its middle parts.
TEST(CellsOfLines, NeedNoVertexOfTheLine) {
    const Surface surface = build_surface(shapes::grid(1).view());
    Index diagonal = 0;
    while (surface.twin[surface.edge_half[diagonal]] == no_index) ++diagonal;
    const Index h = surface.edge_half[diagonal];
    for (const Engine engine : {Engine::Window, Engine::Steiner}) {
        const std::vector<SurfacePoint> ends{point_at(surface, surface.tail(h)),
                                             point_at(surface, surface.head(h))};
        const PropagationOptions options{.shapes = {{.edges = {diagonal}, .site = 2, .start = 0.2}},
                                         .engine = engine};
        const Diagram diagram = build_diagram(surface, ends, propagate(surface, ends, options));
        checks::expect_valid_complex(surface, diagram);
        EXPECT_NEAR(diagram.cell_area[0], diagram.cell_area[1], 0.02);
        EXPECT_GT(diagram.cell_area[2], 0.5);
    }
    std::vector<SurfacePoint> corners;
    for (const Index v : surface.mesh.triangles[0]) corners.push_back(point_at(surface, v));
    const Diagram diagram = build_diagram(
        surface, corners,
        propagate(surface, corners,
                  {.shapes = {{.faces = {0}, .site = 3, .start = 0.3}}, .max_error = 0}),
        {.chord_tolerance = 1e-4});
    checks::expect_valid_complex(surface, diagram);
    // In the face all but sectors of radius .3; beyond the diagonal hyperbolas and a parabola bound
    // it.
    EXPECT_GT(diagram.cell_area[3], 0.5 - std::numbers::pi * 0.3 * 0.3 / 2);
}

TEST(CellsOfLines, AreTheSameForAnyNumberOfThreads) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(4), 0.01, 3).view());
    const auto [points, shapes] = mixed_sites(surface, 1);
    checks::expect_same_for_threads(surface, points, {.shapes = shapes});
}

TEST(CellsOfLines, HaveNoArcs) {
    const Surface surface = build_surface(shapes::grid(3).view());
    const auto [points, shapes] = mixed_sites(surface, 1);
    ASSERT_FALSE(shapes.empty());
    const Propagation propagation = propagate(surface, points, {.shapes = shapes});
    EXPECT_THROW((void)build_diagram(surface, points, propagation, {.chord = 1e-3}), InvalidOption);
}
