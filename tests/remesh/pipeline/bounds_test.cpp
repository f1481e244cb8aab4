// Angles and edges that all triangles keep, or a refusal that names the worst one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "agvd/core/error.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "support/parts.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::RemeshOptions;
using remesh::RemeshResult;
using remesh::ShapeBounds;

namespace {

struct Extremes {
    double min_angle = 180, max_angle = 0, longest_edge = 0;
};

// Of the faces that are not forced.
Extremes extremes_of(const RemeshResult& result) {
    std::set<Index> forced;
    for (const auto& face : result.forced) forced.insert(face.face);
    Extremes found;
    for (Index f = 0; f < result.mesh.triangles.size(); ++f) {
        const auto corners = agvd::corners_of(result.mesh.view(), f);
        const auto angles = remesh::measure_face(corners).angle;
        for (std::size_t k = 0; k < 3; ++k) {
            found.longest_edge =
                std::max(found.longest_edge, (corners[(k + 1) % 3] - corners[k]).norm());
            if (forced.contains(f)) continue;
            found.min_angle = std::min(found.min_angle, angles[k] / agvd::degree);
            found.max_angle = std::max(found.max_angle, angles[k] / agvd::degree);
        }
    }
    return found;
}

RemeshOptions with(Index samples, const ShapeBounds& bounds, std::uint64_t seed = 1) {
    RemeshOptions options{.num_samples = samples};
    options.bounds = bounds;
    options.seed = seed;
    return options;
}

std::string refusal_of(const TriangleMesh& mesh, const RemeshOptions& options) {
    try {
        (void)remesh::remesh(mesh.view(), options);
    } catch (const agvd::ConstraintUnmet& refused) {
        return refused.what();
    }
    return "";
}

TEST(Bounds, AllAnglesKeepThem) {
    const TriangleMesh mesh = shapes::torus(60, 30, 0.3);
    int num_beyond = 0, num_narrow = 0;
    for (const std::uint64_t seed : {1, 2, 3}) {
        const RemeshResult plain = remesh::remesh(mesh.view(), with(120, {}, seed));
        const Extremes before = extremes_of(plain);
        num_beyond += before.max_angle > 90 ? 1 : 0;
        const RemeshResult kept =
            remesh::remesh(mesh.view(), with(120, {.min_angle = 30, .max_angle = 90}, seed));
        EXPECT_EQ(kept.mesh.positions.size(), 120u);
        EXPECT_LE(extremes_of(kept).max_angle, 90);
        EXPECT_GE(extremes_of(kept).min_angle, 30);
        EXPECT_TRUE(kept.forced.empty());
        EXPECT_LT(kept.verdict.largest_distance, 1.1 * plain.verdict.largest_distance);
        // Without relaxation angles are smaller: the bounds are only checked.
        RemeshOptions unrelaxed = with(400, {.min_angle = 30}, seed);
        unrelaxed.relax_steps = 0;
        const std::string text = refusal_of(mesh, unrelaxed);
        num_narrow += text.starts_with("the smallest angle asked for is 30, and ") ? 1 : 0;
        EXPECT_NE(text.find("was reached with 400 vertices, near "), std::string::npos) << text;
        EXPECT_NE(text.find("or allow a smaller angle"), std::string::npos) << text;
    }
    EXPECT_EQ(num_narrow, 3);
    EXPECT_GE(num_beyond, 1);
}

TEST(Bounds, NoEdgeIsLonger) {
    const TriangleMesh mesh = shapes::torus(60, 30, 0.3);
    const double mean = remesh::remesh(mesh.view(), with(400, {})).sizing.mean_edge;
    const auto run = [&](double length, RemeshOptions options) {
        options.bounds.longest_edge = length;
        RemeshResult result = remesh::remesh(mesh.view(), options);
        EXPECT_LE(extremes_of(result).longest_edge, length);
        return result;
    };
    // As many more vertices as that takes, and no more where few edges are too long.
    const RemeshResult shorter = run(0.7 * mean, with(400, {.min_angle = 25}));
    EXPECT_GT(shorter.mesh.positions.size(), 400 * 1.6 / (0.7 * 0.7));
    EXPECT_LT(shorter.mesh.positions.size(), 400 * 1.8 / (0.7 * 0.7));
    EXPECT_EQ(shorter.sizing.num_samples, shorter.mesh.positions.size());
    EXPECT_GE(extremes_of(shorter).min_angle, 25);
    EXPECT_GE(run(1.35 * mean, with(400, {})).mesh.positions.size(), 400u);
    EXPECT_LE(run(1.35 * mean, with(400, {})).mesh.positions.size(), 410u);
    EXPECT_EQ(run(3 * mean, with(400, {})).mesh.positions.size(), 400u);
    RemeshOptions adaptive = with(400, {});
    adaptive.sizing.edges = remesh::AdaptiveEdges{};
    EXPECT_GE(run(1.3 * mean, adaptive).mesh.positions.size(), 400u);
    // Of another size.
    RemeshOptions large = with(400, {.longest_edge = std::ldexp(0.7 * mean, 400)});
    TriangleMesh scaled = mesh;
    for (Vec3& p : scaled.positions) p *= std::ldexp(1.0, 400);
    const RemeshResult same = remesh::remesh(scaled.view(), large);
    EXPECT_EQ(same.mesh.triangles, run(0.7 * mean, with(400, {})).mesh.triangles);
    // Edges that stay are not divided.
    const TriangleMesh tube = shapes::tube(24, 12);
    RemeshOptions locked = with(200, {.longest_edge = 0.2});
    locked.lock_boundary = true;
    const std::string text = refusal_of(tube, locked);
    EXPECT_TRUE(text.starts_with("the longest edge asked for is 0.2, and 0.261")) << text;
}

// A wedge of 14 degrees: its triangles at the two acute edges cannot keep more.
TEST(Bounds, WhatCreasesForceIsTold) {
    TriangleMesh wedge = parts::box({4, 1, 1}, 4);
    for (Vec3& p : wedge.positions) p.z() *= 0.001 + p.x() / 4;
    const RemeshResult result =
        remesh::remesh(wedge.view(), with(300, {.min_angle = 25, .max_angle = 120}));
    ASSERT_FALSE(result.forced.empty());
    EXPECT_LT(result.forced.size(), 40u);
    for (const auto& [face, least, most] : result.forced) {
        const auto corners = agvd::corners_of(result.mesh.view(), face);
        EXPECT_TRUE(least < 25 || most > 120) << face;
        EXPECT_LT((corners[0] + corners[1] + corners[2]).x() / 3, 1.5) << face;
    }
    EXPECT_GE(extremes_of(result).min_angle, 25);
    EXPECT_LE(extremes_of(result).max_angle, 120);
}

TEST(Bounds, TheyComposeWithADistance) {
    const TriangleMesh mesh = shapes::torus(60, 30, 0.3);
    RemeshOptions options = with(1, {.min_angle = 25, .max_angle = 100, .longest_edge = 0.3});
    options.sizing.count = remesh::MaxDistance{0.01};
    const RemeshResult result = remesh::remesh(mesh.view(), options);
    EXPECT_LE(result.sizing.largest_distance, 0.01);
    EXPECT_GE(extremes_of(result).min_angle, 25);
    EXPECT_LE(extremes_of(result).max_angle, 100);
    EXPECT_LE(extremes_of(result).longest_edge, 0.3);
}

TEST(Bounds, TilesKeepThem) {
    const TriangleMesh mesh = parts::box({2, 1, 1}, 8);
    RemeshOptions options = with(1500, {.min_angle = 30, .max_angle = 92});
    options.samples_per_tile = 600;
    const RemeshResult result = remesh::remesh(mesh.view(), options);
    EXPECT_GT(result.tiles, 1u);
    EXPECT_GE(extremes_of(result).min_angle, 30);
    EXPECT_LE(extremes_of(result).max_angle, 92);
    EXPECT_NEAR(shapes::signed_volume(result.mesh), 2, 1e-9);  // Its creases stay.
}

TEST(Bounds, OnlyTheRegionKeepsThem) {
    const TriangleMesh mesh = shapes::torus(60, 30, 0.3);
    RemeshOptions options = with(150, {.min_angle = 25});
    for (const auto& t : mesh.triangles) {
        options.region.push_back(mesh.positions[t[0]].x() > 0.3 ? 1 : 0);
    }
    const RemeshResult result = remesh::remesh(mesh.view(), options);
    const auto num_kept = static_cast<Index>(result.kept.faces.size());
    for (const auto& face : result.forced) EXPECT_GE(face.face, num_kept);
    double least = 180;
    std::set<Index> forced;
    for (const auto& face : result.forced) forced.insert(face.face);
    for (Index f = num_kept; f < result.mesh.triangles.size(); ++f) {
        if (forced.contains(f)) continue;
        const auto angles = remesh::measure_face(agvd::corners_of(result.mesh.view(), f)).angle;
        least = std::min(least, std::ranges::min(angles) / agvd::degree);
    }
    EXPECT_GE(least, 25);
}

TEST(Bounds, OutOfRangeIsRefused) {
    const TriangleMesh mesh = shapes::cube();
    for (const ShapeBounds& bounds :
         {ShapeBounds{.min_angle = 31}, ShapeBounds{.min_angle = -1}, ShapeBounds{.max_angle = 89},
          ShapeBounds{.longest_edge = 0}}) {
        EXPECT_THROW((void)remesh::remesh(mesh.view(), with(50, bounds)), agvd::InvalidOption);
    }
}

}  // namespace
