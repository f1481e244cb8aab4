// Large results are made in tiles; what holds for results in one piece holds for them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agvd/core/error.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/topology.h"
#include "remesh/pipeline/remesh.h"
#include "support/crease_checks.h"
#include "support/junction_shapes.h"
#include "support/random_surfaces.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::RemeshOptions;
using remesh::RemeshResult;

namespace {

RemeshOptions with_samples(Index count) {
    RemeshOptions options;
    options.num_samples = count;
    options.samples_per_tile = 600;
    return options;
}

double mean_quality(const TriangleMesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 u = mesh.positions[b] - mesh.positions[a],
                   v = mesh.positions[c] - mesh.positions[a], w = v - u;
        const double longest = std::max({u.norm(), v.norm(), w.norm()});
        sum +=
            2 * std::sqrt(3.0) * u.cross(v).norm() / ((u.norm() + v.norm() + w.norm()) * longest);
    }
    return sum / static_cast<double>(mesh.triangles.size());
}

TEST(Tiles, KeepTopologyAndCount) {
    const std::vector<TriangleMesh> meshes{
        shapes::sphere(4), shapes::torus(60, 30), shapes::tube(60, 30), shapes::cube(),
        shapes::join(shapes::sphere(4), shapes::moved(shapes::torus(40, 20), {4, 0, 0}))};
    for (const TriangleMesh& mesh : meshes) {
        SCOPED_TRACE(mesh.triangles.size());
        const RemeshResult result = remesh::remesh(mesh.view(), with_samples(2000));
        EXPECT_GE(result.tiles, 4u);
        EXPECT_EQ(result.mesh.positions.size(), 2000u);
        EXPECT_EQ(result.sites.size(), 2000u);
        EXPECT_TRUE(agvd::same_topology(agvd::analyze_topology(result.mesh.view()),
                                        agvd::analyze_topology(mesh.view())));
        EXPECT_EQ(result.self_intersections.value_or(0), 0u);
        EXPECT_EQ(result.verdict.faces_without_area, 0u);
        EXPECT_GT(result.verdict.min_angle, 25 * agvd::degree);
    }
}

TEST(Tiles, KeepTheTopologyOfRandomSurfaces) {
    int num_tried = 0, num_tiled = 0;
    for (const char* family : random_surfaces::families()) {
        SCOPED_TRACE(family);
        const TriangleMesh mesh = random_surfaces::make(family, 1);
        const RemeshResult result = remesh::remesh(mesh.view(), with_samples(800));
        EXPECT_EQ(result.mesh.positions.size(), 800u);
        EXPECT_TRUE(
            agvd::same_topology(agvd::analyze_topology(result.mesh.view()), result.input_topology));
        ++num_tried;
        num_tiled += result.tiles > 0 ? 1 : 0;
    }
    EXPECT_EQ(num_tried, static_cast<int>(random_surfaces::families().size()));
    EXPECT_GE(num_tiled, num_tried - 2);
}

TEST(Tiles, LeaveNoTrace) {
    for (const TriangleMesh& mesh : {shapes::sphere(5), shapes::torus(80, 40)}) {
        RemeshOptions whole = with_samples(4000);
        whole.samples_per_tile = 0;
        const RemeshResult one = remesh::remesh(mesh.view(), whole),
                           tiled = remesh::remesh(mesh.view(), with_samples(4000));
        EXPECT_EQ(one.tiles, 0u);
        EXPECT_EQ(tiled.tiles, 7u);
        EXPECT_GT(mean_quality(tiled.mesh), mean_quality(one.mesh) - 0.012);
        EXPECT_GT(tiled.verdict.min_angle, one.verdict.min_angle - 5 * agvd::degree);
        EXPECT_NEAR(shapes::signed_volume(tiled.mesh), shapes::signed_volume(one.mesh), 1e-4);
        EXPECT_LT(tiled.verdict.largest_distance, 2 * one.verdict.largest_distance);
    }
}

// A drum: its top and bottom are fans of needles, its wall has triangles that are as high as it.
TriangleMesh drum(Index num_sides) {
    TriangleMesh mesh;
    for (const double z : {0.0, 0.3}) {
        for (Index i = 0; i < num_sides; ++i) {
            const double turn = 2 * std::numbers::pi * i / num_sides;
            mesh.positions.emplace_back(std::cos(turn), std::sin(turn), z);
        }
    }
    for (Index i = 0; i < num_sides; ++i) {
        const Index next = (i + 1) % num_sides;
        mesh.triangles.push_back({i, next, num_sides + next});
        mesh.triangles.push_back({i, num_sides + next, num_sides + i});
        if (i == 0 || next == 0) continue;
        mesh.triangles.push_back({0, next, i});
        mesh.triangles.push_back({num_sides, num_sides + i, num_sides + next});
    }
    return mesh;
}

// Most of the needles near a border hold no vertex, and none of their corners is near.
TEST(Tiles, LeaveNoTraceOnNeedles) {
    const TriangleMesh mesh = drum(300);
    RemeshOptions whole = with_samples(4000);
    whole.samples_per_tile = 0;
    const RemeshResult one = remesh::remesh(mesh.view(), whole),
                       tiled = remesh::remesh(mesh.view(), with_samples(4000));
    EXPECT_EQ(tiled.tiles, 7u);
    EXPECT_GT(mean_quality(tiled.mesh), mean_quality(one.mesh) - 0.012);
    EXPECT_GT(tiled.verdict.min_angle, one.verdict.min_angle - 4 * agvd::degree);
    EXPECT_LT(tiled.verdict.largest_distance, 2 * one.verdict.largest_distance);
}

