// Sites that come, go and move against a fresh propagation of what is left.
#include "agvd/update/moving_sites.h"

#include <gtest/gtest.h>

#include <numeric>

#include "agvd/core/error.h"
#include "agvd/core/random.h"
#include "agvd/diagram/build_diagram.h"
#include "agvd/mesh/point_faces.h"
#include "agvd/propagation/propagate.h"
#include "support/checks.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Up to three sites moved, up to two removed, up to two added.
SiteChanges random_changes(const Surface& surface, Index count, std::uint64_t seed) {
    std::uint64_t drawn = 0;
    const auto draw = [&](std::uint64_t bound) {
        return static_cast<Index>(random_bits(seed, 0, drawn++) % bound);
    };
    const auto points = points::scattered(surface, 5, seed);
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), Index{0});
    for (Index i = count; i > 1; --i) std::swap(order[i - 1], order[draw(i)]);
    const Index num_moved = std::min(count, draw(4));
    const Index num_removed = std::min(count - num_moved, draw(3));
    SiteChanges changes;
    for (Index i = 0; i < num_moved; ++i) changes.moved.emplace_back(order[i], points[i]);
    changes.removed.assign(order.begin() + num_moved, order.begin() + num_moved + num_removed);
    changes.added.assign(points.begin() + 3, points.begin() + 3 + draw(3));
    return changes;
}

void expect_fresh(const Surface& surface, const MovingSites& moving,
                  const PropagationOptions& options) {
    checks::expect_same(moving.propagation(), propagate(surface, moving.sites(), options));
}

}  // namespace

class MovingSitesOn : public testing::TestWithParam<const char*> {};

TEST_P(MovingSitesOn, ChangesGiveWhatAFreshRunGives) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface surface = build_surface(random_meshes::make(GetParam(), seed).view());
        const SurfaceLayout layout(surface);
        const auto first = points::scattered(surface, static_cast<Index>(7 * seed), seed);
        for (const double max_error : {0.0, 1e-2}) {
            const PropagationOptions options{.max_error = max_error,
                                             .num_threads = static_cast<int>(seed % 3 + 1)};
            MovingSites moving(surface, layout, first, options);
            expect_fresh(surface, moving, options);
            for (std::uint64_t change = 0; change < 6; ++change) {
                SCOPED_TRACE("change " + std::to_string(change));
                const auto count = static_cast<Index>(moving.sites().size());
                moving.update(random_changes(surface, count, 10 * seed + change));
                ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, options));
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(RandomMeshes, MovingSitesOn, testing::ValuesIn(random_meshes::families()),
                         [](const auto& family) { return std::string(family.param); });

// Moving sites keep all windows; a fresh run gives those behind the front back.
TEST(MovingSites, FewSitesOnManyFacesHaveTheRelaysOfAFreshRun) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(120, 60), 0.01, 3).view());
    const SurfaceLayout layout(surface);
    for (const Index count : {1, 2, 5}) {
        for (const double max_error : {0.0, 1e-3}) {
            const PropagationOptions options{.max_error = max_error, .num_threads = 2};
            MovingSites moving(surface, layout, points::scattered(surface, count, 5), options);
            EXPECT_EQ(moving.propagation().mixed_faces.empty(), count == 1);
            expect_fresh(surface, moving, options);
        }
    }
}

TEST(MovingSites, OnlyNeighboursPropagateAgain) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(60, 40), 0.01, 3).view());
    const SurfaceLayout layout(surface);
    MovingSites moving(surface, layout, points::scattered(surface, 100, 5));
    EXPECT_EQ(moving.num_propagated(), 100);
    moving.update({.moved = {{7, point_at(surface, 1)}}, .removed = {}, .added = {}});
    EXPECT_GE(moving.num_propagated(), 2);
    EXPECT_LE(moving.num_propagated(), 30);
    moving.update({});
    EXPECT_EQ(moving.num_propagated(), 0);
    expect_fresh(surface, moving, {});
}

TEST(MovingSites, SitesThatChangePlacesGiveWhatAFreshRunGives) {
    for (const bool is_jittered : {false, true}) {
        const auto mesh = shapes::torus(40, 20);
        const Surface surface =
            build_surface((is_jittered ? shapes::jitter(mesh, 0.01, 3) : mesh).view());
        const SurfaceLayout layout(surface);
        MovingSites moving(surface, layout, points::scattered(surface, 60, 5));
        for (Index i = 0; i + 1 < 60; i += 7) {
            const std::vector<SurfacePoint> sites = moving.sites();
            moving.update(
                {.moved = {{i, sites[i + 1]}, {i + 1, sites[i]}}, .removed = {}, .added = {}});
            ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, {}));
        }
    }
}

TEST(MovingSites, SitesThatHideEachOtherGiveWhatAFreshRunGives) {
    const Surface surface = build_surface(shapes::torus(20, 10).view());
    const SurfaceLayout layout(surface);
    const SurfacePoint here = point_at(surface, 7), there = point_at(surface, 90);
    MovingSites moving(surface, layout, {here, here, there, here});
    moving.update({.moved = {{0, there}}, .removed = {}, .added = {}});
    ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, {}));
    moving.update({.moved = {}, .removed = {1}, .added = {here}});
    ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, {}));
    moving.update({.moved = {{0, here}, {1, here}}, .removed = {2, 3}, .added = {}});
    ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, {}));
}

