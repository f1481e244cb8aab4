// Notation: f_a and f_b are the distances from two sites, each the least over the site's relays.
// [lo, hi] brackets a root of f_a - f_b: a is nearer at lo, b at hi.
#include "agvd/diagram/envelope_candidates.h"

#include <cassert>

namespace agvd {
namespace {

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
        const double value = value_at(*relay, x);
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

}  // namespace

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

}  // namespace agvd
