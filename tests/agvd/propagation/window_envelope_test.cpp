// The envelope of windows against the least of all of them, and merged windows against the two they
// stand for.
#include "agvd/propagation/window/window_envelope.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "agvd/core/random.h"

using namespace agvd;

namespace {

double at(const Window& w, double x) { return w.weight + std::hypot(x - w.x, w.y); }

Window window(double x, double y, double weight, double begin, double end) {
    Window w{x, y, weight, begin, end, 0, 0, 0, false};
    w.at_begin = at(w, begin);
    w.at_end = at(w, end);
    return w;
}

// Windows over an edge of length 1; with weights of their own or none.
std::vector<Window> random_windows(std::uint64_t seed, std::size_t count, bool has_weights) {
    std::vector<Window> windows;
    std::uint64_t i = 0;
    const auto number = [&] { return random_unit(seed, 0, i++); };
    for (std::size_t k = 0; k < count; ++k) {
        const double a = number();
        const double b = number();
        const double y = -0.05 - 2 * number();
        const double x = 3 * number() - 1;
        windows.push_back(
            window(x, y, has_weights ? 1.5 * number() : 1, std::min(a, b), std::max(a, b)));
    }
    return windows;
}

double least(const std::vector<Window>& windows, double x) {
    double result = std::numeric_limits<double>::infinity();
    for (const Window& w : windows) {
        if (w.begin <= x && x <= w.end) result = std::min(result, at(w, x));
    }
    return result;
}

}  // namespace

TEST(WindowEnvelope, IsTheLeastOfAllWindows) {
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const auto windows = random_windows(seed, 2 + seed % 9, seed % 3 != 0);
        std::vector<Window> envelope, scratch;
        for (const Window& w : windows) insert_window(w, scratch, envelope);
        for (std::size_t i = 0; i < envelope.size(); ++i) {
            EXPECT_LT(envelope[i].begin, envelope[i].end);
            EXPECT_NEAR(envelope[i].at_begin, at(envelope[i], envelope[i].begin), 1e-12);
            EXPECT_NEAR(envelope[i].at_end, at(envelope[i], envelope[i].end), 1e-12);
            if (i > 0) {
                EXPECT_LE(envelope[i - 1].end, envelope[i].begin);
            }
        }
        for (int k = 0; k <= 1000; ++k) {
            const double x = k / 1000.0;
            const double expected = least(windows, x);
            const double found = least(envelope, x);
            if (std::isinf(expected)) {
                EXPECT_TRUE(std::isinf(found)) << "seed " << seed << " at " << x;
            } else {
                EXPECT_NEAR(found, expected, 1e-11) << "seed " << seed << " at " << x;
            }
        }
    }
}

// A window with a head start wins the middle of a wide one and loses both ends, and the other way.
TEST(WindowEnvelope, CutsInTwoPlaces) {
    const Window wide = window(0.5, -1, 0, 0, 1);
    const Window narrow = window(0.5, -0.1, 0.88, 0, 1);
    for (const auto& [first, second] : {std::pair{wide, narrow}, std::pair{narrow, wide}}) {
        std::vector<Window> envelope, scratch;
        insert_window(first, scratch, envelope);
        insert_window(second, scratch, envelope);
        ASSERT_EQ(envelope.size(), 3u);
        EXPECT_EQ(envelope[0].y, -1);
        EXPECT_EQ(envelope[1].y, -0.1);
        EXPECT_EQ(envelope[2].y, -1);
        EXPECT_NEAR(envelope[0].end + envelope[2].begin, 1, 1e-12);
    }
}

TEST(WindowEnvelope, ServedWindowsHoldTheirGroundInTies) {
    Window served = window(0.3, -1, 0.5, 0.2, 0.8);
    served.is_served = true;
    const Window again = window(0.3, -1, 0.5, 0, 1);
    for (const auto& [first, second] : {std::pair{served, again}, std::pair{again, served}}) {
        std::vector<Window> envelope, scratch;
        insert_window(first, scratch, envelope);
        insert_window(second, scratch, envelope);
        ASSERT_EQ(envelope.size(), 3u);
        EXPECT_FALSE(envelope[0].is_served);
        EXPECT_TRUE(envelope[1].is_served);
        EXPECT_FALSE(envelope[2].is_served);
    }
}

// Neighbours often tie where they meet: the better one takes all.
TEST(WindowEnvelope, ATieAtAnEndIsNoCrossing) {
    const double nudge = 2e-16;
    const Window nearer = window(0, -1, 0.25, 0, 1);
    for (const double sign : {-nudge, 0.0, nudge}) {
        const double farther_weight = 0.25 + 1 - std::hypot(0.5, 1) + sign;
        const Window farther = window(-0.5, -1, farther_weight, 0, 1);
        for (const auto& [first, second] :
             {std::pair{nearer, farther}, std::pair{farther, nearer}}) {
            std::vector<Window> envelope, scratch;
            insert_window(first, scratch, envelope);
            insert_window(second, scratch, envelope);
            for (int k = 0; k <= 10; ++k)
                EXPECT_NEAR(least(envelope, k / 10.0), at(nearer, k / 10.0), 1e-14);
        }
    }
}

TEST(WindowEnvelope, PiecesOfOneWindowStayTogether) {
    std::vector<Window> envelope, scratch;
    insert_window(window(0.2, -1, 2, 0.2, 0.4), scratch, envelope);
    insert_window(window(0.7, -1, 2, 0.6, 0.9), scratch, envelope);
    insert_window(window(0.5, -1, 0, 0, 1), scratch, envelope);
    ASSERT_EQ(envelope.size(), 1u);
    EXPECT_EQ(envelope[0].begin, 0);
    EXPECT_EQ(envelope[0].end, 1);
}

