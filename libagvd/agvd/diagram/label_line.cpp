// Most lines have one label change, which tangents prove to be the only one; else see envelope.h.
//
// Notation: f_a and f_b are the distances from two sites along the segment [0, length], each the
// least over the site's relays. They are not convex, as those through one relay are: chords are
// those of the relays that are nearest at the root.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "agvd/diagram/envelope.h"

namespace agvd {
namespace {

constexpr std::size_t most_relays = 16;

struct Search {
    std::span<const LineRelay> relays;
    double length;
    Index a, b;
    // f_a and f_b at the ends of the segment.
    double a_lo = infinity, a_hi = infinity, b_lo = infinity, b_hi = infinity;
};

void find_end_distances(Search& search) {
    for (const LineRelay& relay : search.relays) {
        const double lo = sample(relay, 0).value;
        const double hi = sample(relay, search.length).value;
        if (relay.site == search.a) {
            search.a_lo = std::min(search.a_lo, lo);
            search.a_hi = std::min(search.a_hi, hi);
        } else if (relay.site == search.b) {
            search.b_lo = std::min(search.b_lo, lo);
            search.b_hi = std::min(search.b_hi, hi);
        }
    }
}

// All relays at one point, and the nearest of each site: their number where there is none.
struct Samples {
    std::array<LineSample, most_relays> of;
    std::size_t best_a, best_b;
};

void sample_all(const Search& search, double x, Samples& samples) {
    const std::size_t none = search.relays.size();
    samples.best_a = samples.best_b = none;
    for (std::size_t i = 0; i < none; ++i) {
        const LineRelay& relay = search.relays[i];
        samples.of[i] = sample(relay, x);
        if (relay.site != search.a && relay.site != search.b) continue;
        std::size_t& best = relay.site == search.a ? samples.best_a : samples.best_b;
        if (best == none || samples.of[i].value < samples.of[best].value) best = i;
    }
}

// Compares tangents at the root with the distances at the ends: neither site becomes the nearest
// again beyond the root, and no third one is the nearest anywhere.
// \param clear  differences below this decide nothing.
bool is_only_change(const Search& search, const Samples& samples, const SingleCrossing& root,
                    double clear) {
    const double a_lo = sample(search.relays[samples.best_a], 0).value;
    const double b_hi = sample(search.relays[samples.best_b], search.length).value;
    for (std::size_t i = 0; i < search.relays.size(); ++i) {
        const LineSample& s = samples.of[i];
        const double at_start = s.value - s.slope * root.at;
        const double at_end = s.value + s.slope * (search.length - root.at);
        const Index site = search.relays[i].site;
        bool is_above = false;
        if (site == search.b) {
            is_above = at_start >= a_lo - clear;
        } else if (site == search.a) {
            is_above = at_end >= b_hi - clear;
        } else {
            is_above = s.value >= root.distance + clear && at_start >= a_lo + clear &&
                       at_end >= b_hi + clear;
        }
        if (!is_above) return false;
    }
    return true;
}

struct Bracket {
    double lo, hi;

