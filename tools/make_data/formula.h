//! \file
//! Circles and rounding that give the same bits on every machine, which the system's sine does not
//! promise.
#pragma once

#include "agvd/core/types.h"

namespace make_data {

//! The point at `turn` full turns (>= 0) on the unit circle, to about 1e-13.
[[nodiscard]] inline agvd::Vec2 unit_circle(double turn) {
    const auto quarters = static_cast<int>(turn * 4 + 0.5);
    const double x = (turn - quarters / 4.0) * 6.283185307179586;  // in [-pi / 4, pi / 4]
    double cosine = 1, sine = x, term = x;
    for (int k = 2; k < 16; ++k) {
        term *= x / k;
        const double signed_term = k % 4 < 2 ? term : -term;
        (k % 2 == 0 ? cosine : sine) += signed_term;
    }
    switch (quarters % 4) {
        case 0:
            return {cosine, sine};
        case 1:
            return {-sine, cosine};
        case 2:
            return {-cosine, -sine};
        default:
            return {sine, -cosine};
    }
}

//! The double closest to `value` with six decimals: keeps text files short.
[[nodiscard]] inline double six_decimals(double value) {
    const double scaled = value * 1e6;
    return static_cast<double>(static_cast<long long>(scaled + (scaled < 0 ? -0.5 : 0.5))) / 1e6;
}

}  // namespace make_data