// Where it says that one cut does, the two are the least of both; else they are untouched.
TEST(WindowEnvelope, OneCutMakesTwoWindowsDisjoint) {
    int num_cut = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        std::vector<Window> both = random_windows(seed, 2, seed % 3 != 0);
        if (both[1].begin < both[0].begin) std::swap(both[0], both[1]);
        if (!(both[1].begin < both[0].end)) continue;
        const std::vector<Window> before = both;
        if (!cut_where_they_change(both[0], both[1])) {
            for (int i : {0, 1}) {
                EXPECT_EQ(both[i].begin, before[i].begin);
                EXPECT_EQ(both[i].end, before[i].end);
            }
            continue;
        }
        ++num_cut;
        EXPECT_LT(both[0].begin, both[0].end);
        if (both[1].begin == both[1].end) both.pop_back();
        if (both.size() == 2) {
            EXPECT_LE(both[0].end, both[1].begin);
        }
        for (const Window& w : both) {
            EXPECT_NEAR(w.at_begin, at(w, w.begin), 1e-12);
            EXPECT_NEAR(w.at_end, at(w, w.end), 1e-12);
        }
        for (int k = 0; k <= 100; ++k) {
            const double x = k / 100.0;
            const double expected = least(before, x);
            if (std::isinf(expected)) continue;
            EXPECT_NEAR(least(both, x), expected, 1e-11) << "seed " << seed << " at " << x;
        }
    }
    EXPECT_GT(num_cut, 1000);
}

TEST(WindowEnvelope, OneCutIsNotEnoughWhereOneWindowWinsInTheMiddleOfTheOther) {
    const Window wide = window(0.5, -1, 0, 0, 1);
    for (const auto& [begin, end] : {std::pair{0.0, 1.0}, std::pair{0.1, 0.9}}) {
        const Window narrow = window(0.5, -0.1, 0.88, begin, end);
        Window last = wide, next = narrow;
        EXPECT_FALSE(cut_where_they_change(last, next));
        EXPECT_EQ(last.end, 1);
        EXPECT_EQ(next.begin, begin);
        EXPECT_EQ(next.end, end);
    }
}

// The beam from a vertex overlaps the one that passes it by the grazing of its ray.
TEST(WindowEnvelope, TheBeamThatPassesAVertexHoldsTheRay) {
    const double grazing = 1e-10;
    const Window passing = window(0.5, -2, 0, 0.5, 1);  // From (0.5, -2) past the vertex (0.5, -1).
    const Window turned = window(0.5, -1, 1, 0.2, 0.5 + grazing);
    Window last = turned, next = passing;
    ASSERT_TRUE(cut_where_they_change(last, next));
    EXPECT_EQ(last.end, 0.5);
    EXPECT_EQ(next.begin, 0.5);
    last = turned;
    next = passing;
    last.is_served = true;  // Then it stays.
    ASSERT_TRUE(cut_where_they_change(last, next));
    EXPECT_EQ(next.begin, 0.5 + grazing);
}

// Below both, above both less the error, and with a beam that holds both beams.
TEST(MergeWindows, StandsForBothWithinItsError) {
    int merged_count = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        std::vector<Window> both = random_windows(seed, 2, seed % 2 == 0);
        const double joint = 0.3 + 0.4 * random_unit(seed, 1, 0);
        both[0] = window(both[0].x, both[0].y, both[0].weight, 0.1, joint);
        both[1] = window(both[1].x, both[1].y, both[1].weight, joint, 0.9);
        both[0].error = 0.01F;
        constexpr double max_error = 0.3;
        const auto merged = merge_windows(both[0], both[1], max_error);
        if (!merged) continue;
        ++merged_count;
        EXPECT_LT(merged->y, 0);
        EXPECT_GE(merged->error, 0.01F);
        EXPECT_LE(merged->error, max_error * merged->nearest());
        const auto ray = [](const Window& w, double x) { return (x - w.x) / -w.y; };
        EXPECT_NEAR(ray(*merged, 0.1), ray(both[0], 0.1), 1e-9);
        EXPECT_NEAR(ray(*merged, 0.9), ray(both[1], 0.9), 1e-9);
        for (int k = 0; k <= 200; ++k) {
            const double x = 0.1 + 0.8 * k / 200;
            const Window& part = x <= joint ? both[0] : both[1];
            EXPECT_LE(at(*merged, x), at(part, x) + 1e-9) << "seed " << seed;
            EXPECT_GE(at(*merged, x) + merged->error, at(part, x) + part.error - 1e-9)
                << "seed " << seed;
        }
    }
    EXPECT_GT(merged_count, 100);
}

TEST(MergeWindows, RefusesGapsAndBeamsThatDoNotDiverge) {
    const Window left = window(0.2, -1, 0, 0, 0.4);
    EXPECT_FALSE(merge_windows(left, window(0.2, -1, 0, 0.5, 1), 0.9));
    // Seen through the joint in reverse: the outer rays meet ahead.
    EXPECT_FALSE(merge_windows(window(-5, -0.5, 0, 0, 0.5), window(6, -0.5, 0, 0.5, 1), 0.9));
    EXPECT_FALSE(merge_windows(left, window(0.9, -1, 0.5, 0.4, 1), 1e-4));
    EXPECT_TRUE(merge_windows(left, window(0.2, -1, 0, 0.4, 1), 1e-4));
}
