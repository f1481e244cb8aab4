#include "agvd/core/portable_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "agvd/core/types.h"

using agvd::infinity;
namespace portable = agvd::portable;

namespace {

constexpr int num_arguments = 200000;
// In the unit of the last place for numbers just above 1.
constexpr double epsilon = std::numeric_limits<double>::epsilon();

double relative_error(double value, long double expected) {
    return static_cast<double>(std::abs((value - expected) / expected)) / epsilon;
}

// Numbers between two others in geometric progression.
double between(double low, double high, int i) {
    const double share = (i + 0.5) / num_arguments;
    return std::exp(std::log(low) + share * (std::log(high) - std::log(low)));
}

}  // namespace

TEST(PortableMath, AnglesOfAllDirectionsAndSlopesAreAccurate) {
    double worst = 0;
    const auto check = [&](double y, double x) {
        const long double wide_y = y, wide_x = x;
        worst = std::max(worst, relative_error(portable::atan2(y, x), std::atan2(wide_y, wide_x)));
    };
    for (int i = 0; i < num_arguments; ++i) {
        const double turn = (2 * (i + 0.5) / num_arguments - 1) * std::numbers::pi;
        check(std::sin(turn), std::cos(turn));
        const double slope = between(1e-300, 1e300, i);
        check(slope, 1);
        check(-slope, -1);
        check(1e300, slope);
    }
    EXPECT_LT(worst, 4);
}

TEST(PortableMath, AnglesAlongTheAxesAreThoseOfTheStandard) {
    const double most = std::numeric_limits<double>::max();
    for (const double y : {0., -0., 1., -1., 5e-324, -most, infinity, -infinity}) {
        for (const double x : {0., -0., 1., -1., 5e-324, -most, infinity, -infinity}) {
            EXPECT_DOUBLE_EQ(portable::atan2(y, x), std::atan2(y, x)) << y << ' ' << x;
            EXPECT_EQ(std::signbit(portable::atan2(y, x)), std::signbit(y)) << y << ' ' << x;
        }
        EXPECT_TRUE(std::isnan(portable::atan2(y, std::nan(""))));
        EXPECT_TRUE(std::isnan(portable::atan2(std::nan(""), y)));
    }
}

TEST(PortableMath, LogarithmsAreAccurateAlsoNearOneAndOfTheLeastNumbers) {
    double worst = 0;
    const auto check = [&](double x) {
        const long double wide = x;
        worst = std::max(worst, relative_error(portable::log(x), std::log(wide)));
    };
    for (int i = 0; i < num_arguments; ++i) {
        check(between(5e-324, 1e308, i));
        check(between(0.3, 3, i));
        check(1 + between(1e-15, 0.3, i));
        check(1 - between(1e-15, 0.3, i));
    }
    EXPECT_LT(worst, 4);
    EXPECT_EQ(portable::log(1), 0);
    EXPECT_EQ(portable::log(0), -infinity);
    EXPECT_EQ(portable::log(infinity), infinity);
    EXPECT_TRUE(std::isnan(portable::log(-1)));
    EXPECT_TRUE(std::isnan(portable::log(std::nan(""))));
}

TEST(PortableMath, ExponentialsAreAccurateFromTheLeastNumberToTheLargest) {
    double worst = 0;
    const auto check = [&](double x) {
        const long double wide = x;
        worst = std::max(worst, relative_error(portable::exp(x), std::exp(wide)));
    };
    for (int i = 0; i < num_arguments; ++i) {
        check(-708 + 1417 * (i + 0.5) / num_arguments);
        check(between(1e-300, 1, i));
        check(-between(1e-300, 1, i));
    }
    EXPECT_LT(worst, 4);
    EXPECT_EQ(portable::exp(0), 1);
    EXPECT_EQ(portable::exp(-745), 5e-324);
    EXPECT_EQ(portable::exp(-746), 0);
    EXPECT_EQ(portable::exp(710), infinity);
    EXPECT_EQ(portable::exp(-infinity), 0);
    EXPECT_EQ(portable::exp(infinity), infinity);
    EXPECT_TRUE(std::isnan(portable::exp(std::nan(""))));
}

TEST(PortableMath, PowersAreAccurateForTheirSize) {
    double worst = 0;
    for (int i = 0; i < num_arguments; ++i) {
        const double base = between(1e-100, 1e100, i);
        for (const double exponent : {1 / 3., -2 / 3., 2.4}) {
            const long double wide = base, expected = std::pow(wide, exponent);
            const double size = std::max(1., static_cast<double>(std::abs(std::log(expected))));
            worst = std::max(worst, relative_error(portable::pow(base, exponent), expected) / size);
        }
    }
    EXPECT_LT(worst, 4);
    EXPECT_EQ(portable::pow(1, 2.4), 1);
    EXPECT_EQ(portable::pow(7, 0), 1);
    EXPECT_EQ(portable::pow(0, 0.5), 0);
}
