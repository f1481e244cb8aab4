// What a result is too coarse to show, on meshes of known thickness, size and distance.
#include "remesh/quality/evaluate.h"

#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "support/parts.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::Verdict;

namespace {

Verdict judge(const TriangleMesh& input, const TriangleMesh& result) {
    return remesh::judge_result(input.view(), result.view(),
                                remesh::analyze_topology(result.view()), 1);
}

Verdict judge(const TriangleMesh& mesh) { return judge(mesh, mesh); }

// n x n quads of side 1 / n, on both sides of a plate.
TriangleMesh plate(Index n, double thickness) {
    TriangleMesh mesh = parts::box({1, 1, 1}, n);
    for (Vec3& p : mesh.positions) p.z() *= thickness;
    return mesh;
}

}  // namespace

TEST(Verdict, ASphereHasNothingThatIsSmall) {
    const Verdict verdict = judge(shapes::sphere(3));
    EXPECT_EQ(verdict.thin_walls, 0u);
    EXPECT_EQ(verdict.thinnest_wall, 0);
    EXPECT_EQ(verdict.samples_for_walls, 0u);
    EXPECT_EQ(verdict.small_components, 0u);
    EXPECT_EQ(verdict.samples_for_components, 0u);
    EXPECT_EQ(verdict.largest_distance, 0);
    EXPECT_NEAR(verdict.diagonal, 2 * std::sqrt(3.0), 0.01);
}

TEST(Verdict, APlateThinnerThanItsEdgesIsOneWall) {
    const double thickness = 0.02;
    const Verdict verdict = judge(plate(10, thickness));
    EXPECT_EQ(verdict.thin_walls, 1u);
    EXPECT_NEAR(verdict.thinnest_wall, thickness, 1e-12);
    // Edges are .1 to .14 long: 25 to 50 times the 602 vertices.
    EXPECT_GT(verdict.samples_for_walls, 25u * 602u);
    EXPECT_LT(verdict.samples_for_walls, 50u * 602u);
    EXPECT_EQ(judge(shapes::join(plate(10, thickness),
                                 shapes::moved(plate(10, 2 * thickness), {5, 0, 0})))
                  .thin_walls,
              2u);
    EXPECT_EQ(judge(plate(10, 0.2)).thin_walls, 0u);
}

