#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "agvd/core/error.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/topology.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "remesh/wrap/wrap.h"
#include "support/dirty_shapes.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::RemeshOptions;
using remesh::RemeshResult;
using remesh::detail::FittedWrap;

namespace {

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
    EXPECT_EQ(remesh::find_self_intersections(mesh)->size(), 0u);
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

TEST(Wrap, ASheetGetsTwoSides) {
    if (!can_wrap()) GTEST_SKIP() << "needs CGAL";
    const double radius = 0.1;
    const FittedWrap wrap = wrapped(shapes::grid(2), radius);
    expect_solid(wrap.mesh, 1);
    EXPECT_GT(wrap.sheets, 0.99);
    EXPECT_NEAR(shapes::signed_volume(wrap.mesh), remesh::detail::wrap_offset * radius, 0.004);
}

TEST(Wrap, HolesBelowTwoRadiiAreClosed) {
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
    EXPECT_NEAR(shapes::signed_volume(wrapped(holed, 0.17).mesh), 1, 0.02);
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
            EXPECT_TRUE(tree.is_within(p, 3 * result.wrapped.radius));
        }
    }
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
