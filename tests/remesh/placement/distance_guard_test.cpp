// Distance from the surface is refused, unless it is paid for by better shapes.
#include "remesh/placement/distance_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "remesh/placement/edited_mesh.h"
#include "remesh/placement/shape_steps.h"
#include "support/movable_mesh.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::detail::DistanceGuard;
using remesh::detail::EditedMesh;
using remesh::detail::Mobility;
using remesh::detail::Side;

namespace {

// A mesh on its own surface, or off it where `offsets` of its vertices were changed.
struct Guarded : MovableMesh {
    explicit Guarded(const TriangleMesh& mesh) : MovableMesh(mesh) {}

    [[nodiscard]] EditedMesh edited() const { return {curves_, placed, mobility}; }

private:
    remesh::detail::MeshCurves curves_ = curves();
};

// The unit square in 8 x 8 quads, bent along its middle column: both halves slope by this much.
TriangleMesh ridge(double slope) {
    TriangleMesh mesh = shapes::grid(8);
    for (Vec3& p : mesh.positions) p.z() = -slope * std::abs(p.x() - 0.5);
    return mesh;
}
Index at(Index i, Index j) { return 9 * i + j; }

// The same square, flat but for one vertex.
TriangleMesh peak(double height) {
    TriangleMesh mesh = shapes::grid(8);
    mesh.positions[at(4, 4)].z() = height;
    return mesh;
}

// The tops of two columns, one above the other, with outward normals: a plate of this thickness,
// closed at one end, so that it is one part.
TriangleMesh plate(double thickness) {
    TriangleMesh mesh = shapes::grid(16);
    for (Vec3& p : mesh.positions) {
        const double along = 2 * p.x();
        p = along < 1 ? Vec3(along, p.y(), thickness) : Vec3(2 - along, p.y(), 0);
    }
    return mesh;
}

TEST(DistanceGuard, ASideSeesNormalsOfItsHalfSpace) {
    const Side up = Side::of({0.1, -0.2, 0.9}), down = Side::of({0.1, -0.2, -0.9});
    EXPECT_EQ(up.axis, 2);
    EXPECT_FALSE(up.is_against);
    EXPECT_TRUE(down.is_against);
    EXPECT_TRUE(up.sees({5, 0, 0.1}));
    EXPECT_FALSE(up.sees({5, 0, -0.1}));
    EXPECT_FALSE(up.sees({5, 0, 0}));
    EXPECT_TRUE(down.sees({5, 0, -0.1}));
}

TEST(DistanceGuard, EditsInAPlaneAreFree) {
    const Guarded mesh(shapes::grid(8));
    EditedMesh edited = mesh.edited();
    DistanceGuard guard(edited, mesh.surface);
    const EditedMesh::Mark before = edited.mark();
    ASSERT_TRUE(edited.collapse(at(4, 4), at(4, 5)));
    EXPECT_TRUE(guard.accepts(edited.changed_since(before), 1e-9));
}

// A collapse along the ridge costs nothing, one off it cuts the ridge.
TEST(DistanceGuard, ARidgeStaysUnlessItIsPaidFor) {
    const Guarded mesh(ridge(0.2));
    const auto accepts = [&](Index into, double worth) {
        EditedMesh edited = mesh.edited();
        DistanceGuard guard(edited, mesh.surface);
        const EditedMesh::Mark before = edited.mark();
        EXPECT_TRUE(edited.collapse(at(4, 4), into));
        return guard.accepts(edited.changed_since(before), worth);
    };
    EXPECT_TRUE(accepts(at(4, 5), 1e-9));
    EXPECT_FALSE(accepts(at(5, 4), 0));
    EXPECT_FALSE(accepts(at(5, 4), 1e-4));
    EXPECT_TRUE(accepts(at(5, 4), 1));
}

// Of a part of the surface: what happens elsewhere is not seen.
TEST(DistanceGuard, LooksAtTheGivenFacesAlone) {
    const Guarded mesh(ridge(0.2));
    const agvd::Vec3 centre = mesh.surface.mesh.positions[at(4, 4)];
    std::vector<Index> near, far;
    for (Index f = 0; f < mesh.surface.num_faces(); ++f) {
        const auto [a, b, c] = corners_of(mesh.surface.mesh.view(), f);
        (((a + b + c) / 3 - centre).norm() < 0.4 ? near : far).push_back(f);
    }
    ASSERT_GT(near.size(), 20u);
    ASSERT_GT(far.size(), 20u);
    const auto accepts = [&](const std::vector<Index>& faces) {
        EditedMesh edited = mesh.edited();
        DistanceGuard guard(edited, mesh.surface, faces);
        const EditedMesh::Mark before = edited.mark();
        EXPECT_TRUE(edited.collapse(at(4, 4), at(5, 4)));
        return guard.accepts(edited.changed_since(before), 0);
    };
    EXPECT_FALSE(accepts(near));
    EXPECT_TRUE(accepts(far));
}

// A part with a gap, whose rim stays, of a surface that goes on there.
Guarded part_of_ridge() {
    Guarded mesh(ridge(0.2));
    std::erase_if(mesh.placed.triangles, [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](Index v) {
            const Vec3& p = mesh.surface.mesh.positions[v];
            return p.x() >= 0.75 && std::abs(p.y() - 0.5) < 0.4;
        });
    });
    mesh.placed.hard = remesh::rim_of(mesh.placed.triangles);
    for (const auto& [from, to] : mesh.placed.hard) mesh.mobility[from] = Mobility::Fixed;
    return mesh;
}

