// Self-intersections of the result, and which of them follow from the input's.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/placement/placement.h"
#include "remesh/quality/evaluate.h"
#include "support/files.h"
#include "support/parts.h"
#include "support/shapes.h"

using agvd::Vec3;
using remesh::detail::crossing_triangle;

namespace {

using Corners = std::array<Vec3, 3>;

bool has_cgal() { return remesh::find_self_intersections(shapes::cube().view()).has_value(); }

void expect_segment(const Corners& place, const Vec3& a, const Vec3& b) {
    const bool is_swapped = (place[0] - a).norm() > (place[0] - b).norm();
    EXPECT_LT((place[0] - (is_swapped ? b : a)).norm(), 1e-12);
    EXPECT_LT((place[1] - (is_swapped ? a : b)).norm(), 1e-12);
    EXPECT_EQ(place[1], place[2]);
}

}  // namespace

TEST(CrossingPlaces, AreTheShorterOfBothSegments) {
    const Corners large{Vec3(-4, -4, 0), Vec3(4, -4, 0), Vec3(0, 8, 0)};
    const Corners small{Vec3(0, 0, -1), Vec3(0, 1, 1), Vec3(0, -1, 1)};
    expect_segment(crossing_triangle(large, small), {0, -.5, 0}, {0, .5, 0});
    expect_segment(crossing_triangle(small, large), {0, -.5, 0}, {0, .5, 0});
    const Corners touching{Vec3(1, 0, 0), Vec3(1, 1, 1), Vec3(1, -1, 1)};
    expect_segment(crossing_triangle(large, touching), {1, 0, 0}, {1, 0, 0});
    const Corners in_plane{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    EXPECT_EQ(crossing_triangle(large, in_plane), in_plane);
    EXPECT_EQ(crossing_triangle(in_plane, large), in_plane);
    // One edge lies in the other's plane.
    const Corners standing{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)};
    expect_segment(crossing_triangle(standing, large), {0, 0, 0}, {1, 0, 0});
}

TEST(CrossingPlaces, PairsFartherThanTheirLongestEdgeAreElsewhere) {
    // Pairs of small triangles that cross at x = 0, 1, 2, ...
    agvd::TriangleMesh mesh;
    remesh::detail::FacePairs pairs;
    for (agvd::Index i = 0; i < 6; ++i) {
        const Vec3 at(i, 0, 0);
        for (const Vec3& p : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0), Vec3(0, -1, -1),
                              Vec3(0, 0, 1), Vec3(0, 1, -1)}) {
            mesh.positions.push_back(at + .5 * p);
        }
        mesh.triangles.push_back({6 * i, 6 * i + 1, 6 * i + 2});
        mesh.triangles.push_back({6 * i + 3, 6 * i + 4, 6 * i + 5});
        pairs.emplace_back(2 * i, 2 * i + 1);
    }
    const agvd::ClosestPointTree places(remesh::detail::crossing_triangles(mesh, {pairs[1]}));
    // The longest edges are 1.12.
    EXPECT_EQ(remesh::detail::pairs_elsewhere(places, mesh, pairs),
              (remesh::detail::FacePairs{pairs[3], pairs[4], pairs[5]}));
}

// A prism over a triangle of this angle, in degrees: its two long sides meet at an edge.
agvd::TriangleMesh wedge(double degrees) {
    const double y = std::tan(degrees * std::numbers::pi / 180);
    return {
        {{0, 0, 0}, {1, 0, 0}, {1, y, 0}, {0, 0, 1}, {1, 0, 1}, {1, y, 1}},
        {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {0, 3, 5}, {0, 5, 2}, {1, 2, 5}, {1, 5, 4}}};
}

TEST(Crossings, FacesWithLessThanADegreeBetweenThemAreFolds) {
    EXPECT_TRUE(remesh::detail::find_folds(wedge(1.01).view()).empty());
    EXPECT_EQ(remesh::detail::find_folds(wedge(0.99).view()), (remesh::detail::FacePairs{{3, 4}}));
}

