// Results that keep a distance, and the proof that they do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "agvd/core/error.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/meet_distance.h"
#include "remesh/pipeline/remesh.h"
#include "support/crease_checks.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::RemeshOptions;
using remesh::RemeshResult;
using remesh::detail::MeasuredDistance;

namespace {

RemeshResult remeshed(const TriangleMesh& mesh, double distance, int threads = 1) {
    return remesh::remesh(
        mesh.view(), {.sizing = {.count = remesh::MaxDistance{distance}}, .num_threads = threads});
}

MeasuredDistance measure(const TriangleMesh& input, const TriangleMesh& result, double limit,
                         std::span<const double> targets = {}) {
    const agvd::ClosestPointTree tree(input.view());
    return remesh::detail::measure_distance(input, tree, result, targets, limit);
}

// A plate of two triangles, 2 x 2, that is 1 deep along its middle if it is a valley.
TriangleMesh plate(bool is_valley) {
    const double z = is_valley ? -1 : 0;
    return {{{-1, -1, 0}, {0, -1, z}, {1, -1, 0}, {-1, 1, 0}, {0, 1, z}, {1, 1, 0}},
            {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}};
}

// A plate, 200 x 200 x 10, with a peg in its middle, 4 x 4 x 6: 28 triangles.
TriangleMesh plate_with_peg() {
    TriangleMesh mesh;
    const auto add_square = [&](double half, double z) {
        for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
            mesh.positions.emplace_back(half * x, half * y, z);
        }
    };
    add_square(100, 0);
    add_square(100, 10);
    add_square(2, 10);
    add_square(2, 16);
    for (Index square = 0; square < 12; square += 4) {
        for (Index k = 0; k < 4; ++k) {
            const Index a = square + k, b = square + (k + 1) % 4;
            mesh.triangles.push_back({a, b, b + 4});
            mesh.triangles.push_back({a, b + 4, a + 4});
        }
    }
    for (const agvd::Triangle& t : {agvd::Triangle{0, 2, 1}, {0, 3, 2}, {12, 13, 14}, {12, 14, 15}})
        mesh.triangles.push_back(t);
    return mesh;
}

}  // namespace

TEST(MaxDistance, IsKeptBothWaysWithFewVertices) {
    const TriangleMesh input = shapes::torus(120, 60);
    Index before = 0;
    for (const double limit : {0.04, 0.012, 0.005}) {
        SCOPED_TRACE(limit);
        const RemeshResult result = remeshed(input, limit);
        EXPECT_LE(crease_checks::farthest_from_surface(input, result.mesh), limit);
        EXPECT_LE(crease_checks::farthest_from_surface(result.mesh, input), limit);
        EXPECT_LE(result.sizing.largest_distance, limit);
        EXPECT_GT(result.sizing.largest_distance, limit / 4);
        const auto num_vertices = static_cast<Index>(result.mesh.positions.size());
        EXPECT_GT(num_vertices, before);
        // An edge of length h on the tube of radius .35 is h^2 / (8 * .35) deep.
        EXPECT_LT(num_vertices, 40 / limit);
        before = num_vertices;
    }
}

TEST(MaxDistance, OfAnyScaleAndThreadsIsTheSame) {
    const TriangleMesh input = shapes::torus(60, 30);
    const RemeshResult one = remeshed(input, 0.02);
    const RemeshResult four = remeshed(input, 0.02, 4);
    EXPECT_EQ(one.mesh.positions, four.mesh.positions);
    TriangleMesh huge = input;
    for (Vec3& p : huge.positions) p *= std::ldexp(1.0, 100);
    const RemeshResult scaled = remeshed(huge, std::ldexp(0.02, 100));
    EXPECT_EQ(scaled.mesh.triangles, one.mesh.triangles);
    EXPECT_EQ(scaled.sizing.largest_distance, std::ldexp(one.sizing.largest_distance, 100));
}

// The peg is missed at first. The plate's faces are as large as the plate: its corners tell
// nothing.
TEST(MaxDistance, AMissedPieceGetsVerticesInItsPlaceAlone) {
    const TriangleMesh input = plate_with_peg();
    const RemeshResult result = remeshed(input, 1);
    EXPECT_LE(crease_checks::farthest_from_surface(input, result.mesh), 1);
    EXPECT_LE(crease_checks::farthest_from_surface(result.mesh, input), 1);
    EXPECT_LT(result.mesh.positions.size(), 300u);
}

