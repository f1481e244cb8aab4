//! \file
//! Compares two windows over the same interval of an edge.
#pragma once

#include <array>

#include "agvd/propagation/window/window.h"

namespace agvd {

//! Distances that differ by less, relative to their size, are rounding.
inline constexpr double distance_rounding = 1e-14;

//! Which of two windows is nearer, along an interval. The winner changes at each cut.
struct Duel {
    bool first_wins;
    bool is_tie = false;  //!< At both ends.
    int num_cuts = 0;
    std::array<double, 2> cuts{};
};

//! \param low, high  an interval that both cover. Where they tie, b wins, unless only a is served.
[[nodiscard]] Duel fight(const Window& a, const Window& b, double low, double high);

}  // namespace agvd
