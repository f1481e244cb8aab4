#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "agvd/core/error.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "remesh/wrap/relax_guarded.h"
#include "remesh/wrap/wrap.h"
#include "support/dirty_shapes.h"
#include "support/parts.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::RemeshOptions;
using remesh::RemeshResult;
using remesh::detail::FittedWrap;

namespace {

constexpr double degree = std::numbers::pi / 180;

TriangleMesh box(const Vec3& low, const Vec3& high) {
    TriangleMesh mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p = low + p.cwiseProduct(high - low);
    return mesh;
}

// A cube, and a box that goes through its top and one of its sides.
TriangleMesh crossing_boxes() {
    return shapes::join(shapes::cube(), box({0.5, 0.3, 0.4}, {1.6, 0.8, 1.5}));
}

FittedWrap wrapped(const TriangleMesh& mesh, double radius) {
    const agvd::ClosestPointTree tree(mesh);
    return remesh::detail::fit_wrap(remesh::detail::alpha_wrap(mesh, radius), tree,
                                    {.radius = radius});
}

void expect_solid(const TriangleMesh& mesh, std::size_t num_components) {
    const agvd::Topology topology = agvd::analyze_topology(mesh);
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    EXPECT_EQ(topology.boundary_loops(), 0);
    EXPECT_EQ(topology.components.size(), num_components);
    EXPECT_GT(shapes::signed_volume(mesh), 0);
    const auto pairs = remesh::find_self_intersections(mesh);  // Nothing without CGAL.
    EXPECT_TRUE(!pairs || pairs->empty());
}

// Without CGAL the wrap is refused by name.
bool can_wrap() {
    try {
        (void)remesh::detail::alpha_wrap(shapes::cube(), 1);
        return true;
    } catch (const agvd::InvalidOption& error) {
        EXPECT_NE(std::string(error.what()).find("CGAL"), std::string::npos);
        return false;
    }
}

std::string refusal_of(const TriangleMesh& mesh, const RemeshOptions& options) {
    try {
        (void)remesh::remesh(mesh, options);
    } catch (const agvd::InvalidOption& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST(AlphaWrap, LiesAroundItsInputAtTheOffset) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const TriangleMesh soup = shapes::dirty_solids(seed);
        const agvd::MeshBox box = agvd::box_of(soup, 1);
        const double radius = (box.high - box.low).norm() / 30;
        const TriangleMesh wrap = remesh::detail::alpha_wrap(soup, radius);
        expect_solid(wrap, agvd::analyze_topology(wrap).components.size());
        const agvd::ClosestPointTree tree(soup);
        const double offset = remesh::detail::wrap_offset * radius;
        for (const Vec3& p : wrap.positions) {
            EXPECT_NEAR(std::sqrt(tree.query(p).distance_sq), offset, 0.0101 * offset);
        }
        // No face of it passes through the soup, which lies inside.
        const auto num_wrap = static_cast<Index>(wrap.triangles.size());
        const auto pairs = remesh::find_self_intersections(shapes::join(wrap, soup));
        for (const auto& [f, g] : pairs.value()) EXPECT_EQ(f < num_wrap, g < num_wrap);
        const agvd::MeshBox around = agvd::box_of(wrap, 1);
        EXPECT_TRUE((around.low.array() < box.low.array()).all());
        EXPECT_TRUE((around.high.array() > box.high.array()).all());
        // Balls of the radius do not pass its faces.
        for (Index f = 0; f < num_wrap; ++f) {
            const auto [a, b, c] = agvd::corners_of(wrap, f);
            const double circumradius = (b - a).norm() * (c - b).norm() * (a - c).norm() /
                                        (2 * (b - a).cross(c - a).norm());
            EXPECT_LT(circumradius, radius);
        }
    }
}

// Each flip makes others worth while.
TEST(FitWrap, EdgesLineUpWithCreases) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    // Lengths of edges times the angles there.
    const auto turn_of = [](const TriangleMesh& mesh) {
        const agvd::Surface surface = agvd::build_surface(mesh.view());
        double sum = 0;
        for (Index e = 0; e < surface.num_edges(); ++e) {
            const Index h = surface.edge_half[e];
            const Vec3 a = agvd::doubled_normal(mesh.positions, mesh.triangles[h / 3]);
            const Vec3 b =
                agvd::doubled_normal(mesh.positions, mesh.triangles[surface.twin[h] / 3]);
            sum += surface.length[e] * std::atan2(a.cross(b).norm(), a.dot(b));
        }
        return sum;
    };
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const TriangleMesh mesh = parts::turned(parts::capped_cylinder(24, 4), seed);
        EXPECT_LT(turn_of(wrapped(mesh, 0.05).mesh), 1.009 * turn_of(mesh)) << seed;
    }
}

