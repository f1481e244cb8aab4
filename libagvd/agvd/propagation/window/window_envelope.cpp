// Two windows of different weight can change positions twice: their distances w + sqrt((t - x)^2 +
// y^2) are equal at roots of a quadratic. Mostly signs at the ends of the interval decide, or
// tangents against chords, since distances are convex.
#include "agvd/propagation/window/window_envelope.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace agvd {
namespace {

//! Distances that differ by less, relative to their size, are rounding.
inline constexpr double distance_rounding = 1e-14;

//! Which of two windows is nearer, along an interval. The winner changes at each cut.
struct Duel {
    bool first_wins;
    bool is_tie = false;  //!< At both ends.
    int num_cuts = 0;
    std::array<double, 2> cuts{};
};

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

// \param low, high  an interval that both cover. Where they tie, b wins, unless only a is served.
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

// True for an interval that is as short as its rounding.
bool is_rounding(double from, double to) { return !(to - from > 1e-15 * to); }

// Writes an envelope from left to right: pieces of one new window and of old ones.
class Writer {
public:
    Writer(const Window& window, std::vector<Window>& out) : window_(window), out_(out) {}

    void add_new(double from, double to) {
        if (from == new_end_) {
            out_.back().end = to;
            out_.back().at_end = window_.distance(to);
        } else {
            if (is_rounding(from, to)) return;
            out_.push_back(window_.part(from, to));
        }
        new_end_ = to;
    }
    void add_old(const Window& old, double from, double to) {
        if (from == old.begin && to == old.end) {
            out_.push_back(old);
        } else if (!is_rounding(from, to)) {
            out_.push_back(old.part(from, to));
        } else {
            return;
        }
        new_end_ = std::numeric_limits<double>::quiet_NaN();
    }

private:
    const Window& window_;
    std::vector<Window>& out_;
    // The end of the last piece, if that is of the new window.
    double new_end_ = std::numeric_limits<double>::quiet_NaN();
};

// Makes a window empty.
void drop(Window& window) { window.begin = window.end; }

// Cuts a window off. False if nothing would be left.
bool end_at(Window& window, double end) {
    if (is_rounding(window.begin, end)) return false;
    window.at_end = window.distance(end);
    window.end = end;
    return true;
}

void begin_at(Window& window, double begin) {
    window.at_begin = window.distance(begin);
    window.begin = is_rounding(begin, window.end) ? window.end : begin;
}

// Whether `last` is the beam of a vertex and `next` one that passes it. They tie along the ray
// that touches the vertex; if the first kept it, the two would overlap on every edge from there
// on.
bool gives_way(const Window& last, const Window& next, const Duel& duel) {
    constexpr double narrow = 1e-8;
    return duel.is_tie && duel.num_cuts == 0 && !last.is_served && next.weight < last.weight &&
           last.end - next.begin < narrow * last.end;
}

}  // namespace

bool is_envelope(std::span<const Window> windows) {
    for (std::size_t i = 0; i < windows.size(); ++i) {
        if (!(windows[i].begin < windows[i].end)) return false;
        if (i > 0 && windows[i - 1].end > windows[i].begin) return false;
    }
    return true;
}

bool cut_where_they_change(Window& last, Window& next) {
    assert(last.begin < last.end && next.begin < next.end && next.begin < last.end);
    if (is_rounding(next.begin, last.end)) {
        begin_at(next, last.end);
        return true;
    }
    if (next.begin < last.begin) return false;
    const double high = std::min(last.end, next.end);
    const Duel duel = fight(next, last, next.begin, high);
    if (duel.num_cuts > 1) return false;
    if (high < last.end) {  // The last window extends on both sides of the next one.
        if (duel.first_wins || duel.num_cuts == 1) return false;
        drop(next);
        return true;
    }
    if (duel.first_wins || gives_way(last, next, duel)) {
        return duel.num_cuts == 0 && end_at(last, next.begin);
    }
    double begin = last.end;
    if (duel.num_cuts == 1) {
        begin = duel.cuts[0];
        if (is_rounding(begin, last.end) || !end_at(last, begin)) return false;
    }
    begin_at(next, begin);
    return true;
}

