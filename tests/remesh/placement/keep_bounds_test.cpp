// Triangles that exceed bounds are edited until they keep them; the others stay in shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agvd/mesh/topology.h"
#include "remesh/placement/placement.h"
#include "remesh/placement/shape_quality.h"
#include "remesh/quality/evaluate.h"
#include "support/movable_mesh.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::ShapeBounds;

namespace {

struct Shape {
    double min_angle = 180, max_angle = 0, longest_edge = 0;
};

Shape shape_of(const TriangleMesh& mesh) {
    Shape shape;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const auto corners = corners_of(mesh.view(), f);
        const auto [least, most] = std::ranges::minmax(remesh::measure_face(corners).angle);
        shape.min_angle = std::min(shape.min_angle, least / degree);
        shape.max_angle = std::max(shape.max_angle, most / degree);
        shape.longest_edge = std::max(shape.longest_edge, remesh::detail::longest_edge_of(corners));
    }
    return shape;
}

// \param[out] mesh  what it made of it.
bool keep(const MovableMesh& start, const ShapeBounds& bounds, double most_share,
          TriangleMesh& mesh) {
    remesh::PlacedMesh placed = start.placed;
    const bool is_changed =
        !remesh::keep_bounds(start.curves(), start.mobility, bounds, most_share, placed).empty();
    mesh = start.mesh_of(placed);
    const Topology topology = analyze_topology(mesh.view());
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    EXPECT_EQ(topology.genus(), 0);
    return is_changed;
}

TEST(KeepBounds, AnglesComeWithinAndOthersStayInShape) {
    int num_tried = 0;
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
        const MovableMesh start(shapes::jitter(shapes::sphere(3), 0.03, seed));
        const Shape before = shape_of(start.surface.mesh);
        ASSERT_GT(before.max_angle, 92) << seed;
        TriangleMesh mesh;
        EXPECT_TRUE(keep(start, {.max_angle = 90}, 1, mesh));
        EXPECT_LE(shape_of(mesh).max_angle, 90) << seed;
        EXPECT_GE(shape_of(mesh).min_angle, std::min(before.min_angle, 29.0)) << seed;
        EXPECT_EQ(mesh.positions.size(), start.placed.points.size());
        // All are within these.
        EXPECT_FALSE(keep(start, {.min_angle = 5, .max_angle = 170}, 1, mesh));
        EXPECT_EQ(mesh.triangles, start.placed.triangles);
        // More than a hundredth exceed those: the mesh stays.
        EXPECT_FALSE(keep(start, {.max_angle = 90}, 0.01, mesh));
        EXPECT_EQ(mesh.triangles, start.placed.triangles);
        ++num_tried;
    }
    EXPECT_EQ(num_tried, 4);
}

// Slivers whose corners stay cannot be repaired. What is tried there makes no others.
TEST(KeepBounds, WhatCannotBeKeptSpreadsNot) {
    const auto count = [](const TriangleMesh& mesh, double least_angle) {
        int found = 0;
        for (Index f = 0; f < mesh.triangles.size(); ++f) {
            const auto angles = remesh::measure_face(corners_of(mesh.view(), f)).angle;
            found += std::ranges::min(angles) < least_angle * degree ? 1 : 0;
        }
        return found;
    };
    int num_tried = 0;
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
        MovableMesh start(shapes::jitter(shapes::sphere(3), 0.07, seed));
        for (Index v = 0; v < start.mobility.size(); ++v) {
            if (start.surface.mesh.positions[v].z() > 0.3 && v % 3 != 0) {
                start.mobility[v] = remesh::detail::Mobility::Fixed;
            }
        }
        TriangleMesh mesh;
        const TriangleMesh& before = start.surface.mesh;
        EXPECT_TRUE(keep(start, {.min_angle = 20, .max_angle = 120}, 1, mesh));
        EXPECT_LT(count(mesh, 20), count(before, 20)) << seed;
        EXPECT_LE(count(mesh, 29), count(before, 29)) << seed;
        num_tried += count(mesh, 20) > 0 ? 1 : 0;
    }
    EXPECT_GE(num_tried, 3);
}

TEST(KeepBounds, ALongestEdgeAddsVertices) {
    const MovableMesh start(shapes::sphere(3));
    const double longest = shape_of(start.surface.mesh).longest_edge;
    TriangleMesh mesh;
    EXPECT_TRUE(keep(start, {.min_angle = 25, .longest_edge = 0.95 * longest}, 1, mesh));
    EXPECT_LE(shape_of(mesh).longest_edge, 0.95 * longest);
    EXPECT_GE(shape_of(mesh).min_angle, 25);
    EXPECT_GT(mesh.positions.size(), start.placed.points.size());
    EXPECT_LT(mesh.positions.size(), 1.6 * static_cast<double>(start.placed.points.size()));
}

}  // namespace