TEST(Wrap, CrossingBoxesBecomeTheirUnionWithItsSeam) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    const TriangleMesh boxes = crossing_boxes();
    const FittedWrap wrap = wrapped(boxes, 0.1);
    expect_solid(wrap.mesh, 1);
    EXPECT_NEAR(shapes::signed_volume(wrap.mesh), 1.455, 1e-3);
    EXPECT_EQ(wrap.sheets, 0);
    // Corners of the boxes, and of their seam.
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1.6, 0.3, 1.5), Vec3(0.5, 0.3, 1),
                               Vec3(1, 0.8, 1), Vec3(1, 0.3, 0.4)}) {
        double nearest = 1;
        for (const Vec3& p : wrap.mesh.positions) nearest = std::min(nearest, (p - corner).norm());
        EXPECT_LT(nearest, 1e-5) << corner.transpose();
    }
    // What lies inside is gone.
    const agvd::ClosestPointTree tree(wrap.mesh);
    EXPECT_FALSE(tree.is_within({0.75, 0.5, 0.9}, 0.09));
}

TEST(UniteSolids, KeepsEveryEdgeOfTheirOutside) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    const auto united = remesh::detail::unite_solids(crossing_boxes(), 1);
    ASSERT_TRUE(united);
    expect_solid(*united, 1);
    EXPECT_NEAR(shapes::signed_volume(*united), 1.455, 1e-12);
    // Orientations play no part, and what lies inside is gone: a cavity and a solid within it.
    TriangleMesh nested =
        shapes::join(box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}), box({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}));
    nested = shapes::join(nested, shapes::cube());
    for (Index i = 0; i < 12; ++i) std::swap(nested.triangles[i][1], nested.triangles[i][2]);
    const auto outer = remesh::detail::unite_solids(nested, 1);
    ASSERT_TRUE(outer);
    expect_solid(*outer, 1);
    EXPECT_NEAR(shapes::signed_volume(*outer), 1, 1e-12);
    for (agvd::Triangle& t : nested.triangles) std::swap(t[1], t[2]);
    EXPECT_NEAR(shapes::signed_volume(remesh::detail::unite_solids(nested, 1).value()), 1, 1e-12);
    // Six walls around a room, which only their union has.
    TriangleMesh walls = shapes::join(box({0, 0, 0}, {1, 1, 0.1}), box({0, 0, 0.9}, {1, 1, 1}));
    walls = shapes::join(walls, box({0, 0, 0.05}, {0.1, 1, 0.95}));
    walls = shapes::join(walls, box({0.9, 0, 0.05}, {1, 1, 0.95}));
    walls = shapes::join(walls, box({0.05, 0, 0.05}, {0.95, 0.1, 0.95}));
    walls = shapes::join(walls, box({0.05, 0.9, 0.05}, {0.95, 1, 0.95}));
    const auto room = remesh::detail::unite_solids(walls, 1);
    ASSERT_TRUE(room);
    expect_solid(*room, 1);
    EXPECT_NEAR(shapes::signed_volume(*room), 1, 1e-12);
}

TEST(UniteSolids, IsOfSolidsOnly) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    const auto unites = [](const TriangleMesh& mesh) {
        return remesh::detail::unite_solids(mesh, 1).has_value();
    };
    EXPECT_TRUE(unites(shapes::cube()));
    EXPECT_FALSE(unites(shapes::join(shapes::cube(), shapes::grid(2))));
    // A sheet with two sides.
    TriangleMesh sides = shapes::grid(1);
    std::vector<agvd::Triangle> back = sides.triangles;
    for (agvd::Triangle& t : back) std::swap(t[1], t[2]);
    sides.triangles.insert(sides.triangles.end(), back.begin(), back.end());
    EXPECT_FALSE(unites(sides));
    // A ball one of whose vertices is on the other side of it.
    TriangleMesh ball = shapes::sphere(2);
    ball.positions[0] *= -2;
    EXPECT_FALSE(unites(ball));
    // Two cubes with an edge in common: four faces would meet there.
    EXPECT_FALSE(unites(shapes::join(shapes::cube(), box({1, 1, 0}, {2, 2, 1}))));
}