TEST(Tiles, SameBytesForAnyNumberOfThreads) {
    RemeshOptions options = with_samples(3000);
    options.num_threads = 1;
    const RemeshResult one = remesh::remesh(shapes::torus(60, 30).view(), options);
    options.num_threads = 3;
    const RemeshResult three = remesh::remesh(shapes::torus(60, 30).view(), options);
    EXPECT_GT(one.tiles, 4u);
    EXPECT_EQ(one.mesh.positions, three.mesh.positions);
    EXPECT_EQ(one.mesh.triangles, three.mesh.triangles);
    EXPECT_EQ(one.sites, three.sites);
}

TEST(Tiles, VerticesLieNearTheirSitesOnTheInput) {
    const TriangleMesh mesh = shapes::torus(60, 30);
    RemeshOptions options = with_samples(2000);
    options.fit = false;
    const RemeshResult result = remesh::remesh(mesh.view(), options);
    EXPECT_GE(result.tiles, 4u);
    for (Index v = 0; v < result.sites.size(); ++v) {
        EXPECT_LT((position(mesh.view(), result.sites[v]) - result.mesh.positions[v]).norm(),
                  1e-14);
    }
}

TEST(Tiles, CreasesRunThroughBorders) {
    const TriangleMesh cube = shapes::cube();
    const RemeshResult result = remesh::remesh(cube.view(), with_samples(3000));
    EXPECT_GE(result.tiles, 5u);
    EXPECT_EQ(result.features.curves, 12u);
    EXPECT_NEAR(result.features.length, 12, 1e-12);
    EXPECT_GT(crease_checks::coverage(cube, result.mesh, 1e-9), 0.999);
    EXPECT_LT(crease_checks::farthest_from_surface(result.mesh, cube), 1e-12);
    EXPECT_LT(crease_checks::farthest_from_vertices(cube.positions, result.mesh), 1e-12);
}

TEST(Tiles, BoundaryVerticesLieOnTheBoundary) {
    const TriangleMesh open = shapes::tube(60, 30);
    const RemeshResult result = remesh::remesh(open.view(), with_samples(2000));
    EXPECT_GE(result.tiles, 4u);
    int count = 0;
    const agvd::Surface surface = agvd::build_surface(result.mesh.view());
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (!surface.is_boundary_vertex(v)) continue;
        EXPECT_NEAR(std::abs(result.mesh.positions[v].z() - 1), 1, 1e-12);
        ++count;
    }
    EXPECT_GT(count, 100);
}

// Of all that excludes tiles one at a time.
TEST(Tiles, AreNotMadeWhereTheyWouldBreakPromises) {
    const TriangleMesh mesh = shapes::sphere(4);
    RemeshOptions few = with_samples(600), sampled = with_samples(800), adaptive = sampled,
                  locked = sampled, free = sampled, one = sampled;
    sampled.relax_steps = 0;
    adaptive.sizing.edges = remesh::AdaptiveEdges{};
    locked.locked = {5};
    free.boundary = remesh::Boundary::Free;
    one.samples_per_tile = 0;
    int count = 0;
    for (const RemeshOptions& options : {few, sampled, adaptive, locked, free, one}) {
        EXPECT_EQ(remesh::remesh(mesh.view(), options).tiles, 0u) << count;
        ++count;
    }
    EXPECT_EQ(count, 6);
    EXPECT_EQ(remesh::remesh(shapes::round_pipe_on_plate(12).view(), with_samples(800)).tiles, 0u);
    EXPECT_GT(remesh::remesh(mesh.view(), with_samples(751)).tiles, 1u);
}

TEST(Tiles, SizesThatAreTooSmallAreRefused) {
    RemeshOptions options = with_samples(2000);
    options.samples_per_tile = 499;
    try {
        (void)remesh::remesh(shapes::sphere(3).view(), options);
        FAIL();
    } catch (const agvd::InvalidOption& error) {
        EXPECT_STREQ(error.what(), "samples_per_tile is 499; use 0, for one piece, or 500 or more");
    }
}

// So that a time left that follows from it does not grow.
TEST(Tiles, TellHowFarTheyAreWithinThem) {
    const TriangleMesh mesh = shapes::torus(60, 30);
    RemeshOptions options = with_samples(2000);
    options.num_threads = 1;
    std::vector<double> of_tiles, of_all;
    options.progress = [&](remesh::Stage stage, double fraction) {
        if (stage == remesh::Stage::Relax) of_tiles.push_back(fraction);
        of_all.push_back(remesh::overall_fraction(stage, fraction, mesh.triangles.size(), options));
        return true;
    };
    const RemeshResult result = remesh::remesh(mesh.view(), options);
    ASSERT_GT(result.tiles, 2);
    for (std::vector<double>* fractions : {&of_tiles, &of_all}) {
        EXPECT_TRUE(std::ranges::is_sorted(*fractions));
        EXPECT_GE(fractions->front(), 0);
        EXPECT_LE(fractions->back(), 1);
        for (std::size_t i = 1; i < fractions->size(); ++i) {
            EXPECT_LT((*fractions)[i] - (*fractions)[i - 1], 0.2);
        }
        EXPECT_GT(agvd::distinct(*fractions).size(), 10U * result.tiles);
    }
}

TEST(Tiles, StopWhenAskedTo) {
    for (const int after : {1, 40, 300}) {
        RemeshOptions options = with_samples(2000);
        options.num_threads = 2;
        int left = after;
        options.progress = [&](remesh::Stage, double) { return left-- > 0; };
        EXPECT_THROW((void)remesh::remesh(shapes::torus(60, 30).view(), options), agvd::Cancelled);
    }
}

}  // namespace
