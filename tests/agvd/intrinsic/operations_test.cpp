#include "agvd/intrinsic/operations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "agvd/intrinsic/simplify_steps.h"
#include "agvd/mesh/surface.h"
#include "support/shapes.h"

using namespace agvd;
using detail::FaceCharts;

namespace {

double length_between(const Surface& surface, Index a, Index b) {
    double found = -1;
    for_each_outgoing(surface, a, [&](Index h) {
        if (surface.head(h) == b) found = surface.length_of(h);
        if (surface.tail(Surface::previous(h)) == b)
            found = surface.length_of(Surface::previous(h));
    });
    return found;
}

// Apexes fit the lengths, twins fit each other, corners fit both.
void expect_sound(const Surface& surface) {
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (surface.mesh.triangles[f][0] == no_index) continue;
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const Index twin = surface.twin[h];
            if (twin != no_index) {
                EXPECT_EQ(surface.twin[twin], h);
                EXPECT_EQ(surface.tail(twin), surface.head(h));
                EXPECT_EQ(surface.edge[twin], surface.edge[h]);
            }
            EXPECT_NEAR(surface.apex[h].norm(), surface.length_of(Surface::previous(h)), 1e-12);
            EXPECT_NE(surface.outgoing[surface.tail(h)], no_index);
        }
    }
}

}  // namespace

TEST(VertexOperations, AVertexInsertedInAFaceHasItsDistancesToTheCornersAndGoesWithoutATrace) {
    Surface surface = build_surface(shapes::grid(2).view());
    const Surface before = surface;
    FaceCharts charts(surface);
    const Triangle corners = surface.mesh.triangles[3];
    const Index v = detail::add_vertex(surface);
    detail::insert_in_face(surface, charts, 3, {0.2, 0.3, 0.5}, v);
    expect_sound(surface);
    const Vec3 place = position(before.mesh.view(), {FaceId(3), {0.2, 0.3, 0.5}});
    for (const Index c : corners) {
        EXPECT_NEAR(length_between(surface, v, c), (before.mesh.positions[c] - place).norm(),
                    1e-15);
    }
    EXPECT_NEAR(detail::cone_angle(surface, v), 2 * std::numbers::pi, 1e-12);

    detail::remove_from_face(surface, charts, surface.outgoing[v]);
    expect_sound(surface);
    EXPECT_EQ(surface.outgoing[v], no_index);
    for (const Index c : corners) {
        EXPECT_NEAR(detail::cone_angle(surface, c), detail::cone_angle(before, c), 1e-12);
    }
}

TEST(VertexOperations, ABoundaryVertexOfTwoFacesLeavesOneFace) {
    // Of the two faces of a square, the diagonal's ends have two.
    Surface surface = build_surface(shapes::grid(1).view());
    FaceCharts charts(surface);
    const Index v = surface.tail(surface.edge_half[0]);
    Index two = no_index;
    for (Index w = 0; w < 4; ++w) {
        Index faces = 0;
        for_each_outgoing(surface, w, [&](Index) { ++faces; });
        if (faces == 2) two = w;
    }
    ASSERT_NE(two, no_index) << v;
    detail::remove_from_boundary(surface, charts, surface.outgoing[two], std::numbers::sqrt2);
    expect_sound(surface);
    Index left = 0;
    for (const Triangle& t : surface.mesh.triangles) left += t[0] != no_index ? 1 : 0;
    EXPECT_EQ(left, 1u);
    EXPECT_TRUE(surface.is_boundary_vertex((two + 1) % 4));
}

TEST(Flatten, ACubesCornerBecomesFlatAndTheOtherLengthsStay) {
    Surface surface = build_surface(shapes::cube().view());
    const Surface before = surface;
    FaceCharts charts(surface);
    for (Index f = 0; f < surface.num_faces(); ++f) (void)charts.of(f);
    EXPECT_NEAR(detail::cone_angle(surface, 0), 1.5 * std::numbers::pi, 1e-12);
    ASSERT_TRUE(detail::flatten(surface, charts, 0, 2 * std::numbers::pi));
    EXPECT_NEAR(detail::cone_angle(surface, 0), 2 * std::numbers::pi, 1e-9);
    double ratio = 0;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        if (surface.tail(h) != 0 && surface.head(h) != 0) {
            EXPECT_EQ(surface.length[e], before.length[e]);
            continue;
        }
        if (ratio == 0) ratio = surface.length[e] / before.length[e];
        EXPECT_NEAR(surface.length[e] / before.length[e], ratio, 1e-12);
        EXPECT_LT(ratio, 1);
    }
    expect_sound(surface);
    for (Index f = 0; f < surface.num_faces(); ++f) {
        for (Index k = 0; k < 3; ++k) {
            EXPECT_NEAR(charts.of(f).side[k].norm(), surface.length_of(3 * f + k), 1e-12);
        }
    }
}

TEST(Flatten, NothingChangesWhereNoFactorWillDo) {
    // A tetrahedron's corner: the scaled edges would be shorter than half of those opposite.
    Surface surface = build_surface(shapes::tetrahedron().view());
    const std::vector<double> before = surface.length;
    FaceCharts charts(surface);
    EXPECT_FALSE(detail::flatten(surface, charts, 0, 3.2 * std::numbers::pi));
    EXPECT_EQ(surface.length, before);
}

TEST(Simplicial, EdgesAreFoundByTheirEnds) {
    const Surface surface = build_surface(shapes::grid(3).view());
    for (Index a = 0; a < surface.num_vertices(); ++a) {
        for (Index b = 0; b < surface.num_vertices(); ++b) {
            if (a == b) continue;
            EXPECT_EQ(detail::has_edge(surface, a, b), length_between(surface, a, b) >= 0);
        }
    }
    EXPECT_TRUE(detail::edges_to_cut(surface).empty());
}

// A flip away from a tip of three faces leaves two edges with the same ends, the next one a loop.
TEST(Simplicial, LoopsAndAllButOneOfEqualEdgesAreToBeCut) {
    Surface surface = build_surface(shapes::tetrahedron().view());
    FaceCharts charts(surface);
    const auto flip_at_tip = [&] {
        const Index h = surface.outgoing[0];
        const Index edge = surface.edge[h];
        detail::flip(surface, charts, h, detail::quad_at(surface, charts, h));
        return edge;
    };
    const auto ends = [&](Index edge) {
        const Index h = surface.edge_half[edge];
        return std::minmax({surface.tail(h), surface.head(h)});
    };
    const Index second = flip_at_tip();
    std::vector<Index> cut = detail::edges_to_cut(surface);
    ASSERT_EQ(cut.size(), 1u);
    EXPECT_EQ(ends(cut[0]), ends(second));
    const Index loop = flip_at_tip();
    EXPECT_EQ(ends(loop).first, ends(loop).second);
    const Index pair = cut[0];
    cut = detail::edges_to_cut(surface);
    const std::vector<Index> expected{std::min(pair, loop), std::max(pair, loop)};
    EXPECT_EQ(cut, expected);
}

TEST(Simplicial, OneEdgeOfTwoFacesWithTheSameCornersIsToBeCut) {
    TriangleMesh doubled;
    doubled.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    doubled.triangles = {{0, 1, 2}, {1, 0, 2}};
    EXPECT_EQ(detail::edges_to_cut(build_surface(doubled.view())).size(), 1u);
}