    [[nodiscard]] bool holds(double x) const { return x > lo && x < hi; }
    [[nodiscard]] double middle() const { return (lo + hi) / 2; }
};

// Newton for the nearest relays at x, until one more step is enough: each doubles the digits.
double step_to_root(const Search& search, const Samples& samples, const Bracket& bracket,
                    double x) {
    const LineRelay& relay_a = search.relays[samples.best_a];
    const LineRelay& relay_b = search.relays[samples.best_b];
    const double nearly = 1e-6 * search.length;
    LineSample at_a = samples.of[samples.best_a];
    LineSample at_b = samples.of[samples.best_b];
    for (int step = 0; step < 4; ++step) {
        const double gap = at_a.value - at_b.value;
        x -= gap / (at_a.slope - at_b.slope);
        if (!bracket.holds(x)) return bracket.middle();
        if (std::abs(gap) <= nearly) break;
        at_a = sample(relay_a, x);
        at_b = sample(relay_b, x);
    }
    return x;
}

// The nearest relay of a site at x.
LineSample least_sample(std::span<const LineRelay> relays, Index site, double x) {
    LineSample least{infinity, 0, 0};
    for (const LineRelay& relay : relays) {
        if (relay.site != site) continue;
        const LineSample here = sample(relay, x);
        if (here.value < least.value) least = here;
    }
    return least;
}

}  // namespace

std::optional<SingleCrossing> find_single_crossing(std::span<const LineRelay> relays, double length,
                                                   Index a, Index b) {
    assert(a != b);
    if (relays.size() > most_relays) return {};
    Search search{relays, length, a, b};
    find_end_distances(search);
    const double gap_lo = search.b_lo - search.a_lo;
    const double gap_hi = search.a_hi - search.b_hi;
    const double clear = shortest_interval * (length + search.a_lo);
    if (!(gap_lo > clear && gap_hi > clear)) return {};
    double x = length * gap_lo / (gap_lo + gap_hi);
    if (!(x > 0 && x < length)) x = length / 2;  // Sites that no relay reaches, or rounding.

    // Relay against relay, until no other relay is nearer at the root.
    constexpr int most_rounds = 6;
    const double tolerance = equal_distances * (length + search.a_lo);
    Bracket bracket{0, length};
    Samples samples;
    for (int round = 0; round < most_rounds; ++round) {
        sample_all(search, x, samples);
        if (samples.best_a == relays.size() || samples.best_b == relays.size()) return {};
        const double at_a = samples.of[samples.best_a].value;
        const double at_b = samples.of[samples.best_b].value;
        const double gap = at_a - at_b;
        if (std::abs(gap) <= tolerance) {
            const SingleCrossing root{x, std::max(at_a, at_b)};
            if (!is_only_change(search, samples, root, clear)) return {};
            return root;
        }
        (gap < 0 ? bracket.lo : bracket.hi) = x;
        x = step_to_root(search, samples, bracket, x);
    }
    return {};
}

void label_line(std::span<const LineRelay> relays, LineId line, const LabelledSegment& segment,
                EnvelopeScratch& scratch, std::vector<Crossing>& out) {
    const auto& [length, site_at_start, site_at_end] = segment;
    if (site_at_start != site_at_end) {
        const auto single = find_single_crossing(relays, length, site_at_start, site_at_end);
        if (single) {
            out.push_back(
                {single->at / length, single->distance, site_at_start, site_at_end, line});
            return;
        }
    }
    std::vector<LabelInterval>& intervals = scratch.intervals;
    label_envelope(relays, segment, scratch, intervals);
    for (std::size_t i = 0; i + 1 < intervals.size(); ++i) {
        const Index before = intervals[i].site;
        const Index after = intervals[i + 1].site;
        const double x = intervals[i].end * length;
        const double distance =
            std::max(distance_on_line(relays, before, x), distance_on_line(relays, after, x));
        out.push_back({intervals[i].end, distance, before, after, line});
    }
}

void settle_crossings(std::span<const LineRelay> relays, double length,
                      std::span<Crossing> crossings) {
    constexpr int most_steps = 4;
    constexpr double rounding = 2e-16;  // Share of the distances.
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        Crossing& crossing = crossings[i];
        const Bracket bracket{i == 0 ? 0 : crossings[i - 1].at * length,
                              i + 1 == crossings.size() ? length : crossings[i + 1].at * length};
        double gap = infinity;
        double x = crossing.at * length;
        for (int step = 0; step <= most_steps && bracket.holds(x); ++step) {
            const LineSample a = least_sample(relays, crossing.site_before, x);
            const LineSample b = least_sample(relays, crossing.site_after, x);
            const double gap_here = a.value - b.value;
            if (!(std::abs(gap_here) < gap)) break;
            gap = std::abs(gap_here);
            crossing.at = x / length;
            crossing.distance = std::max(a.value, b.value);
            if (gap <= rounding * a.value) break;
            x -= gap_here / (a.slope - b.slope);
        }
    }
}

}  // namespace agvd
