// Which of the caller's sites become vertices of curves, and which curves have enough of them.
#include "remesh/sites/network_plan.h"

#include <gtest/gtest.h>

#include "agvd/mesh/closest_point.h"
#include "support/flag_edges.h"
#include "support/parts.h"

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;
using remesh::GivenNetwork;

namespace {

// A unit cube with sites at its corners, at quarters of its edges and in the middle of its sides.
struct GivenCube {
    Surface surface = agvd::build_surface(parts::box({1, 1, 1}, 4).view());
    agvd::ClosestPointTree tree{surface.mesh.view()};
    std::vector<SurfacePoint> sites;

    GivenCube() {
        for (const Vec3& p : surface.mesh.positions) {
            int on = 0;
            for (const double x : p) on += x == 0 || x == 1 ? 1 : 0;
            const bool is_middle = on == 1 && (p - Vec3(.5, .5, .5)).norm() < .6;
            if (on >= 2 || is_middle) add(p);
        }
    }
    void add(const Vec3& p) { sites.push_back(tree.query(p).point); }
    void remove(const Vec3& p) {
        std::erase_if(sites,
                      [&](const SurfacePoint& site) { return (at(site) - p).norm() < 1e-9; });
    }
    [[nodiscard]] Vec3 at(const SurfacePoint& site) const {
        return position(surface.mesh.view(), site);
    }
    [[nodiscard]] GivenNetwork plan(remesh::GivenNetworkOptions options = {}) const {
        options.spacing = .25;
        return remesh::plan_given_network(surface, flag_sharp_edges(surface), sites, options);
    }
};

}  // namespace

TEST(GivenNetwork, SitesOnEdgesAndCornersBecomeItsVertices) {
    const GivenCube cube;
    const GivenNetwork given = cube.plan();
    EXPECT_EQ(given.plan.network.curves.size(), 12u);
    EXPECT_EQ(given.dropped_curves, 0u);
    EXPECT_EQ(given.plan.dropped_length, 0);
    EXPECT_EQ(given.curves.num_groups(), 8u + 12 * 3);
    EXPECT_EQ(given.inner.size(), cube.sites.size() - 8 - 12 * 3);
    for (const Index k : given.plan.intervals) EXPECT_EQ(k, 4u);
    for (const SurfacePoint& site : given.inner) {
        const Vec3 p = cube.at(site);
        EXPECT_EQ((p - Vec3(.5, .5, .5)).cwiseAbs().maxCoeff(), .5);
    }
}

TEST(GivenNetwork, RoundingIsForgiven) {
    GivenCube cube;
    for (SurfacePoint& site : cube.sites) {
        const Vec3 off(1.3e-6, -1.1e-6, 1.2e-6);
        site = cube.tree.query(cube.at(site) + off).point;
    }
    EXPECT_EQ(cube.plan().curves.num_groups(), 8u + 12 * 3);
}

TEST(GivenNetwork, SitesOffACurveDoNotCarryIt) {
    for (const double off : {.001, .02}) {
        GivenCube cube;
        cube.remove({0, 0, 0});
        cube.add({0, off, off});
        const GivenNetwork given = cube.plan();
        EXPECT_EQ(given.dropped_curves, 3u);
        EXPECT_NEAR(given.plan.length, 9, 1e-12);
        EXPECT_NEAR(given.plan.dropped_length, 3, 1e-12);
        EXPECT_EQ(cube.plan({.tolerance = .2}).dropped_curves, 0u);
    }
}

TEST(GivenNetwork, ACurveWithALongGapIsDropped) {
    GivenCube cube;
    const auto along_x = [](double x) { return Vec3(x, 0, 1); };
    cube.remove(along_x(.25));
    cube.remove(along_x(.5));
    EXPECT_EQ(cube.plan().dropped_curves, 0u);
    cube.remove(along_x(.75));
    EXPECT_EQ(cube.plan().dropped_curves, 0u);  // Four spacings.
    const GivenNetwork finer = remesh::plan_given_network(
        cube.surface, flag_sharp_edges(cube.surface), cube.sites, {.spacing = .2});
    EXPECT_EQ(finer.dropped_curves, 1u);
    EXPECT_NEAR(finer.plan.length, 11, 1e-12);
}

TEST(GivenNetwork, OfSitesAtOnePlaceTheFirstCounts) {
    GivenCube cube;
    cube.add({1e-7, 0, 0});
    cube.add({.5, 1e-7, 0});
    const GivenNetwork given = cube.plan();
    EXPECT_EQ(given.curves.num_groups(), 8u + 12 * 3);
    EXPECT_EQ(given.inner.size(), GivenCube().plan().inner.size());
    // Those that are only near one another stay.
    cube.add({.01, 0, 0});
    cube.add({0, .51, 0});
    EXPECT_EQ(cube.plan({.tolerance = .1}).curves.num_groups(), 8u + 12 * 3 + 2);
}

TEST(GivenNetwork, WithoutTheBoundaryThereIsNone) {
    const Surface surface = agvd::build_surface(parts::open_box({1, 1, 1}, 4).view());
    std::vector<SurfacePoint> all, some;
    const agvd::ClosestPointTree tree(surface.mesh.view());
    for (const Vec3& p : surface.mesh.positions) {
        all.push_back(tree.query(p).point);
        const auto v = static_cast<Index>(all.size() - 1);
        if (!surface.is_boundary_vertex(v) || all.size() % 2 == 0) some.push_back(all.back());
    }
    const auto plan = [&](const std::vector<SurfacePoint>& sites, double spacing) {
        return remesh::plan_given_network(surface, flag_sharp_edges(surface), sites,
                                          {.spacing = spacing});
    };
    const GivenNetwork with = plan(all, .25);
    EXPECT_EQ(with.dropped_curves, 0u);
    EXPECT_EQ(with.inner.size() + with.curves.num_groups(), all.size());
    const GivenNetwork without = plan(some, .05);
    EXPECT_EQ(without.dropped_curves, 8u);
    EXPECT_TRUE(without.plan.network.curves.empty());
}
