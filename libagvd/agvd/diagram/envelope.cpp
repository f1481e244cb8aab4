#include "agvd/diagram/envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace agvd {
namespace {

using Candidate = EnvelopeScratch::Candidate;

// Crossings are separated down to this share of the segment; below, the ends decide.
constexpr double shortest_interval = 1e-9;
constexpr int max_root_steps = 60;

// Of two relays of one site that differ by less (share of the segment) one is enough.
constexpr double same_relay = 1e-6;
// Images closer than this share of the segment are one.
constexpr double same_image = 1e-12;
// Ties over a whole stretch that escape the tests would bisect for ever: past this many pieces the
// ends of a piece decide.
constexpr int max_splits = 200;

struct Sample {
    double value, slope;
    Vec2 from;
};

class Envelope {
public:
    Envelope(const Vec2& p, const Vec2& q, EnvelopeScratch& scratch,
             std::vector<LabelInterval>& out, std::vector<EnvelopePiece>* pieces)
        : p_(p),
          length_((q - p).norm()),
          along_((q - p) / length_),
          stack_(scratch.candidates),
          left_(scratch.left),
          right_(scratch.right),
          out_(out),
          pieces_(pieces) {}

    void run(std::span<const PlanarRelay> relays) {
        stack_.clear();
        for (const PlanarRelay& relay : relays) {
            const Sample lo = sample(relay, 0, 1);
            const Sample hi = sample(relay, length_, -1);
            stack_.push_back({&relay, lo.value, lo.slope, hi.value, hi.slope, lo.from, hi.from});
        }
        split(0, length_, 0);
    }

private:
    // `side` chooses the one-sided slope where the segment passes through the relay itself.
    [[nodiscard]] Sample sample(const PlanarRelay& relay, double x, double side) const {
        const Vec2 at = p_ + x * along_;
        const Reach r = reach(relay, at);
        const Vec2 step = at - r.from;
        const double norm = step.norm();
        return {r.distance, norm > 0 ? step.dot(along_) / norm : side, r.from};
    }

    [[nodiscard]] double tolerance(double value) const { return tie_tolerance * (value + length_); }

    // Best value at one end; among ties the lowest site.
    template <typename ValueOf>
    [[nodiscard]] const Candidate& best(std::size_t first, const ValueOf& value_of) const {
        const auto by_value = [&](const Candidate& a, const Candidate& b) {
            return value_of(a) < value_of(b);
        };
        const auto begin = stack_.begin() + static_cast<std::ptrdiff_t>(first);
        const auto least = std::min_element(begin, stack_.end(), by_value);
        const double limit = value_of(*least) + tolerance(value_of(*least));
        auto result = least;
        for (auto c = begin; c != stack_.end(); ++c) {
            if (value_of(*c) <= limit && c->relay->site < result->relay->site) result = c;
        }
        return *result;
    }

    [[nodiscard]] bool are_one(const Vec2& a, const Vec2& b) const {
        return (a - b).squaredNorm() <= same_image * same_image * length_ * length_;
    }

    [[nodiscard]] double slack_between(const Candidate& c, const Candidate& b) const {
        return c.relay->site == b.relay->site
                   ? same_relay * length_
                   : tolerance(std::max(b.value_lo, b.value_hi));
    }

    // True if c cannot be below b anywhere on [lo, hi] by more than the slack.
    [[nodiscard]] bool is_above(const Candidate& c, const Candidate& b, double lo, double hi,
                                double slack) const {
        if (c.value_lo < b.value_lo - slack || c.value_hi < b.value_hi - slack) return false;
        const double width = hi - lo;
        if (are_one(c.from_lo, c.from_hi) && are_one(b.from_lo, b.from_hi)) {
            // Seen from x, two images differ in direction by at most their distance over either's
            // distance, so near images have nearly parallel distances: told apart without
            // bisecting.
            const double apart = (c.from_lo - b.from_lo).norm();
            const double range = (p_ + lo * along_ - b.from_lo).norm() - width;
            const double gap = std::min(c.value_lo - b.value_lo, c.value_hi - b.value_hi);
            if (apart == 0 || (range > 0 && gap + slack >= width * apart / range)) return true;
        }
        const double chord = (b.value_hi - b.value_lo) / width;
        // The tangents at both ends meet at lo + t; above the chord there means above it
        // everywhere.
        const double bend = c.slope_hi - c.slope_lo;
        double t = bend > 0 ? (c.value_lo - c.value_hi + c.slope_hi * width) / bend : 0;
        t = std::clamp(t, 0.0, width);
        const double tangent =
            std::max(c.value_lo + c.slope_lo * t, c.value_hi - c.slope_hi * (width - t));
        return tangent >= b.value_lo + chord * t - slack;
    }

