// Meshes are brought within a distance by few changes, and vertices to spare go.
#include "remesh/placement/keep_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "agvd/mesh/topology.h"
#include "remesh/quality/evaluate.h"
#include "support/crease_checks.h"
#include "support/movable_mesh.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::detail::DistanceLimit;
using remesh::detail::keep_distance;

namespace {

struct Kept {
    TriangleMesh mesh;
    std::optional<double> distance;
    std::vector<remesh::DirectedEdge> hard;
};

Kept kept(const TriangleMesh& mesh, const TriangleMesh& input, double limit,
          const DistanceLimit& like) {
    MovableMesh movable(mesh);
    const ClosestPointTree tree(input.view());
    const DistanceLimit wanted{.input = {input.view(), tree},
                               .points = input.positions,
                               .limit = limit,
                               .may_leave_surface = like.may_leave_surface,
                               .least_edge = like.least_edge,
                               .most_edge = like.most_edge,
                               .num_threads = like.num_threads};
    const auto distance =
        keep_distance(movable.curves(), movable.mobility, wanted, movable.placed, {});
    return {movable.mesh_of(movable.placed), distance, movable.placed.hard};
}
Kept kept(const TriangleMesh& mesh, const TriangleMesh& input, double limit) {
    const ClosestPointTree tree(input.view());
    return kept(mesh, input, limit, {.input = {input.view(), tree}});
}

// A ball with a blunt spike.
TriangleMesh ball_with_spike(int levels) {
    TriangleMesh mesh = shapes::sphere(levels);
    for (Vec3& p : mesh.positions) p *= 1 + 0.3 * std::pow(std::max(p.z(), 0.0), 40);
    return mesh;
}

bool keeps_topology(const TriangleMesh& mesh, const TriangleMesh& other) {
    const remesh::Topology a = remesh::analyze_topology(mesh.view());
    return a.is_manifold && a.is_oriented &&
           same_topology(a, remesh::analyze_topology(other.view()));
}

}  // namespace

TEST(KeepDistance, OnlyTheSpikeGetsVertices) {
    const TriangleMesh mesh = ball_with_spike(3), input = ball_with_spike(4);
    ASSERT_GT(crease_checks::farthest_from_surface(input, mesh), 0.012);
    const Kept result = kept(mesh, input, 0.01);
    ASSERT_TRUE(result.distance);
    EXPECT_LE(*result.distance, 0.01);
    EXPECT_LE(crease_checks::farthest_from_surface(input, result.mesh), 0.01);
    EXPECT_LE(crease_checks::farthest_from_surface(result.mesh, input), 0.01);
    EXPECT_TRUE(keeps_topology(result.mesh, mesh));
    // An eighth of the ball is near the spike.
    EXPECT_LT(result.mesh.positions.size(), mesh.positions.size() * 9 / 8);
    std::ptrdiff_t same = 0;
    for (const Vec3& p : mesh.positions) {
        if (p.z() > 0) continue;
        same += std::count(result.mesh.positions.begin(), result.mesh.positions.end(), p);
    }
    EXPECT_GT(same, 200);
}

TEST(KeepDistance, VerticesThatAreNotNeededGo) {
    const TriangleMesh input = shapes::sphere(3);
    const Kept result = kept(input, input, 0.05);
    ASSERT_TRUE(result.distance);
    EXPECT_LE(crease_checks::farthest_from_surface(input, result.mesh), 0.05);
    EXPECT_LE(crease_checks::farthest_from_surface(result.mesh, input), 0.05);
    EXPECT_LT(result.mesh.positions.size(), input.positions.size() * 9 / 10);
    EXPECT_TRUE(keeps_topology(result.mesh, input));
    // The angle of the least quality that is accepted.
    EXPECT_GT(remesh::measure_triangles(result.mesh.view()).min_angle, 0.5);
}

TEST(KeepDistance, EdgesKeepTheirBounds) {
    const TriangleMesh input = shapes::sphere(3);
    const ClosestPointTree tree(input.view());
    const auto longest = [](const TriangleMesh& mesh) {
        double length = 0;
        for (const Triangle& t : mesh.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                length = std::max(length,
                                  (mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]).norm());
            }
        }
        return length;
    };
    const Kept free = kept(input, input, 0.05);
    EXPECT_GT(longest(free.mesh), 0.2);
    const Kept bound = kept(input, input, 0.05, {.input = {input.view(), tree}, .most_edge = 0.18});
    EXPECT_LE(longest(bound.mesh), 0.18);
    // Edges of the ball are .54 to .62 long: none may be divided.
    const TriangleMesh coarse = shapes::sphere(1), fine = shapes::sphere(4);
    const Kept none =
        kept(coarse, fine, 0.001,
             {.input = {fine.view(), tree}, .may_leave_surface = false, .least_edge = 0.35});
    EXPECT_FALSE(none.distance);
    EXPECT_EQ(none.mesh.positions.size(), coarse.positions.size());
}

TEST(KeepDistance, TheBoundaryStaysAChainOnItsCurve) {
    const TriangleMesh mesh = shapes::tube(48, 24);
    const Kept result = kept(mesh, mesh, 0.03);
    EXPECT_TRUE(result.distance);
    EXPECT_LT(result.mesh.positions.size(), mesh.positions.size());
    EXPECT_TRUE(keeps_topology(result.mesh, mesh));
    for (const auto& [from, to] : remesh::rim_of(result.mesh.triangles)) {
        EXPECT_TRUE(std::count(result.hard.begin(), result.hard.end(),
                               remesh::DirectedEdge(from, to)) == 1);
        EXPECT_NEAR(std::abs(result.mesh.positions[from].z()),
                    std::abs(result.mesh.positions[to].z()), 1e-12);
    }
}

// Its points are on the curve, a polygon of 12 corners, which is too far from the circle.
TEST(KeepDistance, WhereNothingHelpsNoDistanceIsTold) {
    EXPECT_FALSE(kept(shapes::tube(12, 6), shapes::tube(48, 24), 0.02).distance);
}

TEST(KeepDistance, OfAnyNumberOfThreadsIsTheSame) {
    const TriangleMesh mesh = ball_with_spike(3), input = ball_with_spike(4);
    const ClosestPointTree tree(input.view());
    const Kept one = kept(mesh, input, 0.01);
    const Kept three = kept(mesh, input, 0.01, {.input = {input.view(), tree}, .num_threads = 3});
    EXPECT_EQ(one.mesh.positions, three.mesh.positions);
    EXPECT_EQ(one.mesh.triangles, three.mesh.triangles);
}
