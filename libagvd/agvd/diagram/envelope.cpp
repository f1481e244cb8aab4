// The candidates of a stretch [lo, hi] stand on top of a stack. A stretch that is cut in two
// copies them for the left half and labels that first, so that intervals come in their order.
#include "agvd/diagram/envelope.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace agvd {
namespace {

// Of two relays of one site that differ by less (share of the segment) one is enough.
constexpr double same_relay = 1e-6;
// Ties over a whole stretch that escape the tests would bisect for ever: past this many pieces, and
// this many for each relay, the ends of a piece decide.
constexpr std::size_t max_splits = 200;
constexpr std::size_t max_splits_each = 8;

// Distances that differ by less are tied.
double tie_at(double distance, double length) { return tie_tolerance * (distance + length); }

// From the left, where the slope changes if the segment passes through the source itself.
LineSample from_left(const LineRelay& relay, double x, LineSample s) {
    const auto k = static_cast<std::size_t>(s.source);
    if (relay.y[k] == 0 && relay.x[k] == x) s.slope = -1;
    return s;
}

// Whether c is above b by more than their directions, which are nearly parallel, can change: they
// differ by at most the distance of the images over that of either.
bool is_parallel_above(const Candidate& c, const Candidate& b, double width, double slack) {
    if (c.lo.source != c.hi.source || b.lo.source != b.hi.source) return false;
    const auto i = static_cast<std::size_t>(c.lo.source);
    const auto j = static_cast<std::size_t>(b.lo.source);
    const double dx = c.relay->x[i] - b.relay->x[j];
    // Along the segment only the distance from its line matters, not the side.
    const double dy = std::abs(c.relay->y[i]) - std::abs(b.relay->y[j]);
    if (dx == 0 && dy == 0) return true;
    const double range = b.lo.value - b.relay->weight[j] - width;
    if (!(range > 0)) return false;
    const double gap = std::min(c.lo.value - b.lo.value, c.hi.value - b.hi.value) + slack;
    return gap >= 0 && gap * gap * range * range >= width * width * (dx * dx + dy * dy);
}

// True if c cannot be below b anywhere on the stretch by more than the slack: distances are
// convex, so c lies above its tangents at the ends and b below its chord.
bool is_above(const Candidate& c, const Candidate& b, double width, double slack) {
    if (c.lo.value < b.lo.value - slack || c.hi.value < b.hi.value - slack) return false;
    const double rise = b.hi.value - b.lo.value;
    // A tangent that leaves the chord upwards stays above it.
    if (c.lo.slope * width >= rise || c.hi.slope * width <= rise) return true;
    // Else the tangents meet at lo + t; above the chord there means above it everywhere.
    const double t = (c.lo.value - c.hi.value + c.hi.slope * width) / (c.hi.slope - c.lo.slope);
    return c.lo.value + c.lo.slope * t >= b.lo.value + rise * (t / width) - slack ||
           is_parallel_above(c, b, width, slack);
}

constexpr int max_root_steps = 60;

// The relays of two sites that are the nearest at x.
struct Pair {
    const LineRelay *a, *b;
    double at_a, at_b;
};

Pair nearest_of(std::span<const Candidate> candidates, Index site_a, Index site_b, double x) {
    Pair pair{nullptr, nullptr, infinity, infinity};
    for (const Candidate& candidate : candidates) {
        const LineRelay* const relay = candidate.relay;
        if (relay->site != site_a && relay->site != site_b) continue;
        const double value = sample(*relay, x).value;
        if (relay->site == site_a && value < pair.at_a) {
            pair.a = relay;
            pair.at_a = value;
        } else if (relay->site == site_b && value < pair.at_b) {
            pair.b = relay;
            pair.at_b = value;
        }
    }
    return pair;
}

double newton_step(const LineSample& a, const LineSample& b) {
    return (a.value - b.value) / (a.slope - b.slope);
}

// Where the distances from the sites of a and b are equal: a is nearer at lo, b at hi. Newton,
// relay against relay, until no other relay of the two sites is nearer at the root.
double find_equal(std::span<const Candidate> candidates, const Candidate& a, const Candidate& b,
                  const std::array<double, 2>& stretch, double length) {
    assert(a.relay->site != b.relay->site);
    auto [lo, hi] = stretch;
    const LineRelay* on_a = a.relay;
    const LineRelay* on_b = b.relay;
    const double gap_lo = a.lo.value - b.lo.value;
    const double gap_hi = a.hi.value - b.hi.value;
    double x = lo + (hi - lo) * gap_lo / (gap_lo - gap_hi);
    const bool is_pair = candidates.size() == 2;
    for (int i = 0; i < max_root_steps && hi - lo > shortest_interval * length; ++i) {
        if (!(x > lo && x < hi)) x = (lo + hi) / 2;
        const LineSample at_a = sample(*on_a, x);
        const LineSample at_b = sample(*on_b, x);
        const double gap = at_a.value - at_b.value;
        const bool is_root = std::abs(gap) <= equal_distances * length + tie_at(at_a.value, length);
        const bool halves = i % 4 == 3;  // Now and then, so that it ends.
        if (!is_pair && (is_root || halves)) {
            const Pair nearest = nearest_of(candidates, a.relay->site, b.relay->site, x);
            if (nearest.a != on_a || nearest.b != on_b) {
                on_a = nearest.a;
                on_b = nearest.b;
                const double true_gap = nearest.at_a - nearest.at_b;
                if (std::abs(true_gap) <= equal_distances * length) return x;
                (true_gap < 0 ? lo : hi) = x;
                // From here with the new pair.
                if (halves) x = (lo + hi) / 2;
                x -= newton_step(sample(*on_a, x), sample(*on_b, x));
                continue;
            }
        }
        if (is_root) return x;
        if (is_pair || halves) (gap < 0 ? lo : hi) = x;
        x = halves ? (lo + hi) / 2 : x - newton_step(at_a, at_b);
    }
    return (lo + hi) / 2;
}

struct Envelope {
    double length;
    EnvelopeScratch& scratch;
    std::vector<LabelInterval>& out;
    std::size_t splits_left;
};

// The candidates from `first` to the top of the stack.
struct Stretch {
    double lo, hi;
    std::size_t first;
};

std::span<const Candidate> candidates_of(const Envelope& envelope, const Stretch& stretch) {
    return std::span(envelope.scratch.candidates).subspan(stretch.first);
}

// Best value at one end; among ties the lowest site.
template <typename ValueOf>
Candidate best(std::span<const Candidate> candidates, double length, const ValueOf& value_of) {
    const Candidate* least = candidates.data();
    for (const Candidate& c : candidates) {
        if (value_of(c) < value_of(*least)) least = &c;
    }
    const double limit = value_of(*least) + tie_at(value_of(*least), length);
    const Candidate* result = least;
    for (const Candidate& c : candidates) {
        if (value_of(c) <= limit && c.relay->site < result->relay->site) result = &c;
    }
    return *result;
}

double slack_between(const Candidate& c, const Candidate& b, double length) {
    return c.relay->site == b.relay->site ? same_relay * length
                                          : tie_at(std::max(b.lo.value, b.hi.value), length);
}

// The site wins up to `end`.
void emit(Envelope& envelope, double end, Index site) {
    std::vector<LabelInterval>& out = envelope.out;
    assert(out.empty() || out.back().end <= end / envelope.length);
    if (!out.empty() && out.back().site == site) {
        out.back().end = end / envelope.length;
    } else {
        out.push_back({end / envelope.length, site});
    }
}

// Whether nothing but `site` wins on [lo, hi]: every other candidate lies above one of two.
bool is_alone(std::span<const Candidate> candidates, Index site, double width, double length) {
    const Candidate* at_lo = nullptr;
    const Candidate* at_hi = nullptr;
    for (const Candidate& c : candidates) {
        if (c.relay->site != site) continue;
        if (at_lo == nullptr || c.lo.value < at_lo->lo.value) at_lo = &c;
        if (at_hi == nullptr || c.hi.value < at_hi->hi.value) at_hi = &c;
    }
    assert(at_lo != nullptr);
    const double slack = 2 * shortest_interval * length + tie_at(at_hi->hi.value, length);
    return std::all_of(candidates.begin(), candidates.end(), [&](const Candidate& c) {
        return c.relay->site == site || is_above(c, *at_lo, width, slack) ||
               is_above(c, *at_hi, width, slack);
    });
}

// Labels a stretch by one crossing of two sites, unless there are more.
bool cross_once(Envelope& envelope, const Stretch& stretch, const Candidate& best_lo,
                const Candidate& best_hi) {
    const auto candidates = candidates_of(envelope, stretch);
    const double x =
        find_equal(candidates, best_lo, best_hi, {stretch.lo, stretch.hi}, envelope.length);
    const Index site_lo = best_lo.relay->site;
    const Index site_hi = best_hi.relay->site;
    if (candidates.size() > 2) {
        if (!(x > stretch.lo && x < stretch.hi)) return false;
        std::vector<Candidate>& left = envelope.scratch.left;
        std::vector<Candidate>& right = envelope.scratch.right;
        left.assign(candidates.begin(), candidates.end());
        right = left;
        for (std::size_t i = 0; i < left.size(); ++i) {
            right[i].lo = sample(*left[i].relay, x);
            left[i].hi = from_left(*left[i].relay, x, right[i].lo);
        }
        if (!is_alone(left, site_lo, x - stretch.lo, envelope.length) ||
            !is_alone(right, site_hi, stretch.hi - x, envelope.length)) {
            return false;
        }
    }
    emit(envelope, x, site_lo);
    emit(envelope, stretch.hi, site_hi);
    return true;
}

// Where two relays are about equal, as a third one comes between them there, if well inside.
double near_crossing(const Candidate& a, const Candidate& b, const Stretch& stretch) {
    const double gap_lo = a.lo.value - b.lo.value;
    const double gap_hi = a.hi.value - b.hi.value;
    const double share = gap_lo / (gap_lo - gap_hi);
    return share > 0.1 && share < 0.9 ? stretch.lo + (stretch.hi - stretch.lo) * share
                                      : (stretch.lo + stretch.hi) / 2;
}

void label_stretch(Envelope& envelope, const Stretch& stretch);

void divide(Envelope& envelope, const Stretch& stretch, double mid) {
    --envelope.splits_left;
    std::vector<Candidate>& stack = envelope.scratch.candidates;
    const std::size_t last = stack.size();
    for (std::size_t i = stretch.first; i < last; ++i) {
        Candidate c = stack[i];
        stack[i].lo = sample(*c.relay, mid);  // This entry goes on as the right half.
        c.hi = from_left(*c.relay, mid, stack[i].lo);
        stack.push_back(c);
    }
    label_stretch(envelope, {stretch.lo, mid, last});
    label_stretch(envelope, {mid, stretch.hi, stretch.first});
}

// The sites of a stretch's candidates against those that are the nearest at its ends.
struct SitesLeft {
    bool is_one, are_two;
};

SitesLeft sites_left(std::span<const Candidate> candidates, Index site_lo, Index site_hi) {
    SitesLeft left{true, site_lo != site_hi};
    for (const Candidate& c : candidates) {
        const Index site = c.relay->site;
        left.is_one = left.is_one && site == site_lo;
        left.are_two = left.are_two && (site == site_lo || site == site_hi);
    }
    return left;
}

// Labels a stretch and takes its candidates off the stack.
void label_stretch(Envelope& envelope, const Stretch& stretch) {
    std::vector<Candidate>& stack = envelope.scratch.candidates;
    assert(stretch.first < stack.size() && stretch.lo <= stretch.hi);
    const double length = envelope.length;
    const double width = stretch.hi - stretch.lo;
    const auto all = candidates_of(envelope, stretch);
    const Candidate best_lo = best(all, length, [](const Candidate& c) { return c.lo.value; });
    const Candidate best_hi = best(all, length, [](const Candidate& c) { return c.hi.value; });
    const auto loses = [&](const Candidate& c) {
        return c.relay != best_lo.relay && c.relay != best_hi.relay &&
               (is_above(c, best_lo, width, slack_between(c, best_lo, length)) ||
                is_above(c, best_hi, width, slack_between(c, best_hi, length)));
    };
    stack.erase(std::remove_if(stack.begin() + static_cast<std::ptrdiff_t>(stretch.first),
                               stack.end(), loses),
                stack.end());
    const Index site_lo = best_lo.relay->site;
    const Index site_hi = best_hi.relay->site;
    const SitesLeft left = sites_left(candidates_of(envelope, stretch), site_lo, site_hi);
    if (left.is_one) {
        emit(envelope, stretch.hi, site_lo);
    } else if (width <= shortest_interval * length || envelope.splits_left == 0) {
        emit(envelope, (stretch.lo + stretch.hi) / 2, site_lo);
        emit(envelope, stretch.hi, site_hi);
    } else if (!left.are_two) {
        divide(envelope, stretch, near_crossing(best_lo, best_hi, stretch));
    } else if (!cross_once(envelope, stretch, best_lo, best_hi)) {
        divide(envelope, stretch, (stretch.lo + stretch.hi) / 2);
    }
    stack.resize(stretch.first);
}

// Intervals too short to be told apart go to their neighbour.
void drop_slivers(std::vector<LabelInterval>& intervals) {
    std::size_t kept = 0;
    double begin = 0;
    for (const LabelInterval& interval : intervals) {
        if (interval.end - begin <= shortest_interval && interval.end < 1) continue;
        if (kept > 0 && intervals[kept - 1].site == interval.site) {
            intervals[kept - 1].end = interval.end;
        } else {
            intervals[kept++] = interval;
        }
        begin = interval.end;
    }
    intervals.resize(kept);
}

}  // namespace

void label_envelope(std::span<const LineRelay> relays, const LabelledSegment& segment,
                    EnvelopeScratch& scratch, std::vector<LabelInterval>& out) {
    const auto& [length, site_at_start, site_at_end] = segment;
    assert(!relays.empty() && length > 0);
    out.clear();
    scratch.candidates.clear();
    for (const LineRelay& relay : relays) {
        scratch.candidates.push_back(
            {&relay, sample(relay, 0), from_left(relay, length, sample(relay, length))});
    }
    Envelope envelope{length, scratch, out, max_splits + max_splits_each * relays.size()};
    label_stretch(envelope, {0, length, 0});
    drop_slivers(out);
    assert(!out.empty() && out.back().end == 1);
    if (out.front().site != site_at_start) out.insert(out.begin(), {0, site_at_start});
    if (out.back().site != site_at_end) out.push_back({1, site_at_end});
}

}  // namespace agvd