    void emit(double end, Index site) {
        if (!out_.empty() && out_.back().site == site) {
            out_.back().end = end / length_;
        } else {
            out_.push_back({end / length_, site});
        }
    }

    // Where the line from a relay's image past a bend meets the segment.
    [[nodiscard]] double line_hit(const Vec2& image, const Vec2& bend) const {
        const Vec2 ray = bend - image;
        const double slope = cross(ray, along_);
        return slope != 0 ? cross(image - p_, ray) / -slope : 0;
    }

    // Splits a candidate's stretch [lo, hi] where its path begins or ceases to bend.
    void emit_pieces(const Candidate& c, double lo, double hi) {
        if (pieces_ == nullptr) return;
        const Vec2& image = c.relay->image;
        const bool bends_lo = c.from_lo != image;
        const bool bends_hi = c.from_hi != image;
        if (bends_lo && bends_hi && c.from_lo == c.from_hi) {
            emit_piece(c, c.from_lo, lo, hi);
            return;
        }
        const double begin = bends_lo ? std::clamp(line_hit(image, c.from_lo), lo, hi) : lo;
        const double end = bends_hi ? std::clamp(line_hit(image, c.from_hi), begin, hi) : hi;
        if (bends_lo) emit_piece(c, c.from_lo, lo, begin);
        emit_piece(c, image, begin, end);
        if (bends_hi) emit_piece(c, c.from_hi, end, hi);
    }

    void emit_piece(const Candidate& c, const Vec2& from, double begin, double end) {
        if (!(end > begin)) return;
        for (auto piece = pieces_->rbegin(); piece != pieces_->rend() && piece->end >= begin;
             ++piece) {
            if (piece->end == begin && piece->from == from && piece->site == c.relay->site) {
                piece->end = end;
                return;
            }
        }
        const double weight = c.relay->weight + (from - c.relay->image).norm();
        pieces_->push_back({from, weight, begin, end, c.relay->site});
    }

    void meet(const Candidate& below, const Candidate& above, double lo, double x, double hi) {
        emit(x, below.relay->site);
        emit(hi, above.relay->site);
        emit_pieces(below, lo, x);
        emit_pieces(above, x, hi);
    }

    // Least distance of one of two sites: over the candidates from `first` on.
    [[nodiscard]] Sample least(Index site, std::size_t first, double x) const {
        Sample best{std::numeric_limits<double>::infinity(), 0, p_};
        for (std::size_t i = first; i < stack_.size(); ++i) {
            if (stack_[i].relay->site != site) continue;
            const Sample s = sample(*stack_[i].relay, x, 1);
            if (s.value < best.value) best = s;
        }
        return best;
    }

    // A point where the distances from two sites are equal; a is nearer at lo, b at hi.
    [[nodiscard]] double crossing(const Candidate& a, const Candidate& b, std::size_t first,
                                  double lo, double hi) const {
        const auto least_value = [&](const Candidate& c, auto value) {
            double result = value(c);
            for (std::size_t i = first; i < stack_.size(); ++i) {
                if (stack_[i].relay->site == c.relay->site) {
                    result = std::min(result, value(stack_[i]));
                }
            }
            return result;
        };
        const auto at_lo = [](const Candidate& c) { return c.value_lo; };
        const auto at_hi = [](const Candidate& c) { return c.value_hi; };
        double gap_lo = a.value_lo - least_value(b, at_lo);
        double gap_hi = least_value(a, at_hi) - b.value_hi;
        double x = lo + (hi - lo) * gap_lo / (gap_lo - gap_hi);
        for (int i = 0; i < max_root_steps && hi - lo > shortest_interval * length_; ++i) {
            if (!(x > lo && x < hi)) x = (lo + hi) / 2;
            const Sample on_a = least(a.relay->site, first, x);
            const Sample on_b = least(b.relay->site, first, x);
            const double gap = on_a.value - on_b.value;
            if (std::abs(gap) <= tolerance(on_a.value)) return x;
            if (gap < 0) {
                lo = x;
                gap_lo = gap;
            } else {
                hi = x;
                gap_hi = gap;
            }
            // Newton, but halving every fourth step so that the bracket always shrinks.
            x = i % 4 == 3 ? (lo + hi) / 2 : x - gap / (on_a.slope - on_b.slope);
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
            if (at_lo == nullptr || c.value_lo < at_lo->value_lo) at_lo = &c;
            if (at_hi == nullptr || c.value_hi < at_hi->value_hi) at_hi = &c;
        }
        const double slack = 2 * shortest_interval * length_ + tolerance(at_hi->value_hi);
        return std::all_of(candidates.begin(), candidates.end(), [&](const Candidate& c) {
            return c.relay->site == site || is_above(c, *at_lo, lo, hi, slack) ||
                   is_above(c, *at_hi, lo, hi, slack);
        });
    }

