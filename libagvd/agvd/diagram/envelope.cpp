#include "agvd/diagram/envelope.h"

#include <algorithm>
#include <cmath>

namespace agvd {
namespace {

using Candidate = EnvelopeScratch::Candidate;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Crossings are separated down to this share of the segment; below, the ends decide.
constexpr double shortest_interval = 1e-9;
// At a crossing distances are equal up to this share of the segment.
constexpr double equality = 1e-11;
constexpr int max_root_steps = 60;
// Of two relays of one site that differ by less (share of the segment) one is enough.
constexpr double same_relay = 1e-6;
// Ties over a whole stretch that escape the tests would bisect for ever: past this many pieces, and
// this many for each relay, the ends of a piece decide.
constexpr std::size_t max_splits = 200;
constexpr std::size_t max_splits_each = 8;

double value_at(const LineRelay& relay, double x) {
    const std::size_t k = x < relay.first ? 0 : x > relay.last ? 2 : 1;
    const double dx = x - relay.x[k];
    return relay.weight[k] + std::sqrt(dx * dx + relay.y[k] * relay.y[k]);
}

class Envelope {
public:
    Envelope(double length, EnvelopeScratch& scratch, std::vector<LabelInterval>& out)
        : length_(length),
          stack_(scratch.candidates),
          left_(scratch.left),
          right_(scratch.right),
          out_(out) {}

    void run(std::span<const LineRelay> relays) {
        stack_.clear();
        splits_left_ = max_splits + max_splits_each * relays.size();
        for (const LineRelay& relay : relays) {
            stack_.push_back({&relay, sample(relay, 0), at_right_end(relay, length_)});
        }
        split(0, length_, 0);
    }

private:
    static LineSample at_right_end(const LineRelay& relay, double x) {
        return from_left(relay, x, sample(relay, x));
    }

    // The segment may pass through the source itself: then the slope changes there.
    static LineSample from_left(const LineRelay& relay, double x, LineSample s) {
        const auto k = static_cast<std::size_t>(s.source);
        if (relay.y[k] == 0 && relay.x[k] == x) s.slope = -1;
        return s;
    }

    [[nodiscard]] double tolerance(double value) const { return tie_tolerance * (value + length_); }

    // Best value at one end; among ties the lowest site.
    template <typename ValueOf>
    [[nodiscard]] Candidate best(std::size_t first, const ValueOf& value_of) const {
        std::size_t least = first;
        for (std::size_t i = first + 1; i < stack_.size(); ++i) {
            if (value_of(stack_[i]) < value_of(stack_[least])) least = i;
        }
        const double limit = value_of(stack_[least]) + tolerance(value_of(stack_[least]));
        std::size_t result = least;
        for (std::size_t i = first; i < stack_.size(); ++i) {
            if (value_of(stack_[i]) <= limit &&
                stack_[i].relay->site < stack_[result].relay->site) {
                result = i;
            }
        }
        return stack_[result];
    }

    // True if c cannot be below b anywhere on [lo, hi] by more than the slack.
    [[nodiscard]] bool is_above(const Candidate& c, const Candidate& b, double lo, double hi,
                                double slack) const {
        if (c.lo.value < b.lo.value - slack || c.hi.value < b.hi.value - slack) return false;
        const double width = hi - lo;
        const double rise = b.hi.value - b.lo.value;
        // A tangent that leaves the chord upwards stays above it.
        if (c.lo.slope * width >= rise || c.hi.slope * width <= rise) return true;
        // Else the tangents meet at lo + t; above the chord there means above it everywhere.
        const double t = (c.lo.value - c.hi.value + c.hi.slope * width) / (c.hi.slope - c.lo.slope);
        return c.lo.value + c.lo.slope * t >= b.lo.value + rise * (t / width) - slack ||
               are_parallel(c, b, width, slack);
    }