// Else what is far from the part would pay for anything.
TEST(DistanceGuard, SurfaceBeyondAPartDoesNotCount) {
    const auto accepts = [](const Guarded& mesh) {
        std::vector<Index> all(mesh.surface.num_faces());
        std::iota(all.begin(), all.end(), Index{0});
        EditedMesh edited = mesh.edited();
        DistanceGuard guard(edited, mesh.surface, all);
        guard.open_budget();
        const EditedMesh::Mark before = edited.mark();
        EXPECT_TRUE(edited.collapse(at(4, 4), at(5, 4)));
        return guard.accepts(edited.changed_since(before), 0.01);
    };
    Guarded open = part_of_ridge();
    EXPECT_FALSE(accepts(open));
    std::ranges::replace(open.mobility, Mobility::Fixed, Mobility::Boundary);
    EXPECT_TRUE(accepts(open));
}

// Of a small part on a large surface, samples are as dense as on a mesh of the whole.
TEST(DistanceGuard, SeesEachEditOfASmallPart) {
    constexpr Index n = 64;
    TriangleMesh bent = shapes::grid(n);
    for (Vec3& p : bent.positions) p.z() = -0.2 * std::abs(p.x() - 0.5);
    Guarded mesh(bent);
    std::erase_if(mesh.placed.triangles, [&](const Triangle& t) {
        return std::ranges::any_of(t, [&](Index v) {
            const Vec3& p = bent.positions[v];
            return std::abs(p.x() - 0.5) > 0.05 || std::abs(p.y() - 0.5) > 0.2;
        });
    });
    const std::vector<Index> left = drop_unused(mesh.surface.num_vertices(), mesh.placed.triangles);
    std::vector<SurfacePoint> points;
    for (const Index v : left) points.push_back(mesh.placed.points[v]);
    mesh.placed.points = points;
    mesh.placed.offsets.resize(left.size());
    mesh.mobility.assign(left.size(), Mobility::Free);
    mesh.placed.hard = remesh::rim_of(mesh.placed.triangles);
    for (const auto& [from, to] : mesh.placed.hard) mesh.mobility[from] = Mobility::Fixed;
    std::vector<Index> all(mesh.surface.num_faces());
    std::iota(all.begin(), all.end(), Index{0});
    EditedMesh edited = mesh.edited();
    DistanceGuard guard(edited, mesh.surface, all);
    int num_tried = 0;
    for (const Index v : left) {
        const Index beside = v + n + 1;  // In x.
        if (bent.positions[v].x() != 0.5 || mesh.mobility[rank_of(left, v)] != Mobility::Free) {
            continue;
        }
        const EditedMesh::Mark before = edited.mark();
        ASSERT_TRUE(edited.collapse(rank_of(left, v), rank_of(left, beside)));
        EXPECT_FALSE(guard.accepts(edited.changed_since(before), 1e-5)) << v;
        edited.take_back(before);
        ++num_tried;
    }
    EXPECT_EQ(num_tried, 23);
}

