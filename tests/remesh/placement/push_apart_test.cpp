// Faces of coarse meshes of two near sheets are parted by moving vertices off the surface.
#include <gtest/gtest.h>

#include <algorithm>

#include "remesh/placement/crossing_guard.h"
#include "remesh/placement/placement.h"
#include "support/movable_mesh.h"
#include "support/parts.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::detail::Mobility;
using Pairs = std::vector<std::pair<Index, Index>>;

namespace {

// Two spheres around each other, the inner one turned and, as that of a shell, inside out.
TriangleMesh spheres(int levels, double radius, bool is_shell) {
    TriangleMesh inner = parts::turned(shapes::sphere(levels), 7);
    for (Vec3& p : inner.positions) p *= radius;
    if (is_shell) {
        for (Triangle& t : inner.triangles) std::swap(t[1], t[2]);
    }
    return shapes::join(shapes::sphere(levels), inner);
}

// A coarse mesh of fine spheres. As faces are split in four the vertices that both share come first
// in each sphere.
MovableMesh coarse_mesh(double radius, bool is_shell) {
    MovableMesh fine(spheres(4, radius, is_shell));
    const TriangleMesh coarse = spheres(1, radius, is_shell);
    const auto num_coarse = static_cast<Index>(coarse.positions.size() / 2),
               num_fine = static_cast<Index>(fine.placed.points.size() / 2);
    const std::vector<SurfacePoint> points = fine.placed.points;
    fine.placed = {{}, std::vector<Vec3>(2 * num_coarse, Vec3::Zero()), coarse.triangles};
    for (Index v = 0; v < 2 * num_coarse; ++v) {
        fine.placed.points.push_back(points[v < num_coarse ? v : v - num_coarse + num_fine]);
    }
    fine.mobility.resize(2 * num_coarse);
    return fine;
}

Pairs find_pairs(const MovableMesh& mesh) {
    const remesh::detail::MeshCurves curves = mesh.curves();
    const remesh::detail::EditedMesh edited(curves, mesh.placed, mesh.mobility);
    const remesh::detail::CrossingGuard guard(edited);
    Pairs found;
    for (Index f = 0; f < edited.num_faces(); ++f) {
        if (guard.face_through(f) != no_index) found.emplace_back(f, guard.face_through(f));
    }
    return found;
}

bool push(MovableMesh& mesh, const Pairs& pairs, Mobility most = Mobility::Boundary) {
    return push_apart(mesh.curves(), mesh.mobility, pairs, most, mesh.placed);
}

// How far a vertex of one of the spheres is moved away from the center.
double moved_out(const MovableMesh& mesh, Index v) {
    const SurfacePoint& point = mesh.placed.points[v];
    return mesh.placed.offsets[v].dot(position(mesh.surface.mesh.view(), point).normalized());
}

}  // namespace

// Of a thin shell, or of two bodies.
TEST(PushApart, SheetsPart) {
    for (const bool is_shell : {true, false}) {
        MovableMesh shell = coarse_mesh(0.98, is_shell);
        const Pairs pairs = find_pairs(shell);
        ASSERT_GE(pairs.size(), 40u);
        EXPECT_TRUE(push(shell, pairs));
        EXPECT_TRUE(find_pairs(shell).empty());
        const auto half = static_cast<Index>(shell.placed.points.size() / 2);
        Index num_moved = 0;
        for (Index v = 0; v < 2 * half; ++v) {
            const double out = moved_out(shell, v);
            EXPECT_GE(v < half ? out : -out, 0) << v;
            EXPECT_LT(shell.placed.offsets[v].norm(), 0.1) << v;
            num_moved += out != 0 ? 1 : 0;
        }
        EXPECT_GE(num_moved, half);
    }
}

TEST(PushApart, FixedVerticesAndFacesOfOtherPairsStay) {
    MovableMesh shell = coarse_mesh(0.98, true);
    const Pairs pairs = find_pairs(shell);
    EXPECT_FALSE(push(shell, {}));
    std::ranges::fill(shell.mobility, Mobility::Fixed);
    EXPECT_FALSE(push(shell, pairs));
    const auto half = static_cast<Index>(shell.placed.points.size() / 2);
    std::fill(shell.mobility.begin() + half, shell.mobility.end(), Mobility::Free);
    EXPECT_TRUE(push(shell, pairs));
    for (Index v = 0; v < half; ++v) EXPECT_EQ(shell.placed.offsets[v], Vec3::Zero()) << v;
    EXPECT_LT(find_pairs(shell).size(), pairs.size());
}

TEST(PushApart, VerticesOnCurvesMoveIfAsked) {
    MovableMesh shell = coarse_mesh(0.98, true);
    const Pairs pairs = find_pairs(shell);
    std::ranges::fill(shell.mobility, Mobility::Boundary);
    EXPECT_FALSE(push(shell, pairs, Mobility::Free));
    EXPECT_TRUE(push(shell, pairs, Mobility::Boundary));
    EXPECT_TRUE(find_pairs(shell).empty());
}

TEST(PushApart, VerticesOnTheRimStay) {
    MovableMesh shell = coarse_mesh(0.98, true);
    const Triangle gone = shell.placed.triangles[0];
    shell.placed.triangles.erase(shell.placed.triangles.begin());
    EXPECT_TRUE(push(shell, find_pairs(shell)));
    for (const Index v : gone) EXPECT_EQ(shell.placed.offsets[v], Vec3::Zero()) << v;
    EXPECT_LT(find_pairs(shell).size(), 8u);
}
