// How sites are shared between curves and patches, and placed in both.
#include "remesh/sites/network_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/sites/relax_network.h"
#include "remesh/sites/sampling.h"
#include "remesh/sites/sites.h"
#include "support/flag_edges.h"
#include "support/parts.h"
#include "support/random_surfaces.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;
using remesh::NetworkPlan;

namespace {

NetworkPlan plan_of(const Surface& surface, Index num_sites) {
    return remesh::plan_network(surface, flag_sharp_edges(surface), num_sites);
}

Vec3 at(const NetworkPlan& plan, const SurfacePoint& site) {
    return position(plan.cut.surface().mesh.view(), site);
}

}  // namespace

TEST(NetworkPlan, CurvesAndPatchesHaveTheSameSpacing) {
    const Surface surface = agvd::build_surface(parts::box({1, 1, 1}, 4).view());
    for (const Index n : {50u, 200u, 2000u}) {
        const NetworkPlan plan = plan_of(surface, n);
        EXPECT_EQ(plan.network.curves.size(), 12u);
        EXPECT_EQ(plan.sites_for_all, 8u);
        EXPECT_NEAR(plan.length, 12, 1e-12);
        EXPECT_EQ(plan.dropped_length, 0);
        EXPECT_EQ(plan.cut.surface().num_faces(), surface.num_faces());
        // A mesh of equilateral triangles: N - 2 = F / 2.
        const double ideal = std::sqrt(6 * 2 / std::sqrt(3.) / (n - 2));
        EXPECT_NEAR(plan.spacing / ideal, 1, 0.1);
        for (const Index k : plan.intervals) EXPECT_NEAR(k * plan.spacing, 1, plan.spacing / 2);
        EXPECT_LT(remesh::num_curve_vertices(plan.network, plan.intervals), n);
    }
}

// Walls that are far thinner than the spacing have no inner sites, and not less than none.
TEST(NetworkPlan, NarrowPatchesTakeNoSitesFromOthers) {
    const Surface surface = agvd::build_surface(parts::box({10, 10, 0.02}, 4).view());
    for (const Index n : {300u, 1000u}) {
        const double spacing = plan_of(surface, n).spacing;
        const double on_curves = 80 / spacing;
        const double inside = 100 / (std::sqrt(3.) / 2 * spacing * spacing) - 40 / (2 * spacing);
        EXPECT_NEAR((on_curves + 2 * inside) / n, 1, 0.04);
    }
}

TEST(NetworkPlan, ShortCreasesGoFirstWhereSitesAreTooFew) {
    const Surface surface = agvd::build_surface(parts::box({4, 3, 1}, 2).view());
    const NetworkPlan plan = plan_of(surface, 7);
    EXPECT_EQ(plan.sites_for_all, 8u);
    EXPECT_GT(plan.dropped_length, 0);
    EXPECT_NEAR(plan.length + plan.dropped_length, 4 * (4 + 3 + 1), 1e-12);
    EXPECT_LE(remesh::num_curve_vertices(plan.network, plan.intervals), 7u);
    // Four edges of length 1 are the shortest.
    EXPECT_NEAR(plan.length + std::round(plan.dropped_length), 32, 1e-12);
    double longest = 0;
    for (const auto& curve : plan.network.curves) longest = std::max(longest, curve.length());
    EXPECT_GE(longest, 4);
    const NetworkPlan none = plan_of(surface, 1);
    EXPECT_TRUE(none.network.curves.empty());
    EXPECT_NEAR(none.dropped_length, 32, 1e-12);
    EXPECT_EQ(none.sites_for_all, 8u);
}

// Of a boundary with steps finer than the mean spacing, those where lengths are short are nodes.
TEST(NetworkPlan, CornersAreFoundByTheLengthsThere) {
    agvd::TriangleMesh mesh = shapes::grid(16);
    for (Vec3& p : mesh.positions) {  // The lower side gets teeth.
        if (p.y() == 0 && std::lround(16 * p.x()) % 2 == 1) p.y() = 1. / 32;
    }
    const Surface surface = agvd::build_surface(mesh.view());
    const auto base = std::make_shared<const agvd::IntrinsicTriangulation>(
        surface, agvd::IntrinsicOptions{.max_length = 0.05});
    std::vector<double> length;
    for (const Vec3& p : base->surface().mesh.positions) length.push_back(0.01 + 0.5 * p.x());
    const remesh::SizeField field(base, length);
    const std::vector<std::uint8_t> none(surface.num_edges(), 0);
    const auto count_teeth = [&](const NetworkPlan& plan, double from, double to) {
        return std::ranges::count_if(plan.network.nodes, [&](Index v) {
            const Vec3& p = surface.mesh.positions[v];
            return p.y() < 0.05 && p.x() > from && p.x() < to;
        });
    };
    const auto num_sites = static_cast<Index>(2 / std::sqrt(3.) * field.area());
    const NetworkPlan even = remesh::plan_network(surface, none, 30);
    EXPECT_EQ(count_teeth(even, 0.01, 0.99), 0);
    const NetworkPlan graded = remesh::plan_network(surface, none, num_sites, {}, 0, {}, &field);
    EXPECT_EQ(count_teeth(graded, 0.03, 0.22), 3);
    EXPECT_EQ(count_teeth(graded, 0.5, 0.97), 0);
}

