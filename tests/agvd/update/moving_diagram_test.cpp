// A diagram whose sites come, go and move against a fresh one of what is left.
#include "agvd/update/moving_diagram.h"

#include <gtest/gtest.h>

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

void expect_fresh(const Surface& surface, const MovingDiagram& moving,
                  const PropagationOptions& options) {
    const std::vector<SurfacePoint>& sites = moving.sites().sites();
    checks::expect_same(moving.diagram(),
                        build_diagram(surface, sites, propagate(surface, sites, options)));
}

// Two sites moved, to vertices or anywhere, one added, and every third time one removed.
SiteChanges some_changes(const Surface& surface, Index count, std::uint64_t seed) {
    const auto points = points::scattered(surface, 3, seed);
    SiteChanges changes;
    if (count < 3) {
        changes.added = points;
        return changes;
    }
    const Index first = static_cast<Index>(random_bits(seed, 0, 0) % (count - 2));
    const Index vertex = surface.mesh.triangles[points[0].face.value()][0];
    changes.moved.emplace_back(first, points[0]);
    changes.moved.emplace_back(first + 1, point_at(surface, vertex));
    changes.added.push_back(points[2]);
    if (seed % 3 == 0) changes.removed.push_back(first + 2);
    return changes;
}

}  // namespace

class MovingDiagramOn : public testing::TestWithParam<const char*> {};

TEST_P(MovingDiagramOn, ChangesGiveWhatAFreshRunGives) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface surface = build_surface(random_meshes::make(GetParam(), seed).view());
        const SurfaceLayout layout(surface);
        const PropagationOptions options{.max_error = 1e-2,
                                         .num_threads = static_cast<int>(seed % 3 + 1)};
        MovingDiagram moving(surface, layout,
                             points::scattered(surface, static_cast<Index>(20 * (seed + 1)), seed),
                             options, {.num_threads = options.num_threads});
        expect_fresh(surface, moving, options);
        for (std::uint64_t change = 1; change <= 6; ++change) {
            SCOPED_TRACE("change " + std::to_string(change));
            const auto count = static_cast<Index>(moving.sites().sites().size());
            moving.update(some_changes(surface, count, 10 * seed + change));
            ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, options));
        }
    }
}

// Rough distances tear cells apart: islands come and go.
TEST_P(MovingDiagramOn, ChangesOfRoughDiagramsGiveWhatAFreshRunGives) {
    const Surface surface = build_surface(random_meshes::make(GetParam(), 11).view());
    const SurfaceLayout layout(surface);
    const PropagationOptions options{.max_error = 0.5};
    MovingDiagram moving(surface, layout, points::scattered(surface, 60, 3), options);
    expect_fresh(surface, moving, options);
    for (std::uint64_t change = 1; change <= 12; ++change) {
        SCOPED_TRACE("change " + std::to_string(change));
        const auto count = static_cast<Index>(moving.sites().sites().size());
        moving.update(some_changes(surface, count, 100 + change));
        ASSERT_NO_FATAL_FAILURE(expect_fresh(surface, moving, options));
    }
}

INSTANTIATE_TEST_SUITE_P(RandomMeshes, MovingDiagramOn,
                         testing::ValuesIn(random_meshes::families()),
                         [](const auto& family) { return std::string(family.param); });

TEST(MovingDiagram, SitesThatStepFromVertexToVertexGiveWhatAFreshRunGives) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(60, 40), 0.01, 3).view());
    const SurfaceLayout layout(surface);
    MovingDiagram moving(surface, layout, points::scattered(surface, 100, 5));
    for (Index i = 0; i < 10; ++i) {
        const Index vertex = static_cast<Index>(random_bits(7, 0, i) % surface.num_vertices());
        moving.update({.moved = {{i, point_at(surface, vertex)}}, .removed = {}, .added = {}});
        expect_fresh(surface, moving, {});
        moving.update({});
        expect_fresh(surface, moving, {});
    }
}

// Where most of what is kept is of no use any more, it begins anew.
TEST(MovingDiagram, WhenMostSitesAreRemovedTheRestIsAsAFreshRunGives) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(60, 40), 0.01, 3).view());
    const SurfaceLayout layout(surface);
    MovingDiagram moving(surface, layout, points::scattered(surface, 500, 5));
    SiteChanges changes;
    for (Index i = 0; i < 490; ++i) changes.removed.push_back(i);
    moving.update(changes);
    expect_fresh(surface, moving, {});
    moving.update({.moved = {{2, point_at(surface, 7)}}, .removed = {5}, .added = {}});
    expect_fresh(surface, moving, {});
    moving.update({.moved = {}, .removed = {}, .added = points::scattered(surface, 300, 9)});
    expect_fresh(surface, moving, {});
}

TEST(MovingDiagram, SitesOnOneSpotGiveWhatAFreshRunGives) {
    const Surface surface = build_surface(shapes::grid(12).view());
    const SurfaceLayout layout(surface);
    MovingDiagram moving(surface, layout, points::scattered(surface, 8, 5));
    const SurfacePoint inside{FaceId(40), {0.3, 0.3, 0.4}};
    const SurfacePoint on_edge{FaceId(41), {0.5, 0.5, 0}};
    for (const SurfacePoint& spot : {inside, on_edge, point_at(surface, 30)}) {
        for (const Index site : {5, 2, 7}) {
            moving.update({.moved = {{site, spot}}, .removed = {}, .added = {}});
            expect_fresh(surface, moving, {});
        }
        // Of those on the spot the first goes: the next one speaks.
        moving.update({.moved = {}, .removed = {2}, .added = {spot}});
        expect_fresh(surface, moving, {});
    }
}

TEST(MovingDiagram, AfterACancelledUpdateTheNextOneMakesUpForIt) {
    const Surface surface = build_surface(shapes::torus(30, 20).view());
    const SurfaceLayout layout(surface);
    bool is_cancelled = false;
    const DiagramOptions options{.progress = [&](double) { return !is_cancelled; }};
    MovingDiagram moving(surface, layout, points::scattered(surface, 20, 5), {}, options);
    is_cancelled = true;
    EXPECT_THROW(moving.update({.moved = {{3, point_at(surface, 7)}}, .removed = {}, .added = {}}),
                 Cancelled);
    is_cancelled = false;
    moving.update({});
    expect_fresh(surface, moving, {});
}

TEST(MovingDiagram, BadChangesAreRefusedAndNothingChanges) {
    const Surface surface = build_surface(shapes::grid(6).view());
    const SurfaceLayout layout(surface);
    MovingDiagram moving(surface, layout, points::scattered(surface, 5, 1));
    EXPECT_THROW(moving.update({.moved = {}, .removed = {5}, .added = {}}), InvalidInput);
    expect_fresh(surface, moving, {});
}