// However much it is worth, no sample gets farther than 0.4 mean edges: here 0.057.
TEST(DistanceGuard, ASampleStaysNear) {
    const auto accepts = [](double height) {
        const Guarded mesh(peak(height));
        EditedMesh edited = mesh.edited();
        DistanceGuard guard(edited, mesh.surface);
        const EditedMesh::Mark before = edited.mark();
        EXPECT_TRUE(edited.collapse(at(4, 4), at(5, 4)));
        return guard.accepts(edited.changed_since(before), 1e6);
    };
    EXPECT_TRUE(accepts(0.055));
    EXPECT_FALSE(accepts(0.061));
}

// The second collapse at the ridge is compared with the first one, not with the start.
TEST(DistanceGuard, WhatWasTakenOverIsTheNewStart) {
    const Guarded mesh(ridge(0.2));
    EditedMesh edited = mesh.edited();
    DistanceGuard guard(edited, mesh.surface);
    const EditedMesh::Mark start = edited.mark();
    ASSERT_TRUE(edited.collapse(at(4, 4), at(5, 4)));
    ASSERT_TRUE(guard.accepts(edited.changed_since(start), 1));
    EXPECT_FALSE(guard.accepts(edited.changed_since(start), 0));
    guard.take_over();
    EXPECT_TRUE(guard.accepts(edited.changed_since(start), 0));
}

// The mesh of the upper sheet lies so far off that the lower one is nearer to its samples. A
// collapse that removes a peak towards them takes nothing from them.
TEST(DistanceGuard, SamplesBelongToFacesThatLookToTheirSide) {
    Guarded mesh(plate(0.1));
    for (Index v = 0; v < mesh.placed.offsets.size(); ++v) {
        if (mesh.surface.mesh.positions[v].z() > 0) mesh.placed.offsets[v] = Vec3(0, 0, 0.3);
    }
    const Index top = 17 * 12 + 8;
    mesh.placed.offsets[top] = Vec3(0, 0, 0.03);
    EditedMesh edited = mesh.edited();
    DistanceGuard guard(edited, mesh.surface);
    const EditedMesh::Mark before = edited.mark();
    ASSERT_TRUE(edited.collapse(top, top + 1));
    EXPECT_TRUE(guard.accepts(edited.changed_since(before), 0));
}

// The mesh lies 0.045 off a surface of area 1, with about two weights for each point of it: 1 % of
// the squared distances are 4e-5. The cut of the peak adds about 2e-5.
TEST(DistanceGuard, TheBudgetIsAShareOfTheDistances) {
    const auto accepts = [](double offset, double worth, bool opens) {
        Guarded mesh(peak(0.008));
        for (Vec3& by : mesh.placed.offsets) by = Vec3(0, 0, offset);
        EditedMesh edited = mesh.edited();
        DistanceGuard guard(edited, mesh.surface);
        if (opens) guard.open_budget();
        const EditedMesh::Mark before = edited.mark();
        EXPECT_TRUE(edited.collapse(at(4, 4), at(5, 4)));
        return guard.accepts(edited.changed_since(before), worth);
    };
    EXPECT_FALSE(accepts(0, 2e-3, true));
    EXPECT_FALSE(accepts(-0.045, 0, true));
    EXPECT_FALSE(accepts(-0.045, 2e-3, false));
    EXPECT_TRUE(accepts(-0.045, 2e-3, true));
}

TEST(HarmOf, GoodTrianglesDoNoneAndBadOnesMost) {
    using remesh::detail::harm_of;
    EXPECT_EQ(harm_of(0.75), 0);
    EXPECT_EQ(harm_of(1), 0);
    EXPECT_EQ(harm_of(0.25), 0.125);
    EXPECT_GT(harm_of(0.1) - harm_of(0.2), 10 * (harm_of(0.6) - harm_of(0.7)));
}

}  // namespace
