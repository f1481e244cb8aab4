// A diagram traced while the engine runs has the bytes of one that is built at the end, and relays
// are dropped on the way.
#include <gtest/gtest.h>

#include <string>

#include "agvd/core/error.h"
#include "agvd/diagram/diagram.h"
#include "support/checks.h"
#include "support/dice.h"
#include "support/line_sites.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// \return the relays held at once, as a share of all.
double expect_same_as_at_the_end(const Surface& surface, std::span<const SurfacePoint> sites,
                                 PropagationOptions options, const DiagramOptions& drawing = {}) {
    options.engine = Engine::Steiner;
    const Propagation propagation = propagate(surface, sites, options);
    const TracedDiagram traced = trace_diagram(surface, sites, options, drawing);
    checks::expect_same(build_diagram(surface, sites, propagation, drawing), traced.diagram);
    EXPECT_EQ(traced.certified_error, propagation.certified_error);
    EXPECT_LE(traced.most_relays, propagation.relays.size());
    return static_cast<double>(traced.most_relays) /
           std::max(1.0, static_cast<double>(propagation.relays.size()));
}

struct TracedCase {
    const char* name;
    TriangleMesh mesh;
};

std::vector<TracedCase> traced_cases() {
    return {{"sphere", shapes::jitter(shapes::sphere(3), 0.05, 3)},
            {"torus", shapes::torus(24, 12)},
            {"grid", shapes::grid(12)},
            {"tube", shapes::jitter(shapes::tube(16, 8), 0.02, 5)},
            {"lips", shapes::lips(12, 6, 3)},
            {"two", shapes::join(shapes::sphere(2), shapes::grid(5))}};
}

}  // namespace

TEST(TraceDiagram, HasTheBytesOfADiagramBuiltAtTheEnd) {
    for (const TracedCase& c : traced_cases()) {
        const Surface surface = build_surface(c.mesh.view());
        for (const Index t : {1u, 2u, 30u, 300u}) {
            const auto sites = points::scattered(surface, t, 7 + t);
            for (const double lambda : {0.01, 1.0, 100.0}) {
                SCOPED_TRACE(std::string(c.name) + " t=" + std::to_string(t) +
                             " lambda=" + std::to_string(lambda));
                expect_same_as_at_the_end(surface, sites, {.lambda = lambda});
            }
        }
    }
}

TEST(TraceDiagram, HasTheBytesOfADiagramBuiltAtTheEndOnMeshesThatAreHardForGeodesics) {
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 6; ++seed) {
            SCOPED_TRACE(std::string(family) + " " + std::to_string(seed));
            const Surface surface = build_surface(random_meshes::make(family, seed).view());
            Dice dice(seed);
            const auto sites = points::random_sites(dice, surface.num_faces());
            expect_same_as_at_the_end(surface, sites, {.steiner_points = 3, .lambda = 0.05});
        }
    }
}

TEST(TraceDiagram, KnowsGroupsStartsAndShapes) {
    const TriangleMesh mesh = shapes::jitter(shapes::sphere(3), 0.05, 3);
    const Surface surface = build_surface(mesh.view());
    const auto sites = points::scattered(surface, 60, 4);
    for (PropagationOptions options : line_sites::kinds_of_sites(surface)) {
        options.lambda = 0.05;
        expect_same_as_at_the_end(surface, sites, options);
    }
}

TEST(TraceDiagram, HoldsFewerRelaysWithASmallerLambda) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(5), 0.002, 3).view());
    const auto sites = points::scattered(surface, 300, 1);
    const double all = expect_same_as_at_the_end(surface, sites, {.lambda = 100});
    const double some = expect_same_as_at_the_end(surface, sites, {.lambda = 1});
    const double few = expect_same_as_at_the_end(surface, sites, {.lambda = 0.05});
    EXPECT_LT(all, 0.15);
    EXPECT_LT(some, all);
    EXPECT_LT(few, 0.8 * some);
}

// With few Steiner points distances contradict each other, and there are many islands. A diagram
// that is built at the end after all has held all relays.
TEST(TraceDiagram, KeepsTheRelaysAroundIslands) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(4), 0.01, 3).view());
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
        const auto sites = points::scattered(surface, 150, seed);
        for (const int m : {0, 1, 2}) {
            SCOPED_TRACE("seed " + std::to_string(seed) + " m=" + std::to_string(m));
            EXPECT_LT(
                expect_same_as_at_the_end(surface, sites, {.steiner_points = m, .lambda = 0.02}),
                0.6);
        }
    }
}

TEST(TraceDiagram, HasTheSameBytesForAnyNumberOfThreads) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(4), 0.01, 3).view());
    const auto sites = points::scattered(surface, 200, 1);
    const PropagationOptions options{.engine = Engine::Steiner, .lambda = 0.3};
    const TracedDiagram one = trace_diagram(surface, sites, options, {.num_threads = 1});
    for (const int threads : {2, 8}) {
        const TracedDiagram other =
            trace_diagram(surface, sites, options, {.num_threads = threads});
        checks::expect_same(one.diagram, other.diagram);
        EXPECT_EQ(one.most_relays, other.most_relays);
    }
}

TEST(TraceDiagram, KeepsAllRelaysForAChordAnErrorAndTheWindowEngine) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.05, 3).view());
    const auto sites = points::scattered(surface, 40, 1);
    EXPECT_EQ(expect_same_as_at_the_end(surface, sites, {.lambda = 0.05}, {.chord = 0.01}), 1);
    EXPECT_EQ(expect_same_as_at_the_end(surface, sites, {.max_error = 0.02, .lambda = 0.05}), 1);
    const TracedDiagram traced = trace_diagram(surface, sites, {.max_error = 0});
    checks::expect_same(build_diagram(surface, sites, propagate(surface, sites, {.max_error = 0})),
                        traced.diagram);
    EXPECT_EQ(traced.certified_error, 0);
}

TEST(TraceDiagram, ChecksItsOptionsAndCanBeCancelled) {
    const Surface surface = build_surface(shapes::sphere(3).view());
    const auto sites = points::scattered(surface, 4, 1);
    const PropagationOptions options{.engine = Engine::Steiner};
    EXPECT_THROW((void)trace_diagram(surface, sites, options, {.chord = 0}), InvalidOption);
    PropagationOptions bad = options;
    bad.lambda = 0;
    EXPECT_THROW((void)trace_diagram(surface, sites, bad), InvalidOption);
    const Progress stop = [](double) { return false; };
    PropagationOptions stopped = options;
    stopped.progress = stop;
    EXPECT_THROW((void)trace_diagram(surface, sites, stopped), Cancelled);
    EXPECT_THROW((void)trace_diagram(surface, sites, options, {.progress = stop}), Cancelled);
}