TEST(Crossings, FoldsOfTheInputAreNotNew) {
    if (!has_cgal()) GTEST_SKIP() << "without CGAL";
    const auto result = remesh::remesh(wedge(0.8).view(), {.num_samples = 60});
    EXPECT_FALSE(remesh::detail::find_folds(result.mesh.view()).empty());
    EXPECT_EQ(result.self_intersections, 0u);
    EXPECT_EQ(result.new_self_intersections, 0u);
}

TEST(Crossings, ThatFollowFromTheInputAddNoVerticesAndDropNoCreases) {
    if (!has_cgal()) GTEST_SKIP() << "without CGAL";
    const agvd::TriangleMesh cube = shapes::cube();
    const agvd::TriangleMesh cubes = shapes::join(cube, shapes::moved(cube, Vec3(.3, .35, .4)));
    const auto result = remesh::remesh(cubes.view(), {.num_samples = 400});
    EXPECT_GT(*result.self_intersections, result.input_self_intersections);
    EXPECT_GT(result.input_self_intersections, 0u);
    EXPECT_EQ(result.new_self_intersections, 0u);
    EXPECT_EQ(result.mesh.positions.size(), 400u);
    EXPECT_EQ(result.features.dropped_length, 0);
    EXPECT_FALSE(result.features.gave_up);
}

// Without creases fewer faces of these boxes intersect, fewer even than those of the input.
TEST(Crossings, ThatFollowFromTheInputDropNoCreasesWhereThatWouldLeaveFewer) {
    if (!has_cgal()) GTEST_SKIP() << "without CGAL";
    const agvd::TriangleMesh boxes =
        shapes::join(parts::box({1, 1, 1}, 1),
                     shapes::join(shapes::moved(parts::box({1, 1.1, 1.2}, 1), Vec3(.5, .3, .2)),
                                  shapes::moved(parts::box({.3, 2, .2}, 1), Vec3(.2, -.3, .45))));
    const auto with = remesh::remesh(boxes.view(), {.num_samples = 60});
    const auto without =
        remesh::remesh(boxes.view(), {.num_samples = 60, .features = remesh::Features::Off});
    EXPECT_GT(*with.self_intersections, with.input_self_intersections);
    EXPECT_LT(*without.self_intersections, *with.self_intersections);
    EXPECT_EQ(with.new_self_intersections, 0u);
    EXPECT_EQ(with.features.dropped_length, 0);
    EXPECT_FALSE(with.features.gave_up);
}

// A unit sphere, and one of this radius in it that is inside out.
agvd::TriangleMesh shell(int levels, double radius) {
    agvd::TriangleMesh inner = shapes::sphere(levels);
    for (Vec3& p : inner.positions) p *= radius;
    for (agvd::Triangle& t : inner.triangles) std::swap(t[1], t[2]);
    return shapes::join(shapes::sphere(levels), inner);
}

// Two spheres, one just inside the other: their coarse meshes run through each other.
TEST(Crossings, ThatTheInputDoesNotHaveAreNew) {
    if (!has_cgal()) GTEST_SKIP() << "without CGAL";
    const agvd::TriangleMesh shells = shell(2, 0.98);
    // Without relaxation nothing is repaired.
    const auto result = remesh::remesh(shells.view(), {.num_samples = 20, .relax_steps = 0});
    EXPECT_EQ(result.new_self_intersections, result.self_intersections);
    EXPECT_NEAR(result.crossing_near.norm(), 1, 0.15);
    EXPECT_GT(result.new_self_intersections, 0u);
    // Far away two more spheres cross.
    const agvd::TriangleMesh far = shapes::moved(shapes::sphere(2), Vec3(9, 0, 0));
    const agvd::TriangleMesh all =
        shapes::join(shells, shapes::join(far, shapes::moved(far, Vec3(1.2, 0, 0))));
    const auto both = remesh::remesh(all.view(), {.num_samples = 80, .relax_steps = 0});
    EXPECT_GT(both.input_self_intersections, 0u);
    EXPECT_GT(both.new_self_intersections, 0u);
    EXPECT_LT(both.new_self_intersections, *both.self_intersections);
}

