// Finds where the distances of two windows are equal on an interval of their edge. With images
// (x, y) and weights w, the distances w + sqrt((t - x)^2 + y^2) of two windows are equal at roots
// of a quadratic, so the winner changes at most twice. In most cases the signs at the ends decide,
// or tangents against chords, since the distances are convex; then no root is computed. Where the
// closed form has lost its digits, regula falsi (Illinois) finds the root.
#include "agvd/propagation/window/window_duel.h"

#include <algorithm>
#include <cassert>
#include <optional>

namespace agvd {
namespace {

// Where the distances of two windows are equal: the roots of a quadratic, ascending. Squaring adds
// points where the difference of the distances has the other sign: callers check.
std::optional<std::array<double, 2>> equal_distances(const Window& a, const Window& b) {
    const double delta = b.weight - a.weight;  // |a - x| = |b - x| + delta
    const double c0 = (a.x - b.x) * (a.x + b.x) + (a.y - b.y) * (a.y + b.y) - delta * delta;
    const double c1 = -2 * (a.x - b.x);
    if (delta == 0) {
        if (c1 == 0) return std::nullopt;
        return std::array{-c0 / c1, -c0 / c1};
    }
    const double d2 = 4 * delta * delta;  // (c0 + c1 x)^2 = d2 ((x - b.x)^2 + b.y^2)
    const double p2 = c1 * c1 - d2;
    const double p1 = c0 * c1 + d2 * b.x;  // Half the linear coefficient.
    const double p0 = c0 * c0 - d2 * (b.x * b.x + b.y * b.y);
    const double discriminant = p1 * p1 - p2 * p0;
    if (!(discriminant >= 0)) return std::nullopt;
    const double q = -(p1 + std::copysign(std::sqrt(discriminant), p1));
    if (q == 0) return std::nullopt;
    const double other = p0 / q;
    if (p2 == 0) return std::array{other, other};
    return std::array{std::min(q / p2, other), std::max(q / p2, other)};
}

// Two numbers for the ends of an interval.
struct Ends {
    double low, high;
};

// The one change of sign of a - b in an interval, at whose ends the differences are `gaps`.
double crossing(const Window& a, const Window& b, Ends interval, Ends gaps) {
    auto [low, high] = interval;
    auto [at_low, at_high] = gaps;
    assert(low < high && (at_low < 0) != (at_high < 0));
    const double scale = distance_rounding * 16 * a.distance(low);
    const auto gap = [&](double x) { return a.distance(x) - b.distance(x); };
    if (const auto roots = equal_distances(a, b)) {
        for (const double x : *roots) {
            if (low < x && x < high && std::abs(gap(x)) <= scale) return x;
        }
    }
    // The closed form has lost its digits, or an end is nearly a root: regula falsi (Illinois).
    int side = 0;
    double middle = low;
    for (int i = 0; i < 60 && high - low > 1e-14 * (std::abs(low) + std::abs(high)); ++i) {
        middle = (low * at_high - high * at_low) / (at_high - at_low);
        if (!(low <= middle && middle <= high)) middle = (low + high) / 2;
        const double value = gap(middle);
        if (std::abs(value) <= scale) return middle;
        if ((value < 0) == (at_low < 0)) {
            low = middle;
            at_low = value;
            if (side == -1) at_high /= 2;
            side = -1;
        } else {
            high = middle;
            at_high = value;
            if (side == 1) at_low /= 2;
            side = 1;
        }
    }
    return middle;
}

double slope(const Window& w, double at, double distance) {
    const double run = distance - w.weight;
    return run > 0 ? (at - w.x) / run : 0;
}

// Can a window that loses at both ends of an interval win in between? Not if its tangents stay
// above the other's chord, since distances are convex. `lost` and `won`: the distances at the ends.
bool may_win_between(const Window& loser, Ends interval, Ends lost, Ends won) {
    const auto [low, high] = interval;
    const auto [lost_low, lost_high] = lost;
    const auto [won_low, won_high] = won;
    const double width = high - low;
    // In most cases one tangent decides alone. That needs no division.
    const double tie = distance_rounding * won_low;
    if ((lost_low + tie - won_high) * (lost_low - loser.weight) + (low - loser.x) * width >= 0 ||
        (lost_high + tie - won_low) * (lost_high - loser.weight) - (high - loser.x) * width >= 0) {
        return false;
    }
    const double slope_low = slope(loser, low, lost_low);
    const double slope_high = slope(loser, high, lost_high);
    const double turn = slope_high - slope_low;
    if (!(turn > 0)) return false;
    const double t = std::clamp((lost_low - lost_high + slope_high * width) / turn, 0.0, width);
    const double tangent = lost_low + slope_low * t;
    const double chord = won_low + (won_high - won_low) * (t / width);
    return tangent < chord;
}

}  // namespace

Duel fight(const Window& a, const Window& b, double low, double high) {
    assert(low < high);
    assert(std::max(a.begin, b.begin) <= low && high <= std::min(a.end, b.end));
    const double a_low = a.distance(low), a_high = a.distance(high);
    const double b_low = b.distance(low), b_high = b.distance(high);
    const double tie =
        a.is_served && !b.is_served ? -distance_rounding * b_low : distance_rounding * b_low;
    const bool wins_low = a_low < b_low - tie;
    const bool wins_high = a_high < b_high - tie;
    Duel duel{wins_low};
    duel.is_tie = (std::abs(a_low - b_low) <= distance_rounding * b_low) &
                  (std::abs(a_high - b_high) <= distance_rounding * b_high);
    if (wins_low != wins_high) {
        if ((a_low < b_low) == (a_high < b_high)) {  // They tie at one end.
            duel.first_wins = a_low < b_low;
            return duel;
        }
        duel.num_cuts = 1;
        duel.cuts[0] = crossing(a, b, {low, high}, {a_low - b_low, a_high - b_high});
        return duel;
    }
    if (a.weight == b.weight) return duel;
    const Ends interval{low, high}, of_a{a_low, a_high}, of_b{b_low, b_high};
    const bool may_change = wins_low ? may_win_between(b, interval, of_b, of_a)
                                     : may_win_between(a, interval, of_a, of_b);
    if (!may_change) return duel;
    const auto roots = equal_distances(a, b);
    if (!roots || !(low < (*roots)[0]) || !((*roots)[0] < (*roots)[1]) || !((*roots)[1] < high)) {
        return duel;
    }
    const double middle = ((*roots)[0] + (*roots)[1]) / 2;
    if ((a.distance(middle) < b.distance(middle) - tie) == wins_low) return duel;
    duel.num_cuts = 2;
    duel.cuts = *roots;
    return duel;
}

}  // namespace agvd