// Without creases the edges of the plate are far here and there, between all points looked at: the
// proof finds them one after the other.
TEST(MaxDistance, FacesAreRepairedUntilTheProofFindsNoMore) {
    const TriangleMesh input = plate_with_peg();
    const RemeshResult result =
        remesh::remesh(input.view(), {.sizing = {.count = remesh::MaxDistance{0.5}},
                                      .features = remesh::Features::Off,
                                      .num_threads = 1});
    EXPECT_LE(crease_checks::farthest_from_surface(input, result.mesh), 0.5);
    EXPECT_LE(crease_checks::farthest_from_surface(result.mesh, input), 0.5);
    EXPECT_LE(result.sizing.largest_distance, 0.5);
    EXPECT_LT(result.mesh.positions.size(), 2600u);
}

TEST(MaxDistance, TooManyVerticesAreRefused) {
    EXPECT_THROW((void)remesh::remesh(shapes::sphere(2).view(),
                                      {.sizing = {.count = remesh::MaxDistance{1e-12}},
                                       .features = remesh::Features::Off}),
                 agvd::InvalidOption);
    EXPECT_THROW((void)remeshed(shapes::sphere(2), -1), agvd::InvalidOption);
    RemeshOptions with_lengths{.sizing = {.count = remesh::MaxDistance{0.1}}};
    with_lengths.sizing.edges =
        remesh::VertexLengths{std::vector(shapes::sphere(2).positions.size(), 0.1)};
    EXPECT_THROW((void)remesh::remesh(shapes::sphere(2).view(), with_lengths), agvd::InvalidOption);
}

// A closed cylinder of n flat sides, their edges divided, in the middle of its caps a vertex.
TriangleMesh faceted_cylinder(Index n, Index rows) {
    TriangleMesh mesh;
    for (Index row = 0; row <= rows; ++row) {
        for (Index i = 0; i < n; ++i) {
            const double turn = 2 * std::numbers::pi * i / n;
            mesh.positions.emplace_back(std::cos(turn), std::sin(turn), 3.0 * row / rows);
        }
    }
    mesh.positions.emplace_back(0, 0, 0);
    mesh.positions.emplace_back(0, 0, 3);
    const Index top = rows * n, low = top + n, high = low + 1;
    for (Index i = 0; i < n; ++i) {
        const Index next = (i + 1) % n;
        for (Index a = 0; a < top; a += n) {
            mesh.triangles.push_back({a + i, a + next, a + n + next});
            mesh.triangles.push_back({a + i, a + n + next, a + n + i});
        }
        mesh.triangles.push_back({low, next, i});
        mesh.triangles.push_back({high, top + i, top + next});
    }
    return mesh;
}

// A distance far below what edges of 5.6 degrees hide, and one of half of that: all vertices of the
// outline are needed, and no others, however the sides are divided.
TEST(MaxDistance, EdgesOfFacetsAreKeptWhereTheDistanceNeedsThem) {
    const Index n = 64;
    const double hidden = std::pow(std::numbers::pi / n, 2) / 2;
    for (const Index rows : {1u, 20u}) {
        const TriangleMesh input = faceted_cylinder(n, rows);
        for (const double limit : {hidden / 2, hidden / 100}) {
            SCOPED_TRACE(std::to_string(rows) + " rows, " + std::to_string(limit));
            const RemeshResult result = remeshed(input, limit);
            EXPECT_EQ(result.mesh.positions.size(), 2 * n);
            EXPECT_LE(crease_checks::farthest_from_surface(input, result.mesh), 1e-9);
        }
    }
}

// Curvature alone would ask for one vertex or two.
TEST(MaxDistance, FlatPartsGetWhatTopologyAndCurvesNeed) {
    TriangleMesh roof = shapes::grid(8);
    for (Vec3& p : roof.positions) p.z() = 0.5 - std::abs(p.x() - 0.5);
    TriangleMesh open_box = shapes::cube();
    std::erase_if(open_box.triangles, [&](const agvd::Triangle& t) {
        return std::ranges::all_of(t, [&](Index v) { return open_box.positions[v].z() == 1; });
    });
    // A wall in the middle of a box that is twice as long: all meet in four junctions.
    TriangleMesh rooms = shapes::cube();
    const TriangleMesh cube = rooms;
    for (const agvd::Triangle& t : cube.triangles) {
        const auto is_at = [&](double x) {
            return std::ranges::all_of(t, [&](Index v) { return cube.positions[v].x() == x; });
        };
        if (is_at(0)) continue;
        agvd::Triangle beyond;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = cube.positions[t[k]] + Vec3(1, 0, 0);
            beyond[k] =
                static_cast<Index>(std::ranges::find(rooms.positions, p) - rooms.positions.begin());
            if (beyond[k] == rooms.positions.size()) rooms.positions.push_back(p);
        }
        rooms.triangles.push_back(beyond);
    }
    for (const auto& [mesh, count] :
         {std::pair{shapes::grid(8), 4u}, {roof, 6u}, {open_box, 8u}, {rooms, 12u}}) {
        SCOPED_TRACE(count);
        const RemeshResult result = remeshed(mesh, 0.02);
        EXPECT_EQ(result.mesh.positions.size(), count);
        EXPECT_LE(crease_checks::farthest_from_surface(mesh, result.mesh), 1e-9);
    }
    const RemeshResult welded =
        remesh::remesh(rooms.view(), {.sizing = {.count = remesh::MaxDistance{0.02}},
                                      .junctions = remesh::Junctions::Keep,
                                      .num_threads = 1});
    EXPECT_EQ(welded.junctions.apart_edges, 0u);
    EXPECT_LE(welded.mesh.positions.size(), 16u);
}

