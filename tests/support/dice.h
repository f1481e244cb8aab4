//! \file
//! A sequence of random choices.
#pragma once

#include <cmath>

#include "agvd/core/random.h"
#include "agvd/core/types.h"

//! The same numbers for the same seed and order of calls.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : seed_(seed) {}

    //! In [low, high).
    double number(double low, double high) {
        return low + (high - low) * agvd::random_unit(seed_, 0, rolls_++);
    }
    //! In [low, high), evenly by magnitude; 0 < low.
    double magnitude(double low, double high) {
        return std::exp(number(std::log(low), std::log(high)));
    }
    //! In [low, high].
    agvd::Index count(agvd::Index low, agvd::Index high) {
        return low +
               static_cast<agvd::Index>(agvd::random_bits(seed_, 0, rolls_++) % (high - low + 1));
    }
    bool one_in(agvd::Index n) { return count(1, n) == 1; }

private:
    std::uint64_t seed_;
    std::uint64_t rolls_ = 0;
};
