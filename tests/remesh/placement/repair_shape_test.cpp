// Thin triangles are repaired, and what is good stays.
#include "remesh/placement/placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "agvd/mesh/topology.h"
#include "remesh/placement/crossing_guard.h"
#include "remesh/placement/distance_guard.h"
#include "remesh/placement/shape_steps.h"
#include "remesh/quality/evaluate.h"
#include "support/movable_mesh.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::detail::Mobility;

namespace {

double smallest_angle(const TriangleMesh& mesh) {
    return remesh::measure_triangles(mesh.view()).min_angle * 180 / std::numbers::pi;
}

// Columns 1 / 8 as wide as rows are high, over a quarter of the tube: angles of 7 degrees.
TriangleMesh uneven_tube() {
    TriangleMesh mesh = shapes::tube(48, 16);
    for (Vec3& p : mesh.positions) {
        const double u = std::atan2(p.y(), p.x()), bent = u + 0.9 * std::sin(u);
        p.x() = std::cos(bent);
        p.y() = std::sin(bent);
    }
    return mesh;
}

// How often the repair polls: its work, whatever the machine.
Index polls_of_repair(MovableMesh& mesh) {
    Index polls = 0;
    (void)repair_shape(mesh.curves(), mesh.mobility, mesh.placed,
                       [&](double) { return ++polls > 0; });
    return polls;
}

// Of a ball pressed to a needle, where all is bad, beside one of 1280 good triangles.
Index polls_beside_a_ball(TriangleMesh needle) {
    for (Vec3& p : needle.positions) p = Vec3(3 + p.x() / 100, p.y() / 100, 4 * p.z());
    MovableMesh placed(shapes::join(shapes::sphere(3), needle));
    return polls_of_repair(placed);
}

TEST(RepairShape, GoodTrianglesStayAsTheyAre) {
    MovableMesh placed(shapes::sphere(3));
    const std::vector<Triangle> before = placed.placed.triangles;
    EXPECT_TRUE(repair_shape(placed.curves(), placed.mobility, placed.placed).empty());
    EXPECT_EQ(placed.placed.triangles, before);
}

TEST(RepairShape, ThinTrianglesGoAndTheCountAndTheTopologyStay) {
    const TriangleMesh mesh = uneven_tube();
    MovableMesh placed(mesh);
    ASSERT_LT(smallest_angle(mesh), 8);
    const std::vector<Index> numbers =
        repair_shape(placed.curves(), placed.mobility, placed.placed);
    const TriangleMesh repaired = placed.mesh_of(placed.placed);
    EXPECT_EQ(numbers.size(), mesh.positions.size());
    EXPECT_EQ(repaired.positions.size(), mesh.positions.size());
    const remesh::Topology topology = remesh::analyze_topology(repaired.view());
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    EXPECT_TRUE(same_topology(topology, remesh::analyze_topology(mesh.view())));
    EXPECT_GT(smallest_angle(repaired), 18);
}

// Walks on a spike of small faces are long. Without their part in the budget the repair polled 3790
// times instead of 327.
TEST(RepairShape, LongWalksUseUpTheBudget) {
    const TriangleMesh coarse = shapes::sphere(1);
    TriangleMesh fine = coarse;
    for (int level = 0; level < 3; ++level) fine = shapes::subdivide(fine);
    for (Vec3& p : fine.positions) {
        if (p.z() > 0) p.z() *= 1000;
    }
    MovableMesh placed(fine);
    placed.placed.triangles = coarse.triangles;
    placed.placed.points.resize(coarse.positions.size());
    placed.placed.offsets.resize(coarse.positions.size());
    placed.mobility.resize(coarse.positions.size());
    const Index polls = polls_of_repair(placed);
    EXPECT_GT(polls, 0u);
    EXPECT_LT(polls, 400u);
}

// Where nearly all triangles are bad, the budget is that of a few. Without this the repair polled
// 8676 times instead of 278.
TEST(RepairShape, ANeedleWhereAllIsBadEndsSoon) {
    TriangleMesh mesh = shapes::sphere(3);
    for (Vec3& p : mesh.positions) p.z() *= 1000;
    MovableMesh placed(mesh);
    const Index polls = polls_of_repair(placed);
    EXPECT_GT(polls, 0u);
    EXPECT_LT(polls, 1000u);
}

// Beside a ball of good triangles: each triangle of the needle has a part of the budget of a few.
// With all of it the repair polled 2741 times with two goals; now 2106, and 2512 times when each
// spare vertex tried all edges again.
TEST(RepairShape, ManyBadTrianglesHaveSmallerBudgets) {
    const Index polls = polls_beside_a_ball(shapes::sphere(2));
    EXPECT_GT(polls, 0u);
    EXPECT_LT(polls, 2300u);
}

// Beside a ball of as many good triangles. With a part of the budget for each triangle the repair
// polled 3206 times instead of 883.
TEST(RepairShape, WhereHalfIsBadTheBudgetIsThatOfAFew) {
    const Index polls = polls_beside_a_ball(shapes::sphere(3));
    EXPECT_GT(polls, 0u);
    EXPECT_LT(polls, 2000u);
}

TEST(CrossingGuard, ASegmentPassesThroughOrOnlyTouches) {
    const std::array<Vec3, 3> t{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    using remesh::detail::passes_through;
    EXPECT_TRUE(passes_through({0.2, 0.2, -1}, {0.2, 0.2, 1}, t));
    EXPECT_FALSE(passes_through({0.8, 0.8, -1}, {0.8, 0.8, 1}, t));
    EXPECT_FALSE(passes_through({0.2, 0.2, 0}, {0.2, 0.2, 1}, t));
    EXPECT_FALSE(passes_through({-1, 0.2, 0}, {1, 0.2, 1e-13}, t));
}

// Whether the collapse of an edge of the first part is worth a gain.
bool accepts_collapse(const MovableMesh& placed, double gain) {
    remesh::detail::MeshCurves curves = placed.curves();
    remesh::detail::EditedMesh mesh(curves, placed.placed, placed.mobility);
    remesh::detail::DistanceGuard guard(mesh, placed.surface);
    const auto before = mesh.mark();
    const Triangle t = mesh.face(0).corner;
    EXPECT_TRUE(mesh.collapse(t[0], t[1]) || mesh.collapse(t[1], t[2]) ||
                mesh.collapse(t[2], t[0]));
    return guard.accepts(mesh.changed_since(before), gain);
}

// The mesh of the second part lies far off: the samples of that part would be nearest to the first.
TEST(DistanceGuard, SamplesBelongToFacesOfTheirOwnPart) {
    const TriangleMesh ball = shapes::sphere(3);
    MovableMesh alone(ball), both(shapes::join(ball, ball));
    for (Index v = static_cast<Index>(ball.positions.size()); v < both.placed.offsets.size(); ++v) {
        both.placed.offsets[v] = Vec3(0.2, 0, 0);
    }
    double gain = 1e-6;
    while (!accepts_collapse(alone, gain) && gain < 1e6) gain *= 1.1;
    EXPECT_FALSE(accepts_collapse(alone, gain / 1.2));
    EXPECT_TRUE(accepts_collapse(both, 1.3 * gain));
}

TEST(ShapeSteps, AVertexIsPutOntoACurve) {
    const MovableMesh placed(uneven_tube());
    remesh::detail::MeshCurves curves = placed.curves();
    remesh::detail::EditedMesh mesh(curves, placed.placed, placed.mobility);
    Ticker ticker;
    remesh::detail::ShapeSteps steps(mesh, mesh.num_faces(), 0.5, ticker);
    using Kind = remesh::detail::ShapeEdit::Kind;
    bool is_done = false;
    for (Index f = 0; f < placed.placed.triangles.size() && !is_done; ++f) {
        for (Index k = 0; k < 3 && !is_done; ++k) {
            const Index apex = mesh.face(f).corner[(k + 2) % 3], last = mesh.num_vertices();
            is_done = steps.edit({f, k, Kind::Press});
            if (!is_done) continue;
            EXPECT_TRUE(mesh.faces_at(apex).empty());
            EXPECT_EQ(mesh.num_vertices(), last + 1);
            EXPECT_EQ(mesh.mobility(last), Mobility::Boundary);
            EXPECT_FALSE(mesh.face(f).is_there);
        }
    }
    EXPECT_TRUE(is_done);
}

// Triangle 0 has an angle of 166 degrees opposite its edge 0.
TriangleMesh sliver_at_a_side() {
    return {{{0, 0, 0}, {2, 0, 0}, {1.4, 0.1, 0}, {1.9, 1, 0}}, {{0, 1, 2}, {2, 1, 3}}};
}

TEST(ShapeSteps, ASliverIsDividedAtTheFootOfItsCorner) {
    using Kind = remesh::detail::ShapeEdit::Kind;
    const MovableMesh placed(sliver_at_a_side());
    const remesh::detail::MeshCurves curves = placed.curves();
    remesh::detail::EditedMesh mesh(curves, placed.placed, placed.mobility);
    Ticker ticker;
    remesh::detail::ShapeSteps steps(mesh, 2, 0.7, ticker);
    const remesh::detail::EditedMesh::Mark before = mesh.mark();
    ASSERT_TRUE(steps.edit({0, 0, Kind::Split}));
    EXPECT_LT((mesh.at(4) - Vec3(1.4, 0, 0)).norm(), 1e-9);
    // The sum of what is missing grows, as two triangles are narrow now; but the worst is better.
    EXPECT_GT(steps.gain_since(before).score, 0);
    EXPECT_GT(steps.gain_since(before).worst, 0);
    const remesh::detail::EditedMesh::Mark divided = mesh.mark();
    ASSERT_TRUE(mesh.collapse(4, 0));
    EXPECT_LT(steps.gain_since(divided).score, 0);
    EXPECT_EQ(steps.gain_since(before).score, 0);
}

TEST(ShapeSteps, EqualTrianglesGetBetterOneByOne) {
    using Kind = remesh::detail::ShapeEdit::Kind;
    const MovableMesh placed(shapes::join(sliver_at_a_side(), sliver_at_a_side()));
    const remesh::detail::MeshCurves curves = placed.curves();
    remesh::detail::EditedMesh mesh(curves, placed.placed, placed.mobility);
    Ticker ticker;
    remesh::detail::ShapeSteps steps(mesh, 4, 0.7, ticker);
    const remesh::detail::EditedMesh::Mark before = mesh.mark();
    const Index added = mesh.split(2, 1);
    ASSERT_NE(added, no_index);
    ASSERT_TRUE(mesh.collapse(added, 5));
    EXPECT_EQ(steps.gain_since(before).score, 0);
    ASSERT_TRUE(steps.edit({0, 0, Kind::Split}));
    EXPECT_EQ(steps.gain_since(before).worst, 0);
    EXPECT_GT(steps.gain_since(before).score, 0);
}

TEST(RepairShape, FixedVerticesStay) {
    const TriangleMesh mesh = uneven_tube();
    MovableMesh placed(mesh);
    for (Index v = 0; v < mesh.positions.size(); v += 2) placed.mobility[v] = Mobility::Fixed;
    const std::vector<Index> numbers =
        repair_shape(placed.curves(), placed.mobility, placed.placed);
    const TriangleMesh repaired = placed.mesh_of(placed.placed);
    ASSERT_EQ(numbers.size(), mesh.positions.size());
    Index num_fixed = 0;
    for (Index v = 0; v < numbers.size(); ++v) {
        if (numbers[v] >= mesh.positions.size() || numbers[v] % 2 != 0) continue;
        EXPECT_EQ(repaired.positions[v], mesh.positions[numbers[v]]);
        ++num_fixed;
    }
    EXPECT_EQ(num_fixed, (mesh.positions.size() + 1) / 2);
}

}  // namespace
