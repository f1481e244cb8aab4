#include "agvd/diagram/envelope.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/dice.h"

using namespace agvd;

namespace {

constexpr double length = 2;

// Sites above a segment from (0, 0) to (2, 0): relay i is site i.
std::vector<LineRelay> relays_of(const std::vector<Vec3>& sites) {
    std::vector<LineRelay> relays;
    for (const Vec3& site : sites) {
        const Vec2 at(site.x(), site.y());
        relays.push_back(on_line(point_relay(at, site.z(), static_cast<Index>(relays.size())),
                                 {0, 0}, {1, 0}, length));
    }
    return relays;
}

Index nearest_at(const std::vector<LineRelay>& relays, double x) {
    Index best = 0;
    for (Index i = 0; i < relays.size(); ++i) {
        if (sample(relays[i], x).value < sample(relays[best], x).value) best = i;
    }
    return best;
}

std::vector<LabelInterval> envelope_of(const std::vector<LineRelay>& relays) {
    EnvelopeScratch scratch;
    std::vector<LabelInterval> intervals;
    label_envelope(relays, {length, nearest_at(relays, 0), nearest_at(relays, length)}, scratch,
                   intervals);
    return intervals;
}

TEST(LineRelay, TellsDistanceAndDerivative) {
    const LineRelay straight = point_on_line(0.5, 0.25, 7);
    EXPECT_EQ(straight.site, 7u);
    EXPECT_DOUBLE_EQ(sample(straight, 2).value, 1.75);
    EXPECT_DOUBLE_EQ(sample(straight, 2).slope, 1);
    EXPECT_DOUBLE_EQ(sample(straight, 0).slope, -1);
    EXPECT_DOUBLE_EQ(sample(straight, 0.5).slope, 1);
    const std::vector<LineRelay> relays = relays_of({{1, 3, 0.5}});
    EXPECT_DOUBLE_EQ(sample(relays[0], 1).value, 3.5);
    EXPECT_DOUBLE_EQ(sample(relays[0], 1).slope, 0);
    EXPECT_DOUBLE_EQ(distance_on_line(relays, 0, 1), 3.5);
    EXPECT_EQ(distance_on_line(relays, 1, 1), std::numeric_limits<double>::infinity());
}

// Behind the window [0.5, 1.5] paths bend at its ends.
TEST(LineRelay, BendsAtTheEndsOfItsWindow) {
    const PlanarRelay relay{
        {1, 1}, {1.25, 0.5}, {0.75, 0.5}, 0, std::hypot(0.25, 0.5), std::hypot(0.25, 0.5),
        3,      false};
    const LineRelay line = on_line(relay, {0, 0}, {1, 0}, length);
    EXPECT_DOUBLE_EQ(sample(line, 1).value, 1);
    EXPECT_EQ(sample(line, 1).source, 1);
    EXPECT_DOUBLE_EQ(sample(line, 2).value, std::hypot(0.25, 0.5) + std::hypot(0.75, 0.5));
    EXPECT_DOUBLE_EQ(sample(line, 0).value, sample(line, 2).value);
    EXPECT_NE(sample(line, 0).source, sample(line, 2).source);
}

TEST(Envelope, OneSiteHasTheWholeSegment) {
    const auto intervals = envelope_of(relays_of({{1, 1, 0}}));
    ASSERT_EQ(intervals.size(), 1u);
    EXPECT_EQ(intervals[0].end, 1);
    EXPECT_EQ(intervals[0].site, 0u);
}

TEST(Envelope, TwoSitesChangeWhereTheirBisectorCrosses) {
    // Equal weights: the perpendicular bisector; (x - 0)^2 + 1 = (x - 2)^2 + 4 at x = 1.75.
    const auto intervals = envelope_of(relays_of({{0, 1, 0}, {2, 2, 0}}));
    ASSERT_EQ(intervals.size(), 2u);
    EXPECT_NEAR(intervals[0].end, 1.75 / length, 1e-12);
    EXPECT_EQ(intervals[0].site, 0u);
    EXPECT_EQ(intervals[1].site, 1u);
    EXPECT_EQ(intervals[1].end, 1);
    const auto crossing = find_single_crossing(relays_of({{0, 1, 0}, {2, 2, 0}}), length, 0, 1);
    ASSERT_TRUE(crossing);
    EXPECT_NEAR(crossing->at, 1.75, 1e-12);
    EXPECT_NEAR(crossing->distance, std::hypot(1.75, 1), 1e-12);
}

TEST(Envelope, ASiteThatIsNearestNowhereHasNoInterval) {
    const auto intervals = envelope_of(relays_of({{0, 1, 0}, {1, 5, 0}, {2, 1, 0}}));
    ASSERT_EQ(intervals.size(), 2u);
    EXPECT_EQ(intervals[0].site, 0u);
    EXPECT_EQ(intervals[1].site, 2u);
}

TEST(Envelope, ASiteCloseToTheSegmentHasAnIntervalInsideAnothersTwo) {
    const auto relays = relays_of({{1, 1, 0}, {1, 0.5, 0.4}});
    const auto intervals = envelope_of(relays);
    ASSERT_EQ(intervals.size(), 3u);
    EXPECT_EQ(intervals[0].site, 0u);
    EXPECT_EQ(intervals[1].site, 1u);
    EXPECT_EQ(intervals[2].site, 0u);
    EXPECT_NEAR(intervals[0].end + intervals[1].end, 1, 1e-9);
}

// Two relays of one site, which wins on both sides of the other one's first interval.
TEST(Envelope, ASecondRelayOfASiteMayWinBeyondTheCrossing) {
    auto relays = relays_of({{0, 0.1, 0}, {2, 1, 0}, {1.6, 0.05, 0.95}});
    relays[2].site = 0;
    EXPECT_FALSE(find_single_crossing(relays, length, 0, 1));
    const auto intervals = envelope_of(relays);
    ASSERT_EQ(intervals.size(), 4u);
    EXPECT_NEAR(intervals[0].end, 1.2475 / length, 1e-9);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(intervals[i].site, i % 2);
    for (const std::size_t i : {1U, 2U}) {
        const double x = length * intervals[i].end;
        EXPECT_NEAR(sample(relays[1], x).value, sample(relays[2], x).value, 1e-9);
    }
}

TEST(Envelope, AThirdSiteBetweenIsNoSingleCrossing) {
    const auto relays = relays_of({{0, 1, 0}, {1, 0.2, 0}, {2, 1, 0}});
    EXPECT_FALSE(find_single_crossing(relays, length, 0, 2));
    EXPECT_EQ(envelope_of(relays).size(), 3u);
}

TEST(Envelope, TheLowestSiteTakesATie) {
    const auto intervals = envelope_of(relays_of({{1, 1, 0}, {1, 1, 0}}));
    ASSERT_EQ(intervals.size(), 1u);
    EXPECT_EQ(intervals[0].site, 0u);
}

TEST(Envelope, GivesTheEndsTheSitesNamed) {
    const auto relays = relays_of({{1, 1, 0}, {1, 3, 0}});
    EnvelopeScratch scratch;
    std::vector<LabelInterval> intervals;
    label_envelope(relays, {length, 1, 0}, scratch, intervals);
    ASSERT_EQ(intervals.size(), 2u);
    EXPECT_EQ(intervals[0].site, 1u);
    EXPECT_NEAR(intervals[0].end, 0, 1e-12);
    EXPECT_EQ(intervals[1].site, 0u);
}

TEST(Envelope, NamesTheNearestSiteEverywhere) {
    int num_checked = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Dice dice(seed);
        std::vector<Vec3> sites(dice.count(2, 12));
        for (Vec3& site : sites) {
            site = {dice.number(-1, 3), dice.number(0.01, 2), dice.number(0, 0.5)};
        }
        const auto relays = relays_of(sites);
        const auto intervals = envelope_of(relays);
        double begin = 0;
        for (std::size_t i = 0; i < intervals.size(); ++i) {
            EXPECT_TRUE(i == 0 || intervals[i].site != intervals[i - 1].site) << seed;
            for (const double share : {0.001, 0.25, 0.5, 0.75, 0.999}) {
                const double x = length * (begin + share * (intervals[i].end - begin));
                EXPECT_LE(distance_on_line(relays, intervals[i].site, x),
                          sample(relays[nearest_at(relays, x)], x).value + 1e-9)
                    << seed << ", x = " << x;
                ++num_checked;
            }
            begin = intervals[i].end;
        }
        EXPECT_EQ(begin, 1) << seed;
    }
    EXPECT_GT(num_checked, 3000);
}

}  // namespace