TEST(Wrap, SolidsWithoutGapsAreUnited) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    const RemeshResult result = remesh::remesh(crossing_boxes(), {.num_samples = 300, .wrap = 0});
    expect_solid(result.mesh, 1);
    EXPECT_EQ(result.wrapped.radius, 0);
    EXPECT_GT(result.wrapped.faces, 24u);
    EXPECT_NEAR(shapes::signed_volume(result.mesh), 1.455, 1e-3);
    // What a wrap closes stays apart in a union.
    const auto two_boxes = [](double gap) {
        return shapes::join(shapes::cube(), box({1 + gap, 0, 0}, {2, 1, 1}));
    };
    const RemeshResult near = remesh::remesh(two_boxes(0.01), {.num_samples = 300, .wrap = 0});
    EXPECT_GT(near.wrapped.radius, 0);
    expect_solid(near.mesh, 1);
    const RemeshResult far = remesh::remesh(two_boxes(0.1), {.num_samples = 300, .wrap = 0});
    EXPECT_EQ(far.wrapped.radius, 0);
    expect_solid(far.mesh, 2);
    // A radius asks for a wrap.
    EXPECT_EQ(remesh::remesh(two_boxes(0.1), {.num_samples = 300, .wrap = 0.06}).wrapped.radius,
              0.06);
}

TEST(Wrap, CreasesGiveWayWhereFacesAreNarrow) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    const RemeshResult result =
        remesh::remesh(shapes::dirty_solids(6), {.num_samples = 400, .wrap = 0});
    EXPECT_GT(result.features.freed_length, 0);
    EXPECT_LT(result.features.freed_length, 0.2 * result.features.length);
    EXPECT_GT(result.verdict.min_angle, 30 * degree);
    // Not if the caller marks faces.
    const TriangleMesh soup = shapes::dirty_solids(6);
    const RemeshResult labelled =
        remesh::remesh(soup, {.num_samples = 400,
                              .wrap = 0,
                              .face_labels = std::vector<Index>(soup.triangles.size(), 1)});
    EXPECT_EQ(labelled.features.freed_length, 0);
}

TEST(RelaxGuarded, GivesBetterTrianglesOnTheSurface) {
    const TriangleMesh surface = shapes::sphere(3);
    const agvd::ClosestPointTree tree(surface);
    TriangleMesh mesh = shapes::jitter(surface, 0.055, 1);
    for (Vec3& p : mesh.positions) p = tree.query(p).position;
    EXPECT_LT(remesh::measure_triangles(mesh).min_angle, 10 * degree);
    remesh::detail::GuardedMesh guarded(mesh);
    const auto moved = remesh::detail::relax_guarded(guarded, surface, {});
    const TriangleMesh after{guarded->positions(), guarded->triangles()};
    EXPECT_GT(remesh::measure_triangles(after).min_angle, 30 * degree);
    expect_solid(after, 1);
    std::size_t num_moved = 0;
    for (Index v = 0; v < moved.size(); ++v) {
        num_moved += moved[v] ? 1 : 0;
        EXPECT_EQ(moved[v] ? agvd::position(surface.view(), *moved[v]) : mesh.positions[v],
                  after.positions[v]);
    }
    EXPECT_GT(num_moved, 100u);
}

TEST(Wrap, ASheetGetsTwoSides) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    const double radius = 0.1;
    const FittedWrap wrap = wrapped(shapes::grid(2), radius);
    expect_solid(wrap.mesh, 1);
    EXPECT_GT(wrap.sheets, 0.99);
    EXPECT_NEAR(shapes::signed_volume(wrap.mesh), remesh::detail::wrap_offset * radius, 0.004);
}

TEST(Wrap, HolesWellBelowTwoRadiiAreClosed) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    // A cube whose side z = 0 has a square hole of .3.
    TriangleMesh cube = shapes::cube();
    std::erase_if(cube.triangles, [&](const agvd::Triangle& t) {
        return cube.positions[t[0]].z() + cube.positions[t[1]].z() + cube.positions[t[2]].z() == 0;
    });
    const TriangleMesh frame = shapes::join(
        shapes::join(box({0, 0, 0}, {0.35, 1, 0.01}), box({0.65, 0, 0}, {1, 1, 0.01})),
        shapes::join(box({0, 0, 0}, {1, 0.35, 0.01}), box({0, 0.65, 0}, {1, 1, 0.01})));
    const TriangleMesh holed = shapes::join(cube, frame);
    EXPECT_NEAR(shapes::signed_volume(wrapped(holed, 0.19).mesh), 1, 0.02);
    EXPECT_LT(shapes::signed_volume(wrapped(holed, 0.13).mesh), 0.5);
}