void insert_window(const Window& window, std::vector<Window>& scratch,
                   std::vector<Window>& envelope) {
    assert(window.begin < window.end);
    assert(is_envelope(envelope));
    auto first = envelope.end();
    while (first != envelope.begin() && (first - 1)->end > window.begin) --first;
    if (first == envelope.end()) {
        envelope.push_back(window);
        return;
    }
    scratch.assign(first, envelope.end());
    envelope.erase(first, envelope.end());
    Writer writer(window, envelope);
    double decided = window.begin;  // The new window is written up to here.
    for (const Window& old : scratch) {
        const double low = std::max(old.begin, window.begin);
        const double high = std::min(old.end, window.end);
        const double gap_end = std::min(old.begin, window.end);
        if (decided < gap_end) writer.add_new(decided, gap_end);
        decided = std::max(decided, gap_end);
        if (!(low < high)) {
            writer.add_old(old, old.begin, old.end);
            continue;
        }
        const Duel duel = fight(window, old, low, high);
        double old_begin = old.begin;
        double from = low;
        bool is_new = duel.first_wins;
        for (int i = 0; i <= duel.num_cuts; ++i) {
            const double to = i < duel.num_cuts ? duel.cuts[static_cast<std::size_t>(i)] : high;
            if (is_new) {
                if (old_begin < from) writer.add_old(old, old_begin, from);
                writer.add_new(from, to);
                old_begin = to;
            }
            from = to;
            is_new = !is_new;
        }
        if (old_begin < old.end) writer.add_old(old, old_begin, old.end);
        decided = high;
    }
    if (decided < window.end) writer.add_new(decided, window.end);
    assert(is_envelope(envelope));
}

std::optional<Window> merge_windows(const Window& left, const Window& right, double max_error) {
    if (left.end != right.begin) return std::nullopt;
    assert(left.begin < left.end && right.begin < right.end && left.y <= 0 && right.y <= 0);
    const double begin = left.begin;
    const double joint = left.end;
    const double end = right.end;
    const double slope_begin = (begin - left.x) / -left.y;
    const double slope_end = (end - right.x) / -right.y;
    if (!(slope_begin < slope_end)) return std::nullopt;
    // The inner end rays must stay inside the beam, too.
    if ((joint - left.x) / -left.y > slope_end) return std::nullopt;
    if ((joint - right.x) / -right.y < slope_begin) return std::nullopt;
    Window merged = left;
    merged.y = (begin - end) / (slope_end - slope_begin);
    merged.x = begin + slope_begin * merged.y;
    merged.weight = 0;
    merged.begin = merged.end = std::numeric_limits<double>::quiet_NaN();
    const double run_begin = merged.distance(begin);
    const double run_end = merged.distance(end);
    // If the image were much farther than the source, distances would lose digits.
    constexpr double farthest = 1e4;
    if (!(run_begin < farthest * left.at_begin && run_end < farthest * right.at_end)) {
        return std::nullopt;
    }
    const double run_joint = merged.distance(joint);
    const std::array gaps{run_begin - left.at_begin, run_joint - left.at_end,
                          run_joint - right.at_begin, run_end - right.at_end};
    const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
    constexpr float round_up = 1 + 0x1p-20F;
    merged.error =
        (std::max(left.error, right.error) + static_cast<float>(*most - *least)) * round_up;
    merged.weight = -*most;
    merged.begin = begin;
    merged.end = end;
    merged.at_begin = run_begin + merged.weight;
    merged.at_end = run_end + merged.weight;
    if (!(merged.error <= max_error * merged.nearest())) return std::nullopt;
    return merged;
}

}  // namespace agvd