TEST(MeasureDistance, EqualSurfacesAreProvedWhateverTheirTriangles) {
    const auto found = measure(shapes::grid(7), shapes::grid(4), 1e-3);
    EXPECT_TRUE(found.is_within);
    EXPECT_LT(found.largest, 1e-12);
    EXPECT_TRUE(found.lengths.empty());
}

TEST(MeasureDistance, WhereItIsTooFarEdgesGetShorter) {
    const TriangleMesh input = plate(true), result = plate(false);
    const auto found = measure(input, result, 0.5);
    EXPECT_FALSE(found.is_within);
    EXPECT_DOUBLE_EQ(found.largest, 1);
    EXPECT_NEAR(found.where.z(), -1, 1e-12);
    ASSERT_GT(found.lengths.size(), 1000u);
    double nearest_to_rim = 1;
    for (const remesh::SizedPoint& point : found.lengths) {
        const Vec3 at = agvd::position(input.view(), point.at);
        nearest_to_rim = std::min(nearest_to_rim, 1 - std::abs(at.x()));
        // Edges of the result are 1 to 2.3 long, in the mean of a face 1.75.
        EXPECT_NEAR(point.length, 1.75 / 2, 0.01);
    }
    // A point of the plate at a distance of .49 from the slope, at 45 degrees.
    EXPECT_NEAR(nearest_to_rim, 0.49 / std::numbers::sqrt2, 1e-3);
    // Edges that were to be shorter than that get shorter than these.
    const auto again = measure(input, result, 0.5, std::vector(6, 1.));
    ASSERT_EQ(again.lengths.size(), found.lengths.size());
    for (const remesh::SizedPoint& point : again.lengths) EXPECT_EQ(point.length, 0.5);
    // The limit is above all distances.
    EXPECT_TRUE(measure(input, result, 1.1).is_within);
}

// A plate that the result misses by less than an edge.
TEST(MeasureDistance, EdgesGetHalfAsLong) {
    const TriangleMesh input = shapes::grid(4);
    const TriangleMesh result = shapes::moved(shapes::grid(40), {0, 0, 0.01});
    const auto found = measure(input, result, 1e-3);
    ASSERT_GE(found.lengths.size(), 200'000u);
    const double mean_edge = (2 + std::numbers::sqrt2) / 3 / 40;
    for (const remesh::SizedPoint& point : found.lengths) {
        EXPECT_NEAR(point.length, mean_edge / 2, 1e-12);
    }
}

// A piece that the result misses by many edges: long ones reach it.
TEST(MeasureDistance, EdgesGetNoShorterThanHalfTheDistance) {
    const TriangleMesh input = shapes::grid(4);
    const TriangleMesh result = shapes::moved(shapes::grid(40), {0, 0, 2});
    const auto found = measure(input, result, 1e-3);
    ASSERT_GE(found.lengths.size(), 200'000u);
    for (const remesh::SizedPoint& point : found.lengths) EXPECT_NEAR(point.length, 1, 1e-12);
}

// A fin across the valley: its corners lie on the other surface, and no sample meets it.
TEST(MeasureDistance, WhatLiesBetweenTheSamplesIsFoundToo) {
    const TriangleMesh valley = plate(true);
    TriangleMesh with_fin = valley;
    with_fin.positions.emplace_back(1, 0, 0);
    with_fin.positions.emplace_back(-1, 0, 0);
    with_fin.positions.emplace_back(1, 1e-8, 0);
    with_fin.triangles.push_back({6, 7, 8});
    // The fin's middle is 1 / sqrt(2) above the slopes.
    const auto found = measure(with_fin, valley, 0.5);
    EXPECT_FALSE(found.is_within);
    EXPECT_GT(found.largest, 0.49);
    ASSERT_FALSE(found.lengths.empty());
    for (const remesh::SizedPoint& point : found.lengths) {
        EXPECT_EQ(point.at.face.value(), 4u);
        EXPECT_GT(agvd::position(with_fin.view(), point.at).z(), -0.6);
    }
    EXPECT_TRUE(measure(with_fin, valley, 0.75).is_within);
    EXPECT_FALSE(measure(valley, with_fin, 0.5).is_within);
    EXPECT_TRUE(measure(valley, with_fin, 0.75).is_within);
}