TEST(Wrap, ARunGivesOneSolidOfASoupWithLabelsOfItsOuterFaces) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    // A sphere of loose triangles with gaps, around another one.
    const TriangleMesh ball = shapes::sphere(3);
    TriangleMesh inner = ball;
    for (Vec3& p : inner.positions) p *= 0.6;
    const TriangleMesh soup = shapes::join(shapes::jitter(shapes::unweld(ball), 1e-3, 1), inner);
    const auto num_outer = static_cast<Index>(ball.triangles.size());
    const RemeshResult result = remesh::remesh(soup, {.num_samples = 200, .wrap = 0});
    expect_solid(result.mesh, 1);
    EXPECT_EQ(result.mesh.positions.size(), 200u);
    EXPECT_NEAR(result.wrapped.radius, std::sqrt(4 * std::acos(-1) / 200) / 2, 0.04);
    for (Index v = 0; v < result.sites.size(); ++v) {
        EXPECT_LT(result.sites[v].face.value(), num_outer);
        EXPECT_NEAR(result.mesh.positions[v].norm(), 1, 0.02);
    }
    EXPECT_EQ(result.self_intersections, 0u);
}

TEST(Wrap, NoResultCrossesItselfHoweverFewItsVertices) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    // Crossed rods and a folded sheet, all thinner than the edges.
    TriangleMesh lattice = shapes::jitter(shapes::grid(4), 0.2, 3);
    for (int i = 0; i < 4; ++i) {
        const double at = 0.3 * i;
        lattice = shapes::join(lattice, box({at, -0.1, -0.5}, {at + 0.03, 1.1, -0.47}));
        lattice = shapes::join(lattice, box({-0.1, at, -0.48}, {1.1, at + 0.03, -0.45}));
    }
    for (const Index num_samples : {150, 400}) {
        const RemeshResult result =
            remesh::remesh(lattice, {.num_samples = num_samples, .wrap = 0});
        expect_solid(result.mesh, agvd::analyze_topology(result.mesh).components.size());
        EXPECT_EQ(result.mesh.positions.size(), num_samples);
        EXPECT_EQ(result.self_intersections, 0u);
    }
}

TEST(Wrap, AnySoupBecomesSolids) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    const std::uint64_t num_seeds = std::getenv("AGVD_LONG") != nullptr ? 1000 : 12;
    for (std::uint64_t seed = 1; seed <= num_seeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const TriangleMesh soup = shapes::dirty_solids(seed);
        const RemeshResult result = remesh::remesh(soup, {.num_samples = 400, .wrap = 0});
        expect_solid(result.mesh, agvd::analyze_topology(result.mesh).components.size());
        // Vertices lie on the soup, or as far from it as its holes are wide.
        const agvd::ClosestPointTree tree(soup);
        for (const Vec3& p : result.mesh.positions) {
            EXPECT_TRUE(
                tree.is_within(p, std::max(3 * result.wrapped.radius, result.verdict.spacing)));
        }
    }
}

// Creases of a wrap are too close as if the spacing were twice what it is.
TEST(Wrap, LengthsThatHardlyDifferKeepNoMoreCreases) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    const TriangleMesh plate = parts::box({4, 3, 0.12}, 8);
    RemeshOptions options{.num_samples = 400, .wrap = 0.1};
    const double length = remesh::remesh(plate, options).features.length;
    EXPECT_NEAR(length, 14, 1);  // One rim.
    std::vector<double> lengths(plate.positions.size(), 1);
    lengths.front() = 0.999;
    options.sizing.edges = remesh::VertexLengths{lengths};
    EXPECT_NEAR(remesh::remesh(plate, options).features.length, length, 0.1);
}

TEST(Wrap, ScalesWithTheMesh) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    const double scale = std::ldexp(1.0, 100);
    TriangleMesh large = crossing_boxes();
    for (Vec3& p : large.positions) p *= scale;
    const RemeshResult result =
        remesh::remesh(large, {.num_samples = 100, .wrap = 0.15 * scale, .relax_steps = 1});
    EXPECT_EQ(result.wrapped.radius, 0.15 * scale);
    EXPECT_NEAR(shapes::signed_volume(result.mesh) / std::pow(scale, 3), 1.455, 0.05);
}

TEST(Wrap, OptionsThatNameElementsOfTheMeshAreRefused) {
    const TriangleMesh cube = shapes::cube();
    EXPECT_NE(refusal_of(cube, {.wrap = -1}).find("wrap is -1"), std::string::npos);
    EXPECT_NE(refusal_of(cube, {.wrap = 0, .locked = {0}}).find("locked"), std::string::npos);
    EXPECT_NE(refusal_of(cube, {.wrap = 0, .feature_edges = {{0, 1}}}).find("feature_edges"),
              std::string::npos);
    RemeshOptions near{.wrap = 0};
    near.sizing = {.edges = remesh::AdaptiveEdges{}, .count = remesh::MaxDistance{0.1}};
    EXPECT_NE(refusal_of(cube, near).find("MaxDistance"), std::string::npos);
}
