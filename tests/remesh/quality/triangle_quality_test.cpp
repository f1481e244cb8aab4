#include "remesh/quality/evaluate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/shapes.h"

using agvd::TriangleMesh;
using remesh::measure_triangles;
using remesh::TriangleQuality;
using std::numbers::pi;
using std::numbers::sqrt2;
using std::numbers::sqrt3;

TEST(TriangleQuality, EquilateralTriangleIsPerfect) {
    const TriangleMesh mesh{{{0, 0, 5}, {2, 0, 5}, {1, sqrt3, 5}}, {{0, 1, 2}}};
    const TriangleQuality q = measure_triangles(mesh.view());
    EXPECT_NEAR(q.mean_quality, 1, 1e-15);
    EXPECT_NEAR(q.min_quality, 1, 1e-15);
    EXPECT_NEAR(q.min_angle, pi / 3, 1e-15);
    EXPECT_NEAR(q.mean_min_angle, pi / 3, 1e-15);
    EXPECT_NEAR(q.max_angle, pi / 3, 1e-15);
    EXPECT_NEAR(q.edge_length_variation, 0, 1e-15);
    EXPECT_EQ(q.edges, 3u);
    EXPECT_EQ(q.small_angle_share, 0);
}

TEST(TriangleQuality, RightIsoscelesTriangleByFormula) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const TriangleQuality q = measure_triangles(mesh.view());
    EXPECT_NEAR(q.mean_quality, 6 / sqrt3 * 0.5 / ((2 + sqrt2) / 2 * sqrt2), 1e-15);
    EXPECT_NEAR(q.min_angle, pi / 4, 1e-15);
    EXPECT_NEAR(q.max_angle, pi / 2, 1e-15);
    const double mean = (2 + sqrt2) / 3;
    EXPECT_NEAR(q.edge_length_variation, std::sqrt(4 / 3.0 - mean * mean) / mean, 1e-14);
}

TEST(TriangleQuality, MeansAndExtremesOverSeveralTriangles) {
    // Equilateral, and isosceles with 20 degrees at the tip.
    const double tip = pi / 9;
    const TriangleMesh mesh{{{0, 0, 0},
                             {1, 0, 0},
                             {0.5, sqrt3 / 2, 0},
                             {5, 0, 0},
                             {6, 0, 0},
                             {5 + std::cos(tip), std::sin(tip), 0}},
                            {{0, 1, 2}, {3, 4, 5}}};
    const TriangleQuality q = measure_triangles(mesh.view());
    EXPECT_NEAR(q.min_angle, tip, 1e-15);
    EXPECT_NEAR(q.mean_min_angle, (pi / 3 + tip) / 2, 1e-15);
    EXPECT_NEAR(q.max_angle, (pi - tip) / 2, 1e-14);
    EXPECT_EQ(q.small_angle_share, 0.5);
    EXPECT_NEAR(q.mean_quality, (1 + q.min_quality) / 2, 1e-15);
    EXPECT_LT(q.min_quality, 0.6);
}

TEST(TriangleQuality, RegularVerticesHaveSixEdgesOrFourOnTheBoundary) {
    const TriangleMesh sphere = shapes::sphere(2);
    EXPECT_NEAR(measure_triangles(sphere.view()).regular_share, 1 - 12 / 162.0, 1e-15);
    EXPECT_EQ(measure_triangles(shapes::icosahedron().view()).regular_share, 0);
    EXPECT_EQ(measure_triangles(shapes::torus(9, 7).view()).regular_share, 1);
    TriangleMesh grid = shapes::grid(5);
    EXPECT_NEAR(measure_triangles(grid.view()).regular_share, 1 - 4 / 36.0, 1e-15);
    grid.positions.emplace_back(9, 9, 9);
    EXPECT_NEAR(measure_triangles(grid.view()).regular_share, 1 - 4 / 36.0, 1e-15)
        << "a vertex in no face does not count";
}

TEST(TriangleQuality, NonDelaunayEdgesAreThoseWithOpenAngles) {
    EXPECT_EQ(measure_triangles(shapes::cube().view()).non_delaunay_edges, 0u);
    EXPECT_EQ(measure_triangles(shapes::grid(7).view()).non_delaunay_edges, 0u);
    // A rhombus of angles 60 and 120 degrees, cut along its long and its short diagonal.
    TriangleMesh rhombus{{{-sqrt3, 0, 0}, {0, -1, 0}, {sqrt3, 0, 0}, {0, 1, 0}},
                         {{0, 1, 2}, {0, 2, 3}}};
    EXPECT_EQ(measure_triangles(rhombus.view()).non_delaunay_edges, 1u);
    rhombus.positions.emplace_back(0, 0, 1);
    rhombus.triangles.push_back({0, 2, 4});
    EXPECT_EQ(measure_triangles(rhombus.view()).non_delaunay_edges, 0u) << "not asked of 3 faces";
    rhombus.triangles = {{0, 1, 3}, {1, 2, 3}};
    EXPECT_EQ(measure_triangles(rhombus.view()).non_delaunay_edges, 0u);
}

TEST(TriangleQuality, DirtyMeshesHaveFiniteFigures) {
    TriangleMesh mesh = shapes::grid(2);
    mesh.positions.emplace_back(0, 0, 0);
    mesh.positions.emplace_back(0.5, 0.25, 1);
    mesh.triangles.push_back({0, 9, 1});   // Two corners at one place.
    mesh.triangles.push_back({4, 4, 4});   // One corner.
    mesh.triangles.push_back({0, 4, 10});  // A third face at the edge 0-4.
    const TriangleQuality q = measure_triangles(mesh.view());
    EXPECT_EQ(q.faces_without_area, 2u);
    EXPECT_EQ(q.min_quality, 0);
    for (const double figure : {q.mean_quality, q.mean_min_angle, q.min_angle, q.max_angle,
                                q.regular_share, q.edge_length_variation}) {
        EXPECT_TRUE(std::isfinite(figure));
    }
    EXPECT_EQ(measure_triangles({}).edges, 0u);
}

TEST(TriangleQuality, ScaleDoesNotMatter) {
    TriangleMesh mesh = shapes::jitter(shapes::sphere(2), 0.05, 3);
    const TriangleQuality before = measure_triangles(mesh.view());
    for (agvd::Vec3& p : mesh.positions) p *= 1024;
    const TriangleQuality after = measure_triangles(mesh.view());
    EXPECT_EQ(before.mean_quality, after.mean_quality);
    EXPECT_EQ(before.min_angle, after.min_angle);
    EXPECT_EQ(before.edge_length_variation, after.edge_length_variation);
    EXPECT_EQ(before.non_delaunay_edges, after.non_delaunay_edges);
}
