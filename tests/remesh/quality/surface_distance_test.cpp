#include "remesh/quality/evaluate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "agvd/core/error.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using remesh::EvaluationOptions;
using remesh::SurfaceDistance;

namespace {

const EvaluationOptions few{.samples = 20'000, .num_threads = 2};

SurfaceDistance distance(const TriangleMesh& original, const TriangleMesh& result,
                         const EvaluationOptions& options = few) {
    return remesh::surface_distance(original.view(), result.view(), options).value();
}

void turn(agvd::Triangle& triangle) { std::swap(triangle[0], triangle[1]); }

}  // namespace

TEST(SurfaceDistance, AnOffsetPlaneLiesAtItsOffset) {
    const SurfaceDistance d =
        distance(shapes::grid(4), shapes::moved(shapes::grid(3), {0, 0, 0.25}));
    for (const auto& side : {d.from_original, d.from_result, d.two_sided()}) {
        EXPECT_NEAR(side.mean, 0.25, 1e-12);
        EXPECT_NEAR(side.rms, 0.25, 1e-12);
        EXPECT_NEAR(side.max, 0.25, 1e-12);
    }
    EXPECT_NEAR(d.diagonal, std::sqrt(2), 1e-15);
    EXPECT_EQ(d.samples, 20'000u);
}

TEST(SurfaceDistance, TellsWhereEachMaximumIs) {
    TriangleMesh result = shapes::grid(4);
    result.positions[7].z() = 0.1;
    const SurfaceDistance d = distance(shapes::grid(4), result);
    EXPECT_EQ(d.from_result.farthest, result.positions[7]);
    EXPECT_EQ(d.two_sided().farthest, result.positions[7]);
    EXPECT_LT((d.from_original.farthest.head<2>() - result.positions[7].head<2>()).norm(), 0.2);
}

TEST(SurfaceDistance, AMeshLiesOnItself) {
    const TriangleMesh mesh = shapes::jitter(shapes::sphere(3), 0.02, 5);
    const SurfaceDistance d = distance(mesh, mesh);
    EXPECT_LT(d.two_sided().max, 1e-14);
    EXPECT_EQ(d.flipped_faces, 0u);
}

TEST(SurfaceDistance, EachSideIsMeasuredOnItsOwn) {
    // The result is the half x <= 1/2 of the unit square.
    TriangleMesh half = shapes::grid(1);
    for (agvd::Vec3& p : half.positions) p.x() /= 2;
    const SurfaceDistance d = distance(shapes::grid(8), half);
    EXPECT_NEAR(d.from_result.max, 0, 1e-15);
    EXPECT_NEAR(d.from_original.mean, 1.0 / 8, 1e-3);
    EXPECT_NEAR(d.from_original.rms, std::sqrt(1.0 / 24), 1e-3);
    EXPECT_NEAR(d.from_original.max, 0.5, 1e-15);
    EXPECT_EQ(d.two_sided().rms, d.from_original.rms);
}

TEST(SurfaceDistance, SamplesAreUniformByAreaNotByFace) {
    // Most faces lie in the half x <= 1/2; the mean distance to x = 0 does not care.
    TriangleMesh uneven = shapes::grid(1);
    for (agvd::Vec3& p : uneven.positions) p.x() /= 2;
    uneven = shapes::subdivide(shapes::subdivide(uneven));
    TriangleMesh right = shapes::grid(1);
    for (agvd::Vec3& p : right.positions) p.x() = (1 + p.x()) / 2;
    uneven = shapes::join(uneven, right);
    TriangleMesh wall = shapes::grid(1);
    for (agvd::Vec3& p : wall.positions) p = {0, p.y(), p.x()};
    EXPECT_NEAR(distance(uneven, wall).from_original.mean, 0.5, 1e-3);
}

TEST(SurfaceDistance, VerticesCountForTheMaximumAlone) {
    // A needle so thin that no sample falls on it.
    TriangleMesh spiked = shapes::grid(2);
    const auto first = static_cast<Index>(spiked.positions.size());
    spiked.positions.insert(spiked.positions.end(),
                            {{0.5, 0.5, 0}, {0.5, 0.5 + 1e-12, 0}, {0.5, 0.5, 3}});
    spiked.triangles.push_back({first, first + 1, first + 2});
    spiked.positions.emplace_back(0, 0, 100);  // In no face: not on the surface.
    const SurfaceDistance d = distance(shapes::grid(2), spiked);
    EXPECT_NEAR(d.from_result.max, 3, 1e-12);
    EXPECT_LT(d.from_result.rms, 1e-12);
    EXPECT_LT(d.from_original.max, 1e-12);
}

TEST(SurfaceDistance, TurnedTrianglesAreFlipped) {
    const TriangleMesh original = shapes::sphere(3);
    TriangleMesh result = shapes::sphere(2);
    EXPECT_EQ(distance(original, result).flipped_faces, 0u);
    turn(result.triangles[17]);
    EXPECT_EQ(distance(original, result).flipped_faces, 1u);
    for (agvd::Triangle& t : result.triangles) turn(t);
    EXPECT_EQ(distance(original, result).flipped_faces, result.triangles.size() - 1);
}

TEST(SurfaceDistance, FacesWithoutAreaArePassedOver) {
    TriangleMesh result = shapes::sphere(2);
    result.triangles.insert(result.triangles.begin(), {3, 3, 4});
    result.triangles.push_back({5, 5, 5});
    EXPECT_LT(distance(shapes::sphere(2), result).two_sided().max, 1e-14);
    TriangleMesh flat = shapes::grid(1);
    for (agvd::Vec3& p : flat.positions) p.x() = 0;
    EXPECT_THROW((void)distance(shapes::sphere(2), flat), agvd::InvalidInput);
}

TEST(SurfaceDistance, BadOptionsAreRefused) {
    const TriangleMesh mesh = shapes::tetrahedron();
    EXPECT_THROW((void)distance(mesh, mesh, {.samples = 0}), agvd::InvalidOption);
    EXPECT_THROW((void)distance(mesh, mesh, {.num_threads = -1}), agvd::InvalidOption);
}

TEST(SurfaceDistance, ThreadsDoNotMatter) {
    const TriangleMesh a = shapes::jitter(shapes::sphere(3), 0.03, 1);
    const TriangleMesh b = shapes::jitter(shapes::sphere(2), 0.03, 2);
    const SurfaceDistance one = distance(a, b, {.samples = 20'000, .num_threads = 1});
    for (const int threads : {2, 8}) {
        const SurfaceDistance many = distance(a, b, {.samples = 20'000, .num_threads = threads});
        EXPECT_EQ(one.from_original.mean, many.from_original.mean);
        EXPECT_EQ(one.from_original.rms, many.from_original.rms);
        EXPECT_EQ(one.from_result.mean, many.from_result.mean);
        EXPECT_EQ(one.two_sided().max, many.two_sided().max);
        EXPECT_EQ(one.flipped_faces, many.flipped_faces);
    }
}