    // Labels [lo, hi] by one crossing of two sites, unless there are more.
    bool cross_once(const Candidate& below, const Candidate& above, std::size_t first, double lo,
                    double hi) {
        const double x = crossing(below, above, first, lo, hi);
        if (stack_.size() - first > 2) {
            left_.assign(stack_.begin() + static_cast<std::ptrdiff_t>(first), stack_.end());
            right_ = left_;
            for (std::size_t i = 0; i < left_.size(); ++i) {
                const Sample before = sample(*left_[i].relay, x, -1);
                const Sample after = sample(*left_[i].relay, x, 1);
                left_[i].value_hi = before.value;
                left_[i].slope_hi = before.slope;
                left_[i].from_hi = before.from;
                right_[i].value_lo = after.value;
                right_[i].slope_lo = after.slope;
                right_[i].from_lo = after.from;
            }
            if (!is_alone(left_, below.relay->site, lo, x) ||
                !is_alone(right_, above.relay->site, x, hi)) {
                return false;
            }
            emit(x, below.relay->site);
            emit(hi, above.relay->site);
            for (const Candidate& c : left_) {
                if (c.relay->site == below.relay->site) emit_pieces(c, lo, x);
            }
            for (const Candidate& c : right_) {
                if (c.relay->site == above.relay->site) emit_pieces(c, x, hi);
            }
            return true;
        }
        meet(below, above, lo, x, hi);
        return true;
    }

    // Labels [lo, hi] by the candidates from `first` to the top of the stack, which it consumes.
    void split(double lo, double hi, std::size_t first) {
        const Candidate best_lo = best(first, [](const Candidate& c) { return c.value_lo; });
        const Candidate best_hi = best(first, [](const Candidate& c) { return c.value_hi; });
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
            for (std::size_t i = first; i < stack_.size(); ++i) emit_pieces(stack_[i], lo, hi);
        } else if (hi - lo <= shortest_interval * length_ || ++splits_ > max_splits) {
            meet(best_lo, best_hi, lo, (lo + hi) / 2, hi);
        } else if (!has_two_sites || !cross_once(best_lo, best_hi, first, lo, hi)) {
            bisect(lo, hi, first);
        }
        stack_.resize(first);
    }

    void bisect(double lo, double hi, std::size_t first) {
        const double mid = (lo + hi) / 2;
        const std::size_t last = stack_.size();
        for (std::size_t i = first; i < last; ++i) {
            Candidate c = stack_[i];
            const Sample below = sample(*c.relay, mid, -1);
            const Sample above = sample(*c.relay, mid, 1);
            stack_[i].value_lo = above.value;  // This entry goes on as the upper half.
            stack_[i].slope_lo = above.slope;
            stack_[i].from_lo = above.from;
            c.value_hi = below.value;
            c.slope_hi = below.slope;
            c.from_hi = below.from;
            stack_.push_back(c);
        }
        split(lo, mid, last);
        split(mid, hi, first);
    }

    Vec2 p_;
    double length_;
    Vec2 along_;
    std::vector<Candidate>& stack_;
    std::vector<Candidate>& left_;
    std::vector<Candidate>& right_;
    std::vector<LabelInterval>& out_;
    std::vector<EnvelopePiece>* pieces_;
    int splits_ = 0;
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

void label_envelope(std::span<const PlanarRelay> relays, const Vec2& p, const Vec2& q,
                    Index site_at_p, Index site_at_q, EnvelopeScratch& scratch,
                    std::vector<LabelInterval>& out, std::vector<EnvelopePiece>* pieces) {
    out.clear();
    if (pieces != nullptr) pieces->clear();
    Envelope(p, q, scratch, out, pieces).run(relays);
    drop_slivers(out);
    if (out.front().site != site_at_p) out.insert(out.begin(), {0, site_at_p});
    if (out.back().site != site_at_q) out.push_back({1, site_at_q});
}

}  // namespace agvd
