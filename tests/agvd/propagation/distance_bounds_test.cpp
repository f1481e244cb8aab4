// Quick upper bounds: shortest paths along arcs, in whatever order they are found.
#include "agvd/propagation/distance_bounds.h"
#include "agvd/propagation/layout.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

class DistanceBoundsOn : public testing::TestWithParam<const char*> {};

TEST_P(DistanceBoundsOn, StepsAndThreadsChangeNothing) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface surface = build_surface(random_meshes::make(GetParam(), seed).view());
        const SurfaceLayout layout(surface);
        const auto sites = points::scattered(surface, 6, seed);
        const DistanceBounds bounds = distance_bounds(surface, layout, sites, 1);
        for (const auto& [num_steps, num_threads] : {std::pair{3, 1}, {40, 1}, {4, 3}}) {
            BoundsSearch search(surface, layout, num_threads, static_cast<Index>(num_steps));
            for (Index s = 0; s < sites.size(); ++s) search.add(sites[s], s);
            search.run();
            for (Index v = 0; v < surface.num_vertices(); ++v) {
                ASSERT_EQ(search.distance(v), bounds.distance[v]) << "vertex " << v;
                ASSERT_EQ(search.site(v), bounds.site[v]) << "vertex " << v;
            }
        }
    }
}

TEST_P(DistanceBoundsOn, NoArcShortensAPath) {
    const Surface surface = build_surface(random_meshes::make(GetParam(), 7).view());
    const SurfaceLayout layout(surface);
    const ArcGraph& graph = layout.arcs();
    const auto sites = points::scattered(surface, 5, 7);
    const DistanceBounds bounds = distance_bounds(surface, layout, sites, 1);
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (bounds.site[v] == no_index) continue;
        for (Index a = graph.offsets[v]; a < graph.ends[v]; ++a) {
            const auto [head, length] = graph.arcs[a];
            // Sums are rounded up, by one place at most.
            EXPECT_LE(bounds.distance[head], (bounds.distance[v] + length) * (1 + 0x1p-22F));
        }
    }
}

TEST(DistanceBounds, AreTheSameForAnyNumberOfThreadsThatMakeTheArcs) {
    // So many edges that they are several chunks.
    const Surface surface = build_surface(shapes::jitter(shapes::torus(160, 80), 0.004, 5).view());
    const auto sites = points::scattered(surface, 9, 3);
    const auto found = [&](int num_threads) {
        const SurfaceLayout layout(surface, num_threads);
        return distance_bounds(surface, layout, sites, num_threads);
    };
    const DistanceBounds one = found(1);
    for (const int threads : {2, 8}) {
        const DistanceBounds other = found(threads);
        EXPECT_EQ(one.distance, other.distance);
        EXPECT_EQ(one.site, other.site);
    }
}

INSTANTIATE_TEST_SUITE_P(RandomMeshes, DistanceBoundsOn,
                         testing::ValuesIn(random_meshes::families()),
                         [](const auto& family) { return std::string(family.param); });