TEST(NetworkPlan, WithoutCreasesItHasTheBoundary) {
    const NetworkPlan sheet = plan_of(agvd::build_surface(shapes::grid(4).view()), 100);
    EXPECT_EQ(sheet.network.curves.size(), 4u);
    EXPECT_EQ(sheet.sites_for_all, 4u);
    EXPECT_EQ(sheet.length, 0);
    EXPECT_EQ(sheet.dropped_length, 0);
    const NetworkPlan closed = plan_of(agvd::build_surface(shapes::sphere(2).view()), 100);
    EXPECT_TRUE(closed.network.curves.empty());
    EXPECT_EQ(closed.sites_for_all, 0u);
}

TEST(SampleInnerSites, PatchesGetTheirShareOffTheirRim) {
    const Surface surface = agvd::build_surface(parts::box({1, 1, 1}, 4).view());
    const NetworkPlan plan = plan_of(surface, 300);
    const remesh::CurveSites curves = remesh::curve_sites_at(plan.network, plan.cut, plan.along);
    const Index count = 300 - curves.num_groups();
    const remesh::Topology patches = remesh::analyze_topology(plan.cut.surface().mesh.view());
    for (const auto init : {remesh::Init::BlueNoise, remesh::Init::Farthest}) {
        const auto sites = remesh::sample_inner_sites(plan.cut.surface(), curves.sites, count,
                                                      plan.spacing, {.init = init, .seed = 3});
        ASSERT_EQ(sites.size(), count);
        std::vector<Index> in_patch(6, 0);
        double nearest = 1;
        for (const SurfacePoint& s : sites) {
            ++in_patch[patches.face_component[s.face.value()]];
            EXPECT_FALSE(agvd::is_on_boundary(plan.cut.surface(), s));
            for (const SurfacePoint& rim : curves.sites) {
                nearest = std::min(nearest, (at(plan, s) - at(plan, rim)).norm());
            }
        }
        for (const Index n : in_patch) EXPECT_NEAR(n, count / 6., 1);
        EXPECT_GT(nearest, 0.3 * plan.spacing);
    }
}

TEST(SampleInnerSites, PatchesThatLackNoneGetNoneButWhereAllAreSo) {
    // Two plates and four strips narrower than the spacing.
    const Surface surface = agvd::build_surface(parts::box({1, 1, .02}, 4).view());
    const NetworkPlan plan = plan_of(surface, 300);
    const remesh::Topology patches = remesh::analyze_topology(plan.cut.surface().mesh.view());
    const auto sites = remesh::sample_inner_sites(plan.cut.surface(), {}, 100, plan.spacing, {});
    ASSERT_EQ(sites.size(), 100u);
    for (const SurfacePoint& s : sites) {
        EXPECT_EQ(plan.cut.surface().mesh.triangles.size(), surface.mesh.triangles.size());
        const double z = at(plan, s).z();
        EXPECT_TRUE(std::abs(z) < 1e-12 || std::abs(z - .02) < 1e-12);
    }
    EXPECT_EQ(remesh::sample_inner_sites(plan.cut.surface(), {}, 7, 50, {}).size(), 7u);
}

TEST(RelaxNetwork, InnerSitesFollowEachOtherInSpace) {
    const Surface surface = agvd::build_surface(shapes::sphere(5).view());
    const NetworkPlan plan = plan_of(surface, 1000);
    const remesh::PreparedSurface prepared(plan.cut.surface(), plan.spacing);
    for (const int steps : {0, 10}) {
        const remesh::NetworkSites made =
            remesh::sample_network_sites(prepared, plan, {.num_samples = 1000}, {.steps = steps});
        ASSERT_EQ(made.sites.size(), 1000u);
        EXPECT_EQ(made.levels.size(), steps == 0 ? 0u : 2u);
        double sum = 0;
        for (Index i = 1; i < 1000; ++i) {
            sum += (at(plan, made.sites[i]) - at(plan, made.sites[i - 1])).norm();
        }
        EXPECT_LT(sum / 999, 2 * plan.spacing);
    }
}

// A coarse level of 106 sites would have 9 neighbours for each.
TEST(RelaxNetwork, ThereIsNoCoarseLevelWithFewSitesForTheHandles) {
    const Surface surface =
        agvd::build_surface(shapes::subdivide(random_surfaces::lattice(4, 2, 1)).view());
    const auto num_levels = [&](Index n) {
        const std::vector<std::uint8_t> none(surface.num_edges(), 0);
        const NetworkPlan plan = remesh::plan_network(surface, none, n);
        const remesh::PreparedSurface prepared(plan.cut.surface(), plan.spacing);
        return remesh::sample_network_sites(prepared, plan, {.num_samples = n}, {.steps = 10})
            .levels.size();
    };
    EXPECT_EQ(num_levels(600), 1u);
    EXPECT_EQ(num_levels(1000), 2u);
}

