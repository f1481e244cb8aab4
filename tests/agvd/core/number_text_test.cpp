#include "agvd/core/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

using agvd::number_text;

namespace {

std::string printed(const char* form, int digits, double value) {
    char text[400];
    std::snprintf(text, sizeof text, form, digits, value);
    return text;
}

}  // namespace

TEST(NumberText, IsWhatPrintfWritesInTheCLocale) {
    std::mt19937_64 random(1);
    std::vector<double> values{0,   -0.0,  1,      0.1,
                               2.5, 1e300, 5e-324, std::numeric_limits<double>::max()};
    for (int i = 0; i < 1000; ++i) {
        const double power = std::uniform_real_distribution<double>(-30, 30)(random);
        values.push_back(std::pow(10, power) * (i % 2 == 0 ? 1 : -1));
    }
    for (const double value : values) {
        EXPECT_EQ(number_text(value), printed("%.*g", 6, value));
        EXPECT_EQ(number_text(value, 3), printed("%.*g", 3, value));
        EXPECT_EQ(number_text(value, 2, std::chars_format::fixed), printed("%.*f", 2, value));
        EXPECT_EQ(number_text(value, 1, std::chars_format::scientific), printed("%.*e", 1, value));
    }
    EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "inf");
}