TEST(MovingSites, OneOfManyOnOneSpotPropagates) {
    const Surface surface = build_surface(shapes::torus(20, 10).view());
    const SurfaceLayout layout(surface);
    const Index inner = 4;
    const SurfacePoint far = point_at(surface, 90);
    const SurfacePoint in_face{FaceId(3), {0.5, 0.25, 0.25}};
    const SurfacePoint on_edge{FaceId(Surface::face(inner)), {0, 0.25, 0.75}};
    for (const SurfacePoint& here : {point_at(surface, 7), in_face, on_edge}) {
        const std::vector<SurfacePoint> all(30, here);
        MovingSites moving(surface, layout, all);
        EXPECT_EQ(moving.num_propagated(), 1);
        ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, {}));
        const std::vector<std::pair<Index, SurfacePoint>> away{{0, far}, {7, far}};
        moving.update({.moved = away, .removed = {}, .added = {}});
        EXPECT_EQ(moving.num_propagated(), 2);
        ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, {}));
        moving.update({.moved = {}, .removed = {1, 2}, .added = {}});
        EXPECT_EQ(moving.num_propagated(), 1);
        ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, {}));
    }
}

TEST(MovingSites, AnEdgeSiteHidesItsLikeOfTheOtherFace) {
    const Surface surface = build_surface(shapes::torus(20, 10).view());
    const SurfaceLayout layout(surface);
    const Index h = 4, k = h % 3;
    SurfacePoint point{FaceId(Surface::face(h)), {0, 0, 0}};
    point.barycentric[k] = 0.25;
    point.barycentric[(k + 1) % 3] = 0.75;
    MovingSites moving(surface, layout, {point_at(surface, 90), point});
    moving.update({.moved = {}, .removed = {}, .added = {across_edge(surface, point, h), point}});
    EXPECT_EQ(moving.num_propagated(), 0);
    ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, {}));
    moving.update({.moved = {}, .removed = {1}, .added = {}});
    EXPECT_GE(moving.num_propagated(), 1);
    ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, {}));
}

// Moving sites keep all windows, a fresh run those where bounds tell of a border. Along slanted
// needles the bounds are far off, so that windows come to faces deep in what seem cells of others.
// The faces are more than one range of RelayLogs.
TEST(MovingSites, BordersFarFromWhereTheBoundsPutThemAreFresh) {
    TriangleMesh mesh = shapes::grid(150);
    for (Vec3& p : mesh.positions) p.x() += 4 * p.y();
    const Surface surface = build_surface(mesh.view());
    const SurfaceLayout layout(surface);
    for (const Index count : {5, 20}) {
        const MovingSites moving(surface, layout, points::scattered(surface, count, count));
        for (const int num_threads : {1, 3}) {
            const Propagation fresh =
                propagate(surface, moving.sites(), {.num_threads = num_threads});
            checks::expect_same(moving.propagation(), fresh);
            EXPECT_GT(fresh.num_nodes, moving.propagation().num_nodes);  // Sites that ran again.
        }
    }
}

TEST(MovingSites, GapsBetweenRelaysStaySmall) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(40, 20), 0.01, 3).view());
    const SurfaceLayout layout(surface);
    MovingSites moving(surface, layout, points::scattered(surface, 80, 5));
    const std::size_t first = moving.propagation().relays.size();
    bool has_shrunk = false;
    for (Index i = 0; i < 60; ++i) {
        const std::size_t before = moving.propagation().relays.size();
        const auto points = points::scattered(surface, 8, i);
        SiteChanges changes;
        for (Index k = 0; k < 8; ++k) changes.moved.emplace_back(10 * k + i % 10, points[k]);
        moving.update(changes);
        const std::size_t after = moving.propagation().relays.size();
        has_shrunk = has_shrunk || after < before;
        ASSERT_LE(after, 3 * first + 2000);
        ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, {}));
    }
    EXPECT_TRUE(has_shrunk);
}

TEST(MovingSites, ADiagramOfThemIsTheFreshOne) {
    const Surface surface = build_surface(shapes::torus(40, 20).view());
    const SurfaceLayout layout(surface);
    MovingSites moving(surface, layout, points::scattered(surface, 30, 1));
    moving.update({.moved = {}, .removed = {3, 0}, .added = {point_at(surface, 17)}});
    const Diagram after = build_diagram(surface, moving.sites(), moving.propagation());
    const Diagram fresh =
        build_diagram(surface, moving.sites(), propagate(surface, moving.sites()));
    ASSERT_EQ(after.edges.size(), fresh.edges.size());
    EXPECT_EQ(after.points.size(), fresh.points.size());
}

TEST(MovingSites, BadChangesAreRefusedAndNothingChanges) {
    const Surface surface = build_surface(shapes::grid(6).view());
    const SurfaceLayout layout(surface);
    const auto points = points::scattered(surface, 5, 1);
    MovingSites moving(surface, layout, points);
    const SurfacePoint off{FaceId(100000), {1, 0, 0}};
    EXPECT_THROW(moving.update({.moved = {{5, points[0]}}, .removed = {}, .added = {}}),
                 InvalidInput);
    EXPECT_THROW(moving.update({.moved = {}, .removed = {2, 2}, .added = {}}), InvalidInput);
    EXPECT_THROW(moving.update({.moved = {{1, points[0]}}, .removed = {1}, .added = {}}),
                 InvalidInput);
    EXPECT_THROW(moving.update({.moved = {}, .removed = {0}, .added = {off}}), InvalidInput);
    expect_fresh(surface, moving, {});
    EXPECT_EQ(moving.sites().size(), 5U);
    EXPECT_THROW(MovingSites(surface, layout, points, {.engine = Engine::Vertex}), InvalidOption);
    EXPECT_THROW(MovingSites(surface, layout, points, {.max_error = 2.0}), InvalidOption);
}