// The same at 24 samples and more: the spheres are pushed apart.
TEST(Crossings, SidesOfThinShellsArePushedApart) {
    if (!has_cgal()) GTEST_SKIP() << "without CGAL";
    const agvd::TriangleMesh shells = shell(4, 0.99);
    for (const agvd::Index n : {40u, 80u, 160u}) {
        const auto coarse = remesh::remesh(shells.view(), {.num_samples = n, .relax_steps = 0});
        const auto result = remesh::remesh(shells.view(), {.num_samples = n});
        EXPECT_GT(coarse.self_intersections, 0u) << n;
        EXPECT_EQ(result.self_intersections, 0u) << n;
        EXPECT_EQ(result.mesh.positions.size(), n);
        EXPECT_LT(result.verdict.largest_distance, 0.3 * result.sizing.mean_edge) << n;
    }
}

// With equal edges two arms run through each other; the faces there are parted.
TEST(Crossings, FacesArePartedWhereTheInputHasNone) {
    if (!has_cgal()) GTEST_SKIP() << "without CGAL";
    const agvd::TriangleMesh mesh = remesh::read_mesh(files::find_mesh("data/organic.ply")).mesh;
    const auto result = remesh::remesh(mesh.view(), {.num_samples = 280});
    EXPECT_EQ(result.self_intersections, 0u);
    EXPECT_EQ(result.mesh.positions.size(), 280u);
    EXPECT_EQ(result.sizing.least_target, 0);
}

// Where faces still intersect after repair the run is made again with shorter edges there, which
// leaves 2 of 9 pairs.
TEST(Crossings, EdgesGetShorterWhereFacesCannotBeParted) {
    if (!has_cgal()) GTEST_SKIP() << "without CGAL";
    const agvd::TriangleMesh mesh = remesh::read_mesh(files::find_mesh("data/organic.ply")).mesh;
    const auto result = remesh::remesh(mesh.view(), {.num_samples = 215});
    EXPECT_LE(result.self_intersections, 2u);
    EXPECT_EQ(result.mesh.positions.size(), 215u);
    EXPECT_GT(result.sizing.least_target, 0);
    EXPECT_LT(result.sizing.least_target, 0.6 * result.sizing.largest_target);
}

// Two triangles at an edge of a flat square, one of them turned over the other.
TEST(Crossings, FoldsThatTheInputDoesNotHaveCount) {
    if (!has_cgal()) GTEST_SKIP() << "without CGAL";
    const agvd::TriangleMesh square = shapes::grid(1);
    const agvd::Surface surface = agvd::build_surface(square.view());
    const remesh::detail::CurvedSurface curved{
        .plan = std::make_unique<const remesh::detail::CurvePlan>(),
        .whole = &surface,
        .cleaned = &surface};
    const auto num_pairs = [&](double degrees) {
        remesh::PlacedMesh placed{{}, {}, square.triangles};
        for (agvd::Index v = 0; v < 4; ++v) {
            placed.points.push_back(agvd::point_at(surface, v));
            placed.offsets.push_back(Vec3::Zero());
        }
        // The corner opposite to the common edge comes near the other one.
        const auto& [t, u] = std::array{square.triangles[0], square.triangles[1]};
        const auto apex = [](const agvd::Triangle& a, const agvd::Triangle& b) {
            return *std::ranges::find_if(
                a, [&](agvd::Index v) { return std::ranges::find(b, v) == b.end(); });
        };
        const Vec3 &from = square.positions[apex(t, u)], &to = square.positions[apex(u, t)];
        const double height = (to - from).norm() / 2;
        const Vec3 near = to + (from - to) * 0.1;
        placed.offsets[apex(t, u)] = near - from;
        placed.offsets[apex(t, u)].z() = 0.8 * height * std::tan(degrees * std::numbers::pi / 180);
        const remesh::RemeshOptions options;
        remesh::RemeshResult result;
        remesh::detail::InputCrossings of_input;
        const remesh::detail::StageContext context{options, result};
        remesh::detail::CrossingFinder finder(curved, of_input, context);
        return finder.find(placed)->size();
    };
    EXPECT_EQ(num_pairs(0.9), 1u);
    EXPECT_EQ(num_pairs(1.1), 0u);
}
