#include "agvd/intrinsic/charts.h"

#include <gtest/gtest.h>

#include "agvd/mesh/surface.h"
#include "support/shapes.h"

using agvd::Surface;
using agvd::Vec2;
using agvd::detail::FaceChart;
using agvd::detail::FaceCharts;

namespace {

const FaceChart changed{{Vec2(1, 2), Vec2(3, 4), Vec2(-4, -6)}, {Vec2(0, 1), {1, 0}, {-1, 0}}};

}  // namespace

TEST(FaceCharts, APartIsTakenOverWithoutWhatItForgot) {
    const Surface surface = agvd::build_surface(shapes::icosahedron().view());
    FaceCharts whole(surface);
    const FaceChart first = whole.peek(0);
    whole.set(5, changed);
    FaceCharts part = whole.part();
    part.set(0, changed);
    part.set(9, changed);
    part.forget(0);
    whole.take(part);
    EXPECT_EQ(whole.peek(0).side, first.side);
    EXPECT_EQ(whole.peek(5).side, changed.side);
    EXPECT_EQ(whole.peek(9).side, changed.side);
    EXPECT_EQ(whole.peek(9).turn, changed.turn);
}

TEST(FaceCharts, TheRoomOfAForgottenFaceServesAnother) {
    const Surface surface = agvd::build_surface(shapes::icosahedron().view());
    FaceCharts charts(surface);
    const FaceChart third = charts.peek(3);
    charts.set(3, changed);
    charts.set(4, changed);
    charts.forget(3);
    EXPECT_EQ(charts.peek(3).side, third.side);
    charts.of(11).side[0] = Vec2(7, 8);
    EXPECT_EQ(charts.peek(11).side[0], Vec2(7, 8));
    EXPECT_EQ(charts.peek(4).side, changed.side);
    EXPECT_EQ(charts.peek(3).side, third.side);
}
