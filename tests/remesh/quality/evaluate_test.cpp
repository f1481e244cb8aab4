#include "remesh/quality/evaluate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "agvd/core/error.h"
#include "agvd/mesh/scale.h"
#include "report/report.h"
#include "support/shapes.h"

using agvd::TriangleMesh;
using remesh::Evaluation;

namespace {

Evaluation evaluate(const TriangleMesh& original, const TriangleMesh& result, int num_threads = 2) {
    return remesh::evaluate(original.view(), result.view(),
                            {.samples = 5000, .num_threads = num_threads});
}

std::string text_of_failure(const TriangleMesh& original, const TriangleMesh& result) {
    try {
        (void)evaluate(original, result);
    } catch (const agvd::InvalidInput& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST(Evaluate, ACoarserTorusKeepsTheTopology) {
    const Evaluation e = evaluate(shapes::torus(40, 20), shapes::torus(24, 12));
    EXPECT_EQ(e.original.vertices, 800u);
    EXPECT_EQ(e.original.faces, 1600u);
    EXPECT_EQ(e.result.vertices, 288u);
    EXPECT_TRUE(e.topology_kept);
    EXPECT_EQ(e.result.topology.genus(), 1);
    EXPECT_EQ(e.result.triangles.regular_share, 1);
    EXPECT_EQ(e.cleaned, remesh::CleanCounts{});
}

TEST(Evaluate, FeaturesAreMeasuredWhereThereAreAny) {
    EXPECT_FALSE(evaluate(shapes::torus(40, 20), shapes::torus(24, 12)).features.has_value());
    const Evaluation e = evaluate(shapes::cube(), shapes::subdivide(shapes::cube()));
    ASSERT_TRUE(e.features.has_value());
    EXPECT_EQ(e.features->covered_closely, 1);
    EXPECT_EQ(e.features->corners_kept, 8u);
}

TEST(Evaluate, TopologyIsNotKeptByAnotherSurfaceOrADirtyOne) {
    EXPECT_FALSE(evaluate(shapes::sphere(2), shapes::torus(24, 12)).topology_kept);
    EXPECT_FALSE(evaluate(shapes::sphere(2), shapes::join(shapes::sphere(1), shapes::sphere(1)))
                     .topology_kept);
    TriangleMesh turned = shapes::sphere(2);
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    const Evaluation e = evaluate(shapes::sphere(2), turned);
    EXPECT_TRUE(e.result.topology.is_manifold);
    EXPECT_FALSE(e.topology_kept);
}

TEST(Evaluate, TheOriginalIsRepairedAndTheResultIsNot) {
    TriangleMesh dirty = shapes::sphere(2);
    dirty.triangles.push_back(dirty.triangles[3]);
    const Evaluation e = evaluate(dirty, dirty);
    EXPECT_EQ(e.cleaned.duplicate_faces, 1u);
    EXPECT_EQ(e.original.faces + 1, e.result.faces);
    EXPECT_TRUE(e.original.topology.is_manifold);
    EXPECT_FALSE(e.result.topology.is_manifold);
}

TEST(Evaluate, WhatCannotBeMeasuredIsNamed) {
    const TriangleMesh good = shapes::tetrahedron();
    TriangleMesh bad = good;
    bad.triangles[2] = {0, 1, 9};
    EXPECT_EQ(text_of_failure(good, bad).find("result: face 2 names vertex 9"), 0u);
    EXPECT_EQ(text_of_failure(bad, good).find("original: face 2"), 0u);
    bad = good;
    bad.positions[1].x() = std::nan("");
    EXPECT_EQ(text_of_failure(good, bad).find("result: vertex 1 "), 0u);
}

TEST(Evaluate, AnyScaleGivesTheSameSharesAndScaledLengths) {
    const TriangleMesh original = shapes::subdivide(shapes::subdivide(shapes::cube()));
    const TriangleMesh result = shapes::jitter(shapes::subdivide(shapes::cube()), 0.02, 3);
    const Evaluation usual = evaluate(original, result);
    ASSERT_TRUE(usual.features.has_value());
    for (const int exponent : {-300, -90, 90, 300}) {
        SCOPED_TRACE(exponent);
        const Evaluation e = evaluate(agvd::scaled(original.view(), exponent),
                                      agvd::scaled(result.view(), exponent));
        EXPECT_TRUE(e.topology_kept);
        EXPECT_EQ(e.result.triangles.mean_quality, usual.result.triangles.mean_quality);
        EXPECT_EQ(e.features->covered, usual.features->covered);
        EXPECT_EQ(e.features->length, std::ldexp(usual.features->length, exponent));
        EXPECT_EQ(e.features->result_length, std::ldexp(usual.features->result_length, exponent));
        EXPECT_EQ(e.features->diagonal, std::ldexp(usual.features->diagonal, exponent));
        for (const auto mesh : {&Evaluation::original, &Evaluation::result}) {
            EXPECT_EQ((e.*mesh).topology.components.at(0).area,
                      std::ldexp((usual.*mesh).topology.components.at(0).area, 2 * exponent));
        }
        ASSERT_EQ(e.distance.has_value(), usual.distance.has_value());
        if (!e.distance) continue;
        for (const auto side :
             {&remesh::SurfaceDistance::from_original, &remesh::SurfaceDistance::from_result}) {
            const remesh::OneSidedDistance &scaled = (*e.distance).*side,
                                           &plain = (*usual.distance).*side;
            EXPECT_EQ(scaled.mean, std::ldexp(plain.mean, exponent));
            EXPECT_EQ(scaled.rms, std::ldexp(plain.rms, exponent));
            EXPECT_EQ(scaled.max, std::ldexp(plain.max, exponent));
            EXPECT_EQ(scaled.farthest.x(), std::ldexp(plain.farthest.x(), exponent));
        }
        EXPECT_EQ(e.distance->diagonal, std::ldexp(usual.distance->diagonal, exponent));
    }
}

TEST(Evaluate, ThreadsDoNotMatter) {
    const TriangleMesh a = shapes::jitter(shapes::sphere(3), 0.05, 1);
    const TriangleMesh b = shapes::jitter(shapes::sphere(2), 0.05, 2);
    const std::string one = to_json(evaluate(a, b, 1));
    EXPECT_EQ(one, to_json(evaluate(a, b, 2)));
    EXPECT_EQ(one, to_json(evaluate(a, b, 8)));
}
