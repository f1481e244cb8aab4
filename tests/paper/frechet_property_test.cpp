// The distances between curves on random ones, against each other and against all starting points
// one by one.
#include "paper/frechet.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "agvd/core/random.h"

using namespace agvd;

namespace {

// A closed random walk in a box; `roughness` is the length of its steps.
std::vector<Vec3> random_loop(Index count, double roughness, std::uint64_t seed) {
    std::vector<Vec3> points;
    Vec3 at = Vec3::Zero();
    for (Index i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) {
            const auto axis = static_cast<std::uint64_t>(k);
            at[k] += roughness * (2 * random_unit(seed, axis, i) - 1);
        }
        points.push_back(at);
    }
    return points;
}

double by_all_starts(const std::vector<Vec3>& p, std::vector<Vec3> q) {
    std::vector<Vec3> closed_p = p;
    closed_p.push_back(p[0]);
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < q.size(); ++j) {
        std::vector<Vec3> closed_q = q;
        closed_q.push_back(q[0]);
        best = std::min(best, frechet_distance(closed_p, closed_q));
        std::rotate(q.begin(), q.begin() + 1, q.end());
    }
    return best;
}

TEST(FrechetProperty, ClosedCurvesMatchTheBestOfAllStarts) {
    for (Index seed = 0; seed < 300; ++seed) {
        const auto p = random_loop(1 + seed % 17, 0.3, 2 * seed);
        const auto q = random_loop(1 + seed % 23, seed % 2 == 0 ? 0.3 : 0.02, 2 * seed + 1);
        const double expected = by_all_starts(p, q);
        EXPECT_NEAR(closed_frechet_distance(p, q), expected, 1e-6 * expected) << seed;
    }
}

TEST(FrechetProperty, ClosedCurvesThatAreNearMatchTheBestOfAllStarts) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto p = random_loop(40, 0.1, seed);
        std::vector<Vec3> q = p;
        const auto noise = random_loop(40, 1, seed + 1000);
        for (std::size_t i = 0; i < q.size(); ++i) q[i] += 0.01 * (noise[i] - noise[(i + 1) % 40]);
        std::rotate(q.begin(), q.begin() + static_cast<std::ptrdiff_t>(seed % 40), q.end());
        const double expected = by_all_starts(p, q);
        EXPECT_NEAR(closed_frechet_distance(p, q), expected, 1e-6 * expected) << seed;
    }
}

TEST(FrechetProperty, IsAMetricAndNotBelowHausdorff) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto p = random_loop(30, 0.2, 3 * seed);
        const auto q = random_loop(25, 0.2, 3 * seed + 1);
        const auto r = random_loop(35, 0.2, 3 * seed + 2);
        const auto expect_metric = [&](const auto& distance) {
            EXPECT_EQ(distance(p, p), 0);
            EXPECT_NEAR(distance(p, q), distance(q, p), 1e-6 * distance(p, q));
            EXPECT_LE(distance(p, r), (distance(p, q) + distance(q, r)) * (1 + 1e-6));
            EXPECT_GE(distance(p, q), hausdorff_distance(p, q));
        };
        expect_metric([](const auto& a, const auto& b) { return frechet_distance(a, b); });
        expect_metric([](const auto& a, const auto& b) { return closed_frechet_distance(a, b); });
    }
}

TEST(FrechetProperty, HausdorffSkipsNothing) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto p = random_loop(30, 0.2, 2 * seed);
        const auto q = random_loop(40, 0.05, 2 * seed + 1);
        const auto directed = [](const auto& from, const auto& to) {
            double farthest = 0;
            for (const Vec3& a : from) {
                double nearest = std::numeric_limits<double>::infinity();
                for (const Vec3& b : to) nearest = std::min(nearest, (a - b).norm());
                farthest = std::max(farthest, nearest);
            }
            return farthest;
        };
        EXPECT_EQ(hausdorff_distance(p, q), std::max(directed(p, q), directed(q, p))) << seed;
    }
}

}  // namespace
