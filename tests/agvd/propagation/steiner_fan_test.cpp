// Targets of a Steiner point across a face, by formula.
#include "agvd/propagation/steiner/steiner_front.h"

#include <gtest/gtest.h>

using namespace agvd;

namespace {

// Two intervals on the next half-edge, (1, 0) to (0, 1), and four on the previous one.
const FarSide face{1, {0, 1}, 2, 4};

}  // namespace

TEST(SteinerFan, TargetsAreNumberedByTheIntervalsOfTheirOwnSide) {
    EXPECT_DOUBLE_EQ(face.target_at({0.5, 0}, {0, 1}), 1);        // The middle of the next one.
    EXPECT_DOUBLE_EQ(face.target_at({0.5, 0}, {-0.5, 1}), 2);     // The apex.
    EXPECT_DOUBLE_EQ(face.target_at({0.5, 0}, {-0.5, 0.5}), 4);   // The middle of the previous one.
    EXPECT_DOUBLE_EQ(face.target_at({0.5, 0}, {-0.5, 0.25}), 5);  // A quarter up.
}

TEST(SteinerFan, HoldsTheTargetsBetweenItsSides) {
    // They lean a quarter to either side of the vertical and meet the next half-edge at 2/5 and
    // 2/3.
    const Vec2 here(0.5, 0);
    const Vec2 parent(0.5, -1);
    EXPECT_DOUBLE_EQ(face.target_at(here, {0.25, 1}), 0.8);
    EXPECT_DOUBLE_EQ(face.target_at(here, {-0.25, 1}), 4.0 / 3);
    const TargetRange range = face.visible_targets(here, 0.25, parent, {0, 0});
    EXPECT_EQ(range.begin, 0u);
    EXPECT_EQ(range.end, 3u);  // 0, 1 and 2.
}

TEST(SteinerFan, AWiderWindowOfTheParentWidensIt) {
    const Vec2 here(0.1, 0);
    const Vec2 parent(0.1, -1);
    const TargetRange narrow = face.visible_targets(here, 0.01, parent, {0, 0});
    const TargetRange wide = face.visible_targets(here, 0.01, parent, {2, 0});
    EXPECT_LT(wide.begin, narrow.begin);
    EXPECT_GT(wide.end, narrow.end);
    EXPECT_LE(wide.end, 7u);  // Both ends of the far side included: 0 to 6.
}

TEST(SteinerFan, ASideThatLooksBackEndsAtTheEndOfTheFarSide) {
    const TargetRange range = face.visible_targets({0.5, 0}, 0.5, {0.5, -0.1}, {0, 0.2});
    EXPECT_EQ(range.begin, 0u);
    EXPECT_EQ(range.end, 7u);
}
