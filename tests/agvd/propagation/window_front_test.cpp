// A run that gives windows back against one that keeps them all.
#include "agvd/propagation/window/window_front.h"

#include <gtest/gtest.h>

#include <limits>

#include "agvd/propagation/distance_bounds.h"
#include "agvd/propagation/engines.h"
#include "agvd/propagation/layout.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

struct HalfEdgeWindows {
    Index half_edge;
    std::vector<Window> windows;
};

std::vector<HalfEdgeWindows> windows_into(const WindowFront& front, const KeptFaces& keeps) {
    std::vector<HalfEdgeWindows> result;
    front.for_each_half_edge([&](Index half_edge, std::span<const Window> windows) {
        if (!keeps(Surface::face(half_edge))) return;
        result.push_back({half_edge, {windows.begin(), windows.end()}});
    });
    return result;
}

bool is_same(const Window& a, const Window& b) {
    return a.x == b.x && a.y == b.y && a.weight == b.weight && a.begin == b.begin &&
           a.end == b.end && a.at_begin == b.at_begin && a.at_end == b.at_end && a.error == b.error;
}

void expect_same_windows(const std::vector<HalfEdgeWindows>& a,
                         const std::vector<HalfEdgeWindows>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i].half_edge, b[i].half_edge);
        ASSERT_TRUE(std::equal(a[i].windows.begin(), a[i].windows.end(), b[i].windows.begin(),
                               b[i].windows.end(), is_same))
            << "half-edge " << a[i].half_edge;
    }
}

std::vector<std::pair<Index, double>> vertices_of(const WindowFront& front) {
    std::vector<std::pair<Index, double>> result;
    front.for_each_vertex(
        [&](Index vertex, double distance) { result.emplace_back(vertex, distance); });
    return result;
}

}  // namespace

class WindowFrontOn : public testing::TestWithParam<const char*> {};

TEST_P(WindowFrontOn, GivingWindowsBackChangesNothingElse) {
    for (std::uint64_t seed = 0; seed < 25; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface s = build_surface(random_meshes::make(GetParam(), seed).view());
        const SurfaceLayout layout(s, 1);
        const Corners& corners = *layout.corners();
        const auto sites = points::scattered(s, static_cast<Index>(1 + seed % 3), seed);
        DistanceBounds bounds = distance_bounds(s, layout, sites, 1);
        if (seed % 5 == 0) {  // Anything above the distance will do.
            std::fill(bounds.distance.begin(), bounds.distance.end(),
                      std::numeric_limits<float>::infinity());
        }
        const KeptFaces keeps = [&](Index face) { return face % 4 == seed % 4; };
        for (const double max_error : {0.0, 1e-3, 0.2}) {
            WindowFront all(s, corners, max_error);
            WindowFront some(s, corners, max_error, {}, 0);
            for (const SurfacePoint& site : sites) {
                run_front(all, site, bounds.distance, default_work_cap);
                run_front(some, site, bounds.distance, default_work_cap, keeps);
                EXPECT_EQ(all.num_served, some.num_served);
                EXPECT_EQ(all.relative_error, some.relative_error);
                EXPECT_EQ(vertices_of(all), vertices_of(some));
                ASSERT_NO_FATAL_FAILURE(
                    expect_same_windows(windows_into(all, keeps), windows_into(some, keeps)));
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(RandomMeshes, WindowFrontOn, testing::ValuesIn(random_meshes::families()),
                         [](const auto& family) { return std::string(family.param); });

TEST(WindowFront, OnlyTheWindowsNearTheFrontAreHeld) {
    const Surface s = build_surface(shapes::jitter(shapes::sphere(6), 0.003, 3).view());
    const SurfaceLayout layout(s, 1);
    const Corners& corners = *layout.corners();
    const auto sites = points::scattered(s, 1, 2);
    const DistanceBounds bounds = distance_bounds(s, layout, sites, 1);
    WindowFront front(s, corners, 0);
    const auto num_held = [&] {
        std::size_t held = 0;
        front.for_each_half_edge(
            [&](Index, std::span<const Window> windows) { held += windows.size(); });
        return held;
    };
    run_front(front, sites[0], bounds.distance, default_work_cap, [](Index) { return false; });
    const std::size_t bytes = front.bytes();
    EXPECT_LT(num_held(), front.num_served / 10);
    EXPECT_LT(bytes, 100 * s.num_faces());
    run_front(front, sites[0], bounds.distance, default_work_cap);
    EXPECT_GT(num_held(), front.num_served / 2);
    EXPECT_GT(front.bytes(), 5 * bytes);
}