    // Seen from x, two images differ in direction by at most their distance over either's distance,
    // so near images have nearly parallel distances: told apart without bisecting.
    [[nodiscard]] static bool are_parallel(const Candidate& c, const Candidate& b, double width,
                                           double slack) {
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

    [[nodiscard]] double slack_between(const Candidate& c, const Candidate& b) const {
        return c.relay->site == b.relay->site ? same_relay * length_
                                              : tolerance(std::max(b.lo.value, b.hi.value));
    }

    void emit(double end, Index site) {
        if (!out_.empty() && out_.back().site == site) {
            out_.back().end = end / length_;
        } else {
            out_.push_back({end / length_, site});
        }
    }

    // The relays of two sites, among the candidates from `first` on, that are the nearest at x.
    struct Pair {
        const LineRelay *a, *b;
        double at_a, at_b;
    };
    [[nodiscard]] Pair nearest_of(Index site_a, Index site_b, std::size_t first, double x) const {
        Pair pair{nullptr, nullptr, infinity, infinity};
        for (std::size_t i = first; i < stack_.size(); ++i) {
            const LineRelay* const relay = stack_[i].relay;
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

    // A point where the distances from two sites are equal; a is nearer at lo, b at hi. Newton,
    // relay against relay, until no other relay of the two sites is nearer at the root.
    [[nodiscard]] double crossing(const Candidate& a, const Candidate& b, std::size_t first,
                                  double lo, double hi) const {
        const LineRelay* on_a = a.relay;
        const LineRelay* on_b = b.relay;
        const double gap_lo = a.lo.value - b.lo.value;
        const double gap_hi = a.hi.value - b.hi.value;
        double x = lo + (hi - lo) * gap_lo / (gap_lo - gap_hi);
        const bool is_pair = stack_.size() - first == 2;
        for (int i = 0; i < max_root_steps && hi - lo > shortest_interval * length_; ++i) {
            if (!(x > lo && x < hi)) x = (lo + hi) / 2;
            const LineSample at_a = sample(*on_a, x);
            const LineSample at_b = sample(*on_b, x);
            const double gap = at_a.value - at_b.value;
            const bool is_root = std::abs(gap) <= equality * length_ + tolerance(at_a.value);
            const bool is_checked = is_root || i % 4 == 3;
            if (!is_pair && is_checked) {
                const Pair nearest = nearest_of(a.relay->site, b.relay->site, first, x);
                if (nearest.a != on_a || nearest.b != on_b) {
                    on_a = nearest.a;
                    on_b = nearest.b;
                    const double true_gap = nearest.at_a - nearest.at_b;
                    if (std::abs(true_gap) <= equality * length_) return x;
                    (true_gap < 0 ? lo : hi) = x;
                    // From here with the new pair; halving now and then, so that it ends.
                    if (i % 4 == 3) x = (lo + hi) / 2;
                    const LineSample new_a = sample(*on_a, x);
                    const LineSample new_b = sample(*on_b, x);
                    x -= (new_a.value - new_b.value) / (new_a.slope - new_b.slope);
                    continue;
                }
            }
            if (is_root) return x;
            if (is_pair || is_checked) (gap < 0 ? lo : hi) = x;
            x = i % 4 == 3 ? (lo + hi) / 2 : x - gap / (at_a.slope - at_b.slope);
        }
        return (lo + hi) / 2;
    }

    // Whether nothing but `site` wins on [lo, hi]: every other candidate lies above one of two.
    [[nodiscard]] bool is_alone(const std::vector<Candidate>& candidates, Index site, double lo,
                                double hi) const {
        const Candidate* at_lo = nullptr;
        const Candidate* at_hi = nullptr;
        for (const Candidate& c : candidates) {
            if (c.relay->site != site) continue;
            if (at_lo == nullptr || c.lo.value < at_lo->lo.value) at_lo = &c;
            if (at_hi == nullptr || c.hi.value < at_hi->hi.value) at_hi = &c;
        }
        const double slack = 2 * shortest_interval * length_ + tolerance(at_hi->hi.value);
        return std::all_of(candidates.begin(), candidates.end(), [&](const Candidate& c) {
            return c.relay->site == site || is_above(c, *at_lo, lo, hi, slack) ||
                   is_above(c, *at_hi, lo, hi, slack);
        });
    }

    // Labels [lo, hi] by one crossing of two sites, unless there are more.
    bool cross_once(const Candidate& below, const Candidate& above, std::size_t first, double lo,
                    double hi) {
        const double x = crossing(below, above, first, lo, hi);
        if (stack_.size() - first == 2) {
            emit(x, below.relay->site);
            emit(hi, above.relay->site);
            return true;
        }
        if (!(x > lo && x < hi)) return false;
        left_.assign(stack_.begin() + static_cast<std::ptrdiff_t>(first), stack_.end());
        right_ = left_;
        for (std::size_t i = 0; i < left_.size(); ++i) {
            right_[i].lo = sample(*left_[i].relay, x);
            left_[i].hi = from_left(*left_[i].relay, x, right_[i].lo);
        }
        if (!is_alone(left_, below.relay->site, lo, x) ||
            !is_alone(right_, above.relay->site, x, hi)) {
            return false;
        }
        emit(x, below.relay->site);
        emit(hi, above.relay->site);
        return true;
    }

    // Labels [lo, hi] by the candidates from `first` to the top of the stack, which it consumes.
    void split(double lo, double hi, std::size_t first) {
        const Candidate best_lo = best(first, [](const Candidate& c) { return c.lo.value; });
        const Candidate best_hi = best(first, [](const Candidate& c) { return c.hi.value; });
        const auto loses = [&](const Candidate& c) {
            return c.relay != best_lo.relay && c.relay != best_hi.relay &&
                   (is_above(c, best_lo, lo, hi, slack_between(c, best_lo)) ||
                    is_above(c, best_hi, lo, hi, slack_between(c, best_hi)));
        };
        stack_.erase(std::remove_if(stack_.begin() + static_cast<std::ptrdiff_t>(first),
                                    stack_.end(), loses),
                     stack_.end());
        const Index site_lo = best_lo.relay->site;
        const Index site_hi = best_hi.relay->site;
        bool has_one_site = true;
        bool has_two_sites = site_lo != site_hi;
        for (std::size_t i = first; i < stack_.size(); ++i) {
            const Index site = stack_[i].relay->site;
            has_one_site = has_one_site && site == site_lo;
            has_two_sites = has_two_sites && (site == site_lo || site == site_hi);
        }
        if (has_one_site) {
            emit(hi, site_lo);
        } else if (hi - lo <= shortest_interval * length_ || splits_left_ == 0) {
            emit((lo + hi) / 2, site_lo);
            emit(hi, site_hi);
        } else if (!has_two_sites) {
            divide(lo, near_crossing(best_lo, best_hi, lo, hi), hi, first);
        } else if (!cross_once(best_lo, best_hi, first, lo, hi)) {
            divide(lo, (lo + hi) / 2, hi, first);
        }
        stack_.resize(first);
    }

    // Where two relays are about equal, if that is well inside: whoever comes between them is
    // likely to do so there. Else the middle.
    [[nodiscard]] static double near_crossing(const Candidate& a, const Candidate& b, double lo,
                                              double hi) {
        const double gap_lo = a.lo.value - b.lo.value;
        const double gap_hi = a.hi.value - b.hi.value;
        const double share = gap_lo / (gap_lo - gap_hi);
        return share > 0.1 && share < 0.9 ? lo + (hi - lo) * share : (lo + hi) / 2;
    }

    void divide(double lo, double mid, double hi, std::size_t first) {
        --splits_left_;
        const std::size_t last = stack_.size();
        for (std::size_t i = first; i < last; ++i) {
            Candidate c = stack_[i];
            stack_[i].lo = sample(*c.relay, mid);  // This entry goes on as the upper half.
            c.hi = from_left(*c.relay, mid, stack_[i].lo);
            stack_.push_back(c);
        }
        split(lo, mid, last);
        split(mid, hi, first);
    }

    double length_;
    std::vector<Candidate>& stack_;
    std::vector<Candidate>& left_;
    std::vector<Candidate>& right_;
    std::vector<LabelInterval>& out_;
    std::size_t splits_left_ = 0;
};

// Stretches too short to be told apart go to their neighbour.
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

LineRelay on_line(const PlanarRelay& relay, const Vec2& start, const Vec2& along, double length) {
    LineRelay line{};
    line.first = -infinity;
    line.last = infinity;
    line.site = relay.site;
    const auto set = [&](std::size_t source, const Vec2& p, double weight) {
        const Vec2 d = p - start;
        line.x[source] = d.dot(along);
        line.y[source] = cross(along, d);
        line.weight[source] = weight;
    };
    set(1, relay.image, relay.weight);
    if (relay.sees_all) return line;
    // Out of sight beyond `begin` where behind(x) = at_start + rise * x > 0, and beyond `end` where
    // the same with the sign turned. Only one of them can apply on one side of the segment.
    const auto hide = [&](const Vec2& end, double weight, double sign) {
        const Vec2 ray = end - relay.image;
        const double at_start = sign * cross(ray, start - relay.image);
        const double rise = sign * cross(ray, along);
        if (rise < 0 ? at_start > 0 : rise == 0 && at_start > 0) {
            line.first = rise < 0 ? -at_start / rise : infinity;
            set(0, end, weight);
        } else if (rise > 0 && at_start + rise * length > 0) {
            line.last = -at_start / rise;
            set(2, end, weight);
        }
    };
    hide(relay.begin, relay.at_begin, 1);
    hide(relay.end, relay.at_end, -1);
    return line;
}

double distance_on_line(std::span<const LineRelay> relays, Index site, double x) {
    double least = infinity;
    for (const LineRelay& relay : relays) {
        if (relay.site == site) least = std::min(least, sample(relay, x).value);
    }
    return least;
}

void append_pieces(std::span<const LineRelay> relays, Index site, double begin, double end,
                   std::vector<StraightPiece>& out) {
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    const auto append = [&](const LineRelay& relay, std::size_t source, double lo, double hi) {
        if (!(hi > lo)) return;
        const Vec2 from(relay.x[source], relay.y[source]);
        // Paths that bend at one point are one.
        const auto same = std::find_if(out.begin() + first, out.end(), [&](const auto& piece) {
            return piece.from == from && piece.weight == relay.weight[source];
        });
        if (same == out.end()) {
            out.push_back({from, relay.weight[source], lo, hi, site});
        } else {
            same->begin = std::min(same->begin, lo);
            same->end = std::max(same->end, hi);
        }
    };
    for (const LineRelay& relay : relays) {
        if (relay.site != site) continue;
        const double straight = std::clamp(relay.first, begin, end);
        const double bent = std::clamp(relay.last, straight, end);
        append(relay, 0, begin, straight);
        append(relay, 1, straight, bent);
        append(relay, 2, bent, end);
    }
}

bool find_single_crossing(std::span<const LineRelay> relays, double length, Index a, Index b,
                          double& at, double& distance) {
    std::array<LineSample, 16> samples;
    if (relays.size() > samples.size()) return false;
    double a_lo = infinity, a_hi = infinity, b_lo = infinity, b_hi = infinity;
    for (const LineRelay& relay : relays) {
        const double lo = value_at(relay, 0);
        const double hi = value_at(relay, length);
        if (relay.site == a) {
            a_lo = std::min(a_lo, lo);
            a_hi = std::min(a_hi, hi);
        } else if (relay.site == b) {
            b_lo = std::min(b_lo, lo);
            b_hi = std::min(b_hi, hi);
        }
    }
    const double gap_lo = b_lo - a_lo;
    const double gap_hi = a_hi - b_hi;
    const double clear = shortest_interval * (length + a_lo);
    if (!(gap_lo > clear && gap_hi > clear)) return false;
    double x = length * gap_lo / (gap_lo + gap_hi);
    if (!(x > 0 && x < length)) x = length / 2;  // Sites that no relay reaches, or rounding.

    // Newton, relay against relay, until no other relay is nearer at the root.
    const double tolerance = equality * (length + a_lo);
    double lo = 0, hi = length;
    for (int round = 0; round < 6; ++round) {
        std::size_t best_a = relays.size();
        std::size_t best_b = relays.size();
        for (std::size_t i = 0; i < relays.size(); ++i) {
            samples[i] = sample(relays[i], x);
            if (relays[i].site == a) {
                if (best_a == relays.size() || samples[i].value < samples[best_a].value) best_a = i;
            } else if (relays[i].site == b) {
                if (best_b == relays.size() || samples[i].value < samples[best_b].value) best_b = i;
            }
        }
        if (best_a == relays.size() || best_b == relays.size()) return false;
        LineSample at_a = samples[best_a];
        LineSample at_b = samples[best_b];
        double gap = at_a.value - at_b.value;
        if (std::abs(gap) <= tolerance) {
            at = x;
            distance = std::max(at_a.value, at_b.value);
            // Tangents at the root against chords to the ends: nothing changes sides again, and
            // nobody else comes in.
            for (std::size_t i = 0; i < relays.size(); ++i) {
                const LineSample& s = samples[i];
                const double at_start = s.value - s.slope * x;
                const double at_end = s.value + s.slope * (length - x);
                const Index site = relays[i].site;
                const bool is_above = site == b ? at_start >= a_lo - clear
                                      : site == a
                                          ? at_end >= b_hi - clear
                                          : s.value >= distance + clear &&
                                                at_start >= a_lo + clear && at_end >= b_hi + clear;
                if (!is_above) return false;
            }
            return true;
        }
        (gap < 0 ? lo : hi) = x;
        // Steps double the digits: from here one more is enough.
        const double nearly = 1e-6 * length;
        for (int step = 0; step < 4; ++step) {
            x -= gap / (at_a.slope - at_b.slope);
            if (!(x > lo && x < hi)) {
                x = (lo + hi) / 2;
                break;
            }
            if (std::abs(gap) <= nearly) break;
            at_a = sample(relays[best_a], x);
            at_b = sample(relays[best_b], x);
            gap = at_a.value - at_b.value;
        }
    }
    return false;
}

void label_envelope(std::span<const LineRelay> relays, double length, Index site_at_start,
                    Index site_at_end, EnvelopeScratch& scratch, std::vector<LabelInterval>& out) {
    out.clear();
    Envelope(length, scratch, out).run(relays);
    drop_slivers(out);
    if (out.front().site != site_at_start) out.insert(out.begin(), {0, site_at_start});
    if (out.back().site != site_at_end) out.push_back({1, site_at_end});
}

}  // namespace agvd
