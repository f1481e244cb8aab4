// Each way in which cells can break the closed-ball property, on the smallest shape that has it.
#include "remesh/dual/closed_ball.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::SiteId;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;
using remesh::ClosedBallViolation;
using remesh::SiteReason;

namespace {

struct Scene {
    Surface surface;
    std::vector<SurfacePoint> sites;

    [[nodiscard]] Vec3 at(const SurfacePoint& point) const {
        return position(surface.mesh.view(), point);
    }
    [[nodiscard]] std::vector<ClosedBallViolation> violations() const {
        const agvd::Propagation propagation = propagate(surface, sites, {.max_error = 0});
        return remesh::find_closed_ball_violations(surface,
                                                   build_diagram(surface, sites, propagation));
    }
};

// A site at the vertex nearest to each place.
Scene scene_of(const agvd::TriangleMesh& mesh, const std::vector<Vec3>& places) {
    Scene scene{build_surface(mesh.view()), {}};
    for (const Vec3& place : places) {
        Index nearest = 0;
        for (Index v = 0; v < scene.surface.num_vertices(); ++v) {
            const auto& p = scene.surface.mesh.positions;
            if ((p[v] - place).norm() < (p[nearest] - place).norm()) nearest = v;
        }
        const Index h = scene.surface.outgoing[nearest];
        SurfacePoint site{agvd::FaceId(Surface::face(h)), {0, 0, 0}};
        site.barycentric[h % 3] = 1;
        scene.sites.push_back(site);
    }
    return scene;
}

// A sphere drawn out to so many times its length along z.
agvd::TriangleMesh spindle(double length) {
    agvd::TriangleMesh mesh = shapes::sphere(3);
    for (Vec3& p : mesh.positions) p.z() *= length;
    return mesh;
}

// The unit square's grid drawn out along x.
agvd::TriangleMesh strip(double length) {
    agvd::TriangleMesh mesh = shapes::grid(8);
    for (Vec3& p : mesh.positions) p.x() *= length;
    return mesh;
}

std::vector<SiteReason> reasons_of(const std::vector<ClosedBallViolation>& violations) {
    std::vector<SiteReason> reasons;
    for (const ClosedBallViolation& v : violations) reasons.push_back(v.reason);
    std::sort(reasons.begin(), reasons.end());
    return reasons;
}

using Reasons = std::vector<SiteReason>;

TEST(ClosedBall, HoldsForManySites) {
    Scene scene{build_surface(shapes::sphere(3).view()), {}};
    scene.sites = agvd::uniform_points(scene.surface, 100, 1);
    EXPECT_EQ(reasons_of(scene.violations()), Reasons{});
}

TEST(ClosedBall, OneSiteCoversItsComponentAndAsksForOneOnTheFarSide) {
    const Scene scene = scene_of(spindle(3), {{0, 0, 3}});
    const auto violations = scene.violations();
    ASSERT_EQ(reasons_of(violations), Reasons{SiteReason::WholeComponent});
    EXPECT_EQ(violations[0].site, SiteId(0));
    ASSERT_EQ(violations[0].remedies.size(), 1u);
    EXPECT_LT(scene.at(violations[0].remedies[0]).z(), -2.9);
}

TEST(ClosedBall, ASiteOwnsATorusHoweverSmallItIsBesideOtherComponents) {
    constexpr double scale = 1e-11;
    agvd::TriangleMesh torus = shapes::torus(12, 8);
    for (Vec3& p : torus.positions) p = scale * p + Vec3(3, 0, 0);
    Scene scene{build_surface(shapes::join(torus, shapes::sphere(3)).view()), {}};
    const auto first_of_sphere = static_cast<Index>(torus.triangles.size());
    scene.sites = {{agvd::FaceId(0), {0.2, 0.3, 0.5}},
                   {agvd::FaceId(first_of_sphere), {0.2, 0.3, 0.5}},
                   {agvd::FaceId(first_of_sphere), {0.2, 0.3, 0.5}}};  // Owns nothing.
    const auto violations = scene.violations();
    ASSERT_EQ(reasons_of(violations),
              (Reasons{SiteReason::WholeComponent, SiteReason::WholeComponent}));
    EXPECT_EQ(violations[0].site, SiteId(0));
    EXPECT_EQ(violations[1].site, SiteId(1));
}

TEST(ClosedBall, ThreeSitesInARowOnASpindleMakeARingBetweenTwoClosedCurves) {
    const Scene scene = scene_of(spindle(6), {{0, 0, 6}, {1, 0, 0}, {0, 0, -6}});
    const auto violations = scene.violations();
    ASSERT_EQ(reasons_of(violations),
              (Reasons{SiteReason::NoDisc, SiteReason::ClosedCurve, SiteReason::ClosedCurve}));
    for (const ClosedBallViolation& v : violations) {
        ASSERT_EQ(v.remedies.size(), 1u);
        // The ring's site is at x = 1: farthest from it is the other side.
        EXPECT_LT(scene.at(v.remedies[0]).x(), 0);
        EXPECT_EQ(v.reason == SiteReason::NoDisc, !v.other.is_valid());
        EXPECT_TRUE(v.site == SiteId(1) || v.other == SiteId(1));
    }
}

TEST(ClosedBall, ThreeSitesAroundASphereHaveTwoVoronoiVerticesWithTheSameCells) {
    const Scene scene = scene_of(spindle(1), {{1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}});
    const auto violations = scene.violations();
    ASSERT_EQ(reasons_of(violations), Reasons{SiteReason::SameThirdCell});
    EXPECT_EQ(violations[0].site, SiteId(0));
    EXPECT_EQ(violations[0].other, SiteId(1));
    // At one of the poles.
    ASSERT_EQ(violations[0].remedies.size(), 1u);
    EXPECT_GT(std::abs(scene.at(violations[0].remedies[0]).z()), 0.9);
}

TEST(ClosedBall, TwoCellsOnBothSidesOfASpindleMeetInTwoArcs) {
    const Scene scene = scene_of(spindle(6), {{1, 0, 0}, {-1, 0, 0}, {0, 0, 6}, {0, 0, -6}});
    const auto violations = scene.violations();
    ASSERT_EQ(reasons_of(violations), (Reasons{SiteReason::SeveralArcs, SiteReason::SameThirdCell,
                                               SiteReason::SameThirdCell}));
    for (const ClosedBallViolation& v : violations) {
        EXPECT_EQ(v.site, SiteId(0));
        EXPECT_EQ(v.other, SiteId(1));
        ASSERT_EQ(v.remedies.size(), 1u);
        // On the bisector of the two.
        EXPECT_NEAR(scene.at(v.remedies[0]).x(), 0, 0.1);
    }
}

// The two sites stand 120 degrees apart, so that one arc lies on the side where they are farther
// from it, between the longer reaches of the other cells.
TEST(ClosedBall, OfTwoArcsTheShorterOneIsBroken) {
    const Scene scene = scene_of(spindle(6), {{1, 0, 0}, {-0.5, -0.87, 0}, {0, 0, 6}, {0, 0, -6}});
    const auto violations = scene.violations();
    const auto several = std::find_if(
        violations.begin(), violations.end(),
        [](const ClosedBallViolation& v) { return v.reason == SiteReason::SeveralArcs; });
    ASSERT_NE(several, violations.end());
    EXPECT_GT(scene.at(several->remedies.at(0)).y(), 0.5);
}

// One loop bounds the cell, but it is a torus with a hole.
TEST(ClosedBall, ACellWithAHandleIsNoDisc) {
    agvd::TriangleMesh mesh = shapes::torus(16, 8);
    mesh.positions[0] *= 8;
    const Vec3 far_side = -mesh.positions[0];
    const Scene scene = scene_of(mesh, {mesh.positions[0], far_side});
    const auto violations = scene.violations();
    ASSERT_EQ(reasons_of(violations), (Reasons{SiteReason::NoDisc, SiteReason::ClosedCurve}));
    EXPECT_EQ(violations[0].site, SiteId(1));
}

TEST(ClosedBall, AnArcAcrossAStripCutsItApart) {
    const Scene scene = scene_of(strip(6), {{0, 0.5, 0}, {6, 0.5, 0}});
    const auto violations = scene.violations();
    ASSERT_EQ(reasons_of(violations), Reasons{SiteReason::BoundaryAtBothEnds});
    EXPECT_TRUE(violations[0].is_at_boundary);
    ASSERT_EQ(violations[0].remedies.size(), 2u);
    double low = 1, high = 0;
    for (const SurfacePoint& remedy : violations[0].remedies) {
        EXPECT_NEAR(scene.at(remedy).x(), 3, 1e-9);
        low = std::min(low, scene.at(remedy).y());
        high = std::max(high, scene.at(remedy).y());
    }
    EXPECT_EQ(low, 0);
    EXPECT_EQ(high, 1);
}

TEST(ClosedBall, ACellInTheMiddleOfAStripMeetsTheBoundaryTwice) {
    const Scene scene = scene_of(strip(6), {{0, 0.5, 0}, {3, 0.5, 0}, {6, 0.5, 0}});
    const auto violations = scene.violations();
    ASSERT_EQ(reasons_of(violations),
              (Reasons{SiteReason::BoundaryAtBothEnds, SiteReason::BoundaryAtBothEnds,
                       SiteReason::BoundaryTwice}));
    for (const ClosedBallViolation& v : violations) {
        EXPECT_TRUE(v.is_at_boundary);
        if (v.reason != SiteReason::BoundaryTwice) continue;
        EXPECT_EQ(v.site, SiteId(1));
        EXPECT_FALSE(v.other.is_valid());
        ASSERT_EQ(v.remedies.size(), 1u);
        const double y = scene.at(v.remedies[0]).y();
        EXPECT_TRUE(y == 0 || y == 1) << y;
    }
}

// Around each pole four cells meet in one point: a Voronoi edge of no length joins two of them,
// the same two at both poles.
TEST(ClosedBall, EdgesOfNoLengthAreNoArcs) {
    const Scene scene = scene_of(spindle(1), {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}});
    EXPECT_EQ(reasons_of(scene.violations()), Reasons{});
}

TEST(SiteReason, EachHasATextOfItsOwn) {
    std::vector<std::string> texts;
    std::set<std::string> where;
    for (int i = 0; i <= static_cast<int>(SiteReason::SelfIntersection); ++i) {
        texts.emplace_back(to_text(static_cast<SiteReason>(i)));
        where.emplace(where_text(static_cast<SiteReason>(i)));
    }
    EXPECT_EQ(where.size(), 10u);
    EXPECT_EQ(texts.size(), 10u);
    EXPECT_TRUE(std::is_sorted(texts.begin(), texts.end()));
    EXPECT_EQ(std::adjacent_find(texts.begin(), texts.end()), texts.end());
}

}  // namespace