TEST(Verdict, WallsOfAnyThicknessAreFound) {
    for (const double thickness : {0.09, 0.01, 1e-3, 1e-4}) {
        SCOPED_TRACE(thickness);
        const Verdict verdict = judge(plate(10, thickness));
        EXPECT_EQ(verdict.thin_walls, 1u);
        EXPECT_NEAR(verdict.thinnest_wall, thickness, 1e-12);
        EXPECT_GT(verdict.samples_for_walls, 602u);
        EXPECT_LE(verdict.samples_for_walls, 4'000'000'000u);
    }
}

TEST(Verdict, AGapIsNoWall) {
    const TriangleMesh box = parts::box({1, 1, 1}, 10);
    EXPECT_EQ(judge(shapes::join(box, shapes::moved(box, {1.02, 0, 0}))).thin_walls, 0u);
}

TEST(Verdict, AFaceTurnedOverAtAVertexIsNoWall) {
    // A vertex goes over the far edge of a face of its own, which then shows its other side.
    TriangleMesh mesh = shapes::sphere(3);
    const auto [a, b, c] = mesh.triangles[0];
    const Vec3 middle = (mesh.positions[b] + mesh.positions[c]) / 2;
    mesh.positions[a] = (mesh.positions[a] + 1.3 * (middle - mesh.positions[a])).normalized();
    EXPECT_EQ(judge(mesh).thin_walls, 0u);
}

TEST(Verdict, ComponentsOfFewVerticesAreSmall) {
    const TriangleMesh large = shapes::sphere(3);
    TriangleMesh mesh = shapes::join(large, shapes::moved(shapes::tetrahedron(), {9, 0, 0}));
    const Verdict verdict = judge(mesh);
    EXPECT_EQ(verdict.small_components, 1u);
    // Three times as many vertices.
    EXPECT_NEAR(verdict.samples_for_components, 3.0 * static_cast<double>(mesh.positions.size()),
                100);
    mesh = shapes::join(large, shapes::moved(shapes::icosahedron(), {9, 0, 0}));
    ASSERT_EQ(shapes::icosahedron().positions.size(), remesh::least_component_vertices);
    EXPECT_EQ(judge(mesh).small_components, 0u);
}

TEST(Verdict, TheFarthestVertexOfTheInputIsNamed) {
    TriangleMesh input = shapes::sphere(3);
    const TriangleMesh result = input;
    input.positions[77] *= 1.25;
    input.positions[78] *= 1.125;
    const Verdict verdict = judge(input, result);
    EXPECT_NEAR(verdict.largest_distance, 0.25, 1e-12);
    EXPECT_EQ(verdict.farthest, input.positions[77]);
}

TEST(Verdict, OfManyVerticesSomeAreCompared) {
    TriangleMesh input = shapes::grid(200);
    ASSERT_GT(input.positions.size(), remesh::most_compared_vertices);
    ASSERT_LT(input.positions.size(), 2 * remesh::most_compared_vertices);
    const TriangleMesh result = input;
    // Of two neighbours by number at least one is looked at.
    const auto last = input.positions.size() - 1;
    for (const std::size_t v : {last - 1, last}) input.positions[v].z() = 0.5;
    EXPECT_NEAR(judge(input, result).largest_distance, 0.5, 1e-12);
}

TEST(Verdict, TheSmallestAngleAndTheSpacingAreThoseOfTheResult) {
    const TriangleMesh result = shapes::grid(4);
    const Verdict verdict = judge(shapes::grid(8), result);
    EXPECT_NEAR(verdict.min_angle, std::numbers::pi / 4, 1e-12);
    EXPECT_NEAR(verdict.spacing, (2 + std::sqrt(2.0)) / 3 / 4, 1e-12);
    EXPECT_EQ(verdict.small_angle_share, 0);
    TriangleMesh mixed = result;
    for (agvd::Vec3& p : mixed.positions)
        p.x() *= p.x() > 0.5 ? 3 : 1;  // One column of four: 6, 3.
    EXPECT_EQ(judge(mixed, mixed).small_angle_share, 0.5);
    EXPECT_EQ(verdict.faces_without_area, 0U);
}

TEST(Verdict, FacesWithoutAreaAreCounted) {
    TriangleMesh result = shapes::grid(4);
    result.positions[1] = (result.positions[0] + result.positions[2]) / 2;
    result.positions[6] = result.positions[1] + agvd::Vec3(1e-13, 0, 0);
    EXPECT_GT(judge(shapes::grid(8), result).faces_without_area, 0U);
}

TEST(Verdict, NarrowFacesAtTheEndsOfTheSurfaceAreForced) {
    // Triangles by themselves, with smallest angles of 11, 56 and 27 degrees.
    TriangleMesh result;
    for (const Vec3& apex : {Vec3(0.5, 0.1, 0), Vec3(0.5, 0.9, 0), Vec3(1, 0.5, 0)}) {
        TriangleMesh one{{{0, 0, 0}, {1, 0, 0}, apex}, {{0, 1, 2}}};
        result = shapes::join(shapes::moved(std::move(result), {3, 0, 0}), one);
    }
    const remesh::NarrowFaces narrow = judge(result).narrow;
    EXPECT_EQ(narrow.count, 2u);
    EXPECT_EQ(narrow.at_acute_corners, 2u);
    EXPECT_EQ(narrow.at_thin_walls, 0u);
}

TEST(Verdict, NarrowFacesOfAFlatSurfaceAreNotForced) {
    TriangleMesh mesh = shapes::grid(4);
    for (Vec3& p : mesh.positions) p.x() /= 2;  // Angles of 26.6 degrees, beside a diagonal.
    const remesh::NarrowFaces narrow = judge(mesh).narrow;
    EXPECT_EQ(narrow.count, 32u);
    EXPECT_EQ(narrow.at_acute_corners, 0u);
    EXPECT_EQ(narrow.at_thin_walls, 0u);
    EXPECT_EQ(narrow.between_creases, 2u);  // At two corners of the square.
}

TEST(Verdict, NarrowFacesOfAPlateThinnerThanItsEdgesAreForced) {
    TriangleMesh mesh = plate(10, 0.02);
    for (Vec3& p : mesh.positions) p.x() *= 0.4;
    const remesh::NarrowFaces narrow = judge(mesh).narrow;
    EXPECT_EQ(narrow.count, 1200u);  // All: 200 on each side of the box.
    EXPECT_EQ(narrow.at_acute_corners, 0u);
    EXPECT_GE(narrow.at_thin_walls, 400u);
}

TEST(Verdict, NarrowFacesOfAStripAreBetweenCreases) {
    // One column of the grid is narrower, with folds on both sides; the one beside it gets wide.
    TriangleMesh mesh = shapes::grid(4);
    for (Vec3& p : mesh.positions) p.x() = p.x() == 0.25 ? 0.4 : p.x();
    for (Vec3& p : mesh.positions)
        p.z() = p.x() < 0.4 ? 0.4 - p.x() : p.x() > 0.5 ? p.x() - 0.5 : 0;
    const remesh::NarrowFaces narrow = judge(mesh).narrow;
    EXPECT_EQ(narrow.count, 16u);
    EXPECT_EQ(narrow.at_acute_corners, 0u);
    EXPECT_EQ(narrow.at_thin_walls, 0u);
    EXPECT_EQ(narrow.between_creases, 16u);
}

TEST(Verdict, ThreadsDoNotChangeIt) {
    const TriangleMesh input = shapes::torus(80, 40), result = shapes::torus(40, 20);
    const auto topology = remesh::analyze_topology(result.view());
    const Verdict one = remesh::judge_result(input.view(), result.view(), topology, 1);
    const Verdict four = remesh::judge_result(input.view(), result.view(), topology, 4);
    EXPECT_GT(one.largest_distance, 0);
    EXPECT_EQ(one.largest_distance, four.largest_distance);
    EXPECT_EQ(one.farthest, four.farthest);
    EXPECT_EQ(one.thin_walls, four.thin_walls);
}