TEST(RelaxNetwork, SitesOfCurvesStayOnThemAndTogether) {
    const Surface surface = agvd::build_surface(parts::capped_cylinder(64, 6).view());
    const NetworkPlan plan = plan_of(surface, 400);
    const remesh::PreparedSurface prepared(plan.cut.surface(), plan.spacing);
    for (const int steps : {0, 10}) {
        const remesh::NetworkSites made =
            remesh::sample_network_sites(prepared, plan, {.num_samples = 400}, {.steps = steps});
        const auto& curves = made.curves;
        ASSERT_EQ(made.sites.size(), 400 - curves.num_groups() + curves.sites.size());
        EXPECT_EQ(made.levels.empty(), steps == 0);
        for (const auto& level : made.levels) EXPECT_LT(level.energy.back(), level.energy.front());
        for (Index g = 0; g < curves.num_groups(); ++g) {
            const Vec3 first = at(plan, made.sites[curves.first_copy[g]]);
            for (Index copy = curves.first_copy[g]; copy < curves.first_copy[g + 1]; ++copy) {
                EXPECT_EQ(made.sites[copy], curves.sites[copy]);
                EXPECT_LT((at(plan, made.sites[copy]) - first).norm(), 1e-12);
            }
        }
        // Neighbours stay in order and apart.
        for (std::size_t c = 0; c < plan.network.curves.size(); ++c) {
            const Index begin = curves.first_of_curve[c], end = curves.first_of_curve[c + 1];
            EXPECT_EQ(end - begin, plan.intervals[c]);
            const double mean = plan.network.curves[c].length() / plan.intervals[c];
            for (Index g = begin; g + 1 < end; ++g) {
                EXPECT_GT(curves.along[g + 1] - curves.along[g], 0.49 * mean);
            }
        }
        for (std::size_t i = curves.sites.size(); i < made.sites.size(); ++i) {
            EXPECT_FALSE(agvd::is_on_boundary(plan.cut.surface(), made.sites[i]));
        }
    }
}

// Long locked edges are divided while sites relax: else sites move onto the edges.
TEST(RelaxNetwork, SitesKeepOffLongLockedEdges) {
    const Surface surface = agvd::build_surface(shapes::grid(1).view());
    remesh::LockedElements locked{.vertices = {0, 1, 2, 3}, .is_edge = {}};
    locked.is_edge.assign(surface.num_edges(), 0);
    for (const Index h : surface.edge_half) {
        if (surface.twin[h] == agvd::no_index) locked.is_edge[surface.edge[h]] = 1;
    }
    const std::vector<std::uint8_t> none(surface.num_edges(), 0);
    const NetworkPlan plan = remesh::plan_network(surface, none, 100, {}, 1, {}, nullptr, locked);
    const remesh::PreparedSurface prepared(plan.cut.surface(), plan.spacing);
    const remesh::NetworkSites made =
        remesh::sample_network_sites(prepared, plan, {.num_samples = 100}, {.steps = 60});
    ASSERT_EQ(made.sites.size(), 100u);
    EXPECT_EQ(made.curves.sites.size(), 4u);
    const auto on_each = static_cast<std::size_t>(std::round(1 / plan.spacing)) - 1;
    ASSERT_GT(on_each, 5u);
    EXPECT_EQ(made.dividing.size(), 4 * on_each);
    EXPECT_EQ(made.divided_chain.size(), 4 * (on_each + 1));
    const auto distance_to_rim = [&](const SurfacePoint& site) {
        const Vec3 p = at(plan, site);
        return std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()});
    };
    for (std::size_t i = 4; i < 100; ++i) {
        EXPECT_GT(distance_to_rim(made.sites[i]), 0.4 * plan.spacing);
    }
    for (const SurfacePoint& site : made.dividing) EXPECT_LT(distance_to_rim(site), 1e-12);
    std::set<Index> from, to;
    for (const auto& [a, b] : made.divided_chain) {
        from.insert(a);
        to.insert(b);
    }
    EXPECT_EQ(from, to);
    EXPECT_EQ(from.size(), 4 * (on_each + 1));
    EXPECT_EQ(*from.rbegin(), 99 + made.dividing.size());
    const auto plain =
        remesh::sample_network_sites(prepared, plan, {.num_samples = 100}, {.steps = 0});
    EXPECT_TRUE(plain.dividing.empty());
}

TEST(RelaxNetwork, ThreadsChangeNothing) {
    const Surface surface = agvd::build_surface(parts::extruded_l(4).view());
    const NetworkPlan plan = plan_of(surface, 300);
    const remesh::PreparedSurface prepared(plan.cut.surface(), plan.spacing);
    const auto with = [&](int threads) {
        return remesh::sample_network_sites(prepared, plan,
                                            {.num_samples = 300, .num_threads = threads},
                                            {.num_threads = threads})
            .sites;
    };
    const auto one = with(1);
    EXPECT_EQ(with(2), one);
    EXPECT_EQ(with(8), one);
}
