// Open curves: the recurrence of Eiter and Mannila ([eiter1994]). Closed curves: a coupling is a
// monotone path through the grid of pairs (rows: p and its first point again; columns: q twice)
// from (0, j) to (#p, j + #q) for some start j. Whether one exists below a given length is decided
// for all j at once: two such paths that cross share a pair, so that the starts from which a pair
// can be reached are, but for those that end nowhere, all between the lowest and the highest of
// them (as for the continuous distance in [alt1995]).
#include "paper/frechet.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace agvd {
namespace {

constexpr double precision = 1e-7;  // Of the search for the length; far below any spacing.

double longest_step(std::span<const Vec3> curve) {
    double longest_sq = 0;
    for (std::size_t i = 1; i < curve.size(); ++i) {
        longest_sq = std::max(longest_sq, (curve[i] - curve[i - 1]).squaredNorm());
    }
    return std::sqrt(longest_sq);
}

// Points ahead that cannot be nearer than `margin` less than this one, at least 1.
std::size_t stride(double margin, double step) {
    if (!(margin > step)) return 1;
    constexpr double most = 1e9;
    return static_cast<std::size_t>(std::min(most, margin / step));
}

double directed_hausdorff(std::span<const Vec3> p, std::span<const Vec3> q, Ticker& ticker) {
    const double step = longest_step(q);
    double farthest = 0;
    for (const Vec3& point : p) {
        double nearest = infinity;
        for (std::size_t j = 0; j < q.size() && nearest > farthest;) {
            ticker.tick();
            const double distance = (point - q[j]).norm();
            nearest = std::min(nearest, distance);
            j += stride(distance - nearest, step);
        }
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

// A pair of the current row that paths reach, and the starts that they come from.
struct Reached {
    Index column;
    Index lowest_start, highest_start;

    void join(const Reached& other) {
        lowest_start = std::min(lowest_start, other.lowest_start);
        highest_start = std::max(highest_start, other.highest_start);
    }
};

// The pairs of one grid, row by row.
class PairGrid {
public:
    PairGrid(std::span<const Vec3> p, std::span<const Vec3> q, Ticker ticker)
        : p_(p), q_(q), step_(longest_step(q)), ticker_(ticker) {}

    // What paths over pairs of at most `length` reach in the last row. They start in the columns
    // below num_starts of row 0.
    const std::vector<Reached>& last_row(double length, std::size_t num_starts) {
        row_.clear();
        for (const Index column : near_columns(0, length)) {
            const bool is_start = column < num_starts;
            const bool goes_on = !row_.empty() && row_.back().column + 1 == column;
            if (!is_start && !goes_on) continue;
            Reached pair = goes_on ? row_.back() : Reached{column, column, column};
            if (is_start) pair.join({column, column, column});
            pair.column = column;
            row_.push_back(pair);
        }
        for (std::size_t i = 1; i <= p_.size() && !row_.empty(); ++i) {
            advance(near_columns(i % p_.size(), length));
        }
        return row_;
    }

private:
    // Columns of the points of q, in both its rounds, that are near enough to point i of p.
    const std::vector<Index>& near_columns(std::size_t i, double length) {
        columns_.clear();
        for (std::size_t j = 0; j < q_.size();) {
            ticker_.tick();
            const double distance = (p_[i] - q_[j]).norm();
            if (distance <= length) columns_.push_back(static_cast<Index>(j));
            j += stride(distance - length, step_);
        }
        const std::size_t once = columns_.size();
        for (std::size_t k = 0; k < once; ++k) {
            columns_.push_back(columns_[k] + static_cast<Index>(q_.size()));
        }
        return columns_;
    }

    void advance(const std::vector<Index>& columns) {
        next_.clear();
        auto below = row_.begin();
        for (const Index column : columns) {
            Reached pair{column, no_index, 0};
            while (below != row_.end() && below->column + 1 < column) ++below;
            for (auto from = below; from != row_.end() && from->column <= column; ++from) {
                pair.join(*from);
            }
            if (!next_.empty() && next_.back().column + 1 == column) pair.join(next_.back());
            if (pair.lowest_start != no_index) next_.push_back(pair);
        }
        row_.swap(next_);
    }

    std::span<const Vec3> p_, q_;
    double step_;
    Ticker ticker_;
    std::vector<Reached> row_, next_;
    std::vector<Index> columns_;
};

// Decides whether two closed curves have a coupling of a given length.
class ClosedCouplings {
public:
    ClosedCouplings(std::span<const Vec3> p, std::span<const Vec3> q, Ticker ticker)
        : num_columns_(q.size()),
          p_back_(p.rbegin(), p.rend()),
          q_back_(q.rbegin(), q.rend()),
          forward_(p, q, ticker),
          backward_(p_back_, q_back_, ticker) {
        std::rotate(p_back_.begin(), p_back_.end() - 1, p_back_.end());  // Both begin at p[0].
    }

    bool exists(double length) {
        // Backward from everywhere in the last row: the starts that end somewhere.
        ends_.assign(num_columns_, false);
        for (const Reached& pair : backward_.last_row(length, 2 * num_columns_)) {
            const std::size_t column = 2 * num_columns_ - 1 - pair.column;
            if (column < num_columns_) ends_[column] = true;
        }
        const auto& last = forward_.last_row(length, num_columns_);
        return std::any_of(last.begin(), last.end(), [&](const Reached& pair) {
            if (pair.column < num_columns_) return false;
            const std::size_t start = pair.column - num_columns_;
            return pair.lowest_start <= start && start <= pair.highest_start && ends_[start];
        });
    }

private:
    std::size_t num_columns_;
    std::vector<Vec3> p_back_, q_back_;
    PairGrid forward_, backward_;
    std::vector<bool> ends_;
};

}  // namespace

double frechet_distance(std::span<const Vec3> p, std::span<const Vec3> q) {
    assert(!p.empty() && !q.empty());
    std::vector<double> row(q.size(),
                            infinity);  // Least length of couplings up to (i, j), squared.
    for (std::size_t i = 0; i < p.size(); ++i) {
        double diagonal = i == 0 ? 0 : infinity;
        double left = infinity;
        for (std::size_t j = 0; j < q.size(); ++j) {
            const double above = row[j];
            const double before = std::min({diagonal, above, left});
            left = row[j] = std::max(before, (p[i] - q[j]).squaredNorm());
            diagonal = above;
        }
    }
    return std::sqrt(row.back());
}

double closed_frechet_distance(std::span<const Vec3> p, std::span<const Vec3> q, Ticker ticker) {
    assert(!p.empty() && !q.empty());
    ClosedCouplings couplings(p, q, ticker);
    double low = hausdorff_distance(p, q, ticker);
    if (couplings.exists(low)) return low;
    // Rounding of coordinates alone parts curves whose points lie upon each other.
    double high = std::max(low, closed_length(q) * std::numeric_limits<double>::epsilon());
    do {
        low = high;
        high *= 2;
    } while (!couplings.exists(high));
    while (high - low > precision * high) {
        const double middle = low + (high - low) / 2;
        (couplings.exists(middle) ? high : low) = middle;
    }
    return high;
}

double hausdorff_distance(std::span<const Vec3> p, std::span<const Vec3> q, Ticker ticker) {
    assert(!p.empty() && !q.empty());
    return std::max(directed_hausdorff(p, q, ticker), directed_hausdorff(q, p, ticker));
}

double closed_length(std::span<const Vec3> loop) {
    double length = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        length += (loop[(i + 1) % loop.size()] - loop[i]).norm();
    }
    return length;
}

std::vector<Vec3> resampled(std::span<const Vec3> loop, Index count, double start) {
    assert(!loop.empty());
    const double length = closed_length(loop);
    std::vector<Vec3> points(count, loop[0]);
    if (length == 0) return points;
    std::size_t from = 0;  // The segment, counted on past the end of the loop, and what lies
    double passed = 0;     // before it.
    for (Index i = 0; i < count; ++i) {
        const double target = start + length * i / count;
        while (true) {
            const Vec3& a = loop[from % loop.size()];
            const Vec3& b = loop[(from + 1) % loop.size()];
            const double segment = (b - a).norm();
            if (target <= passed + segment && segment > 0) {
                points[i] = a + (b - a) * ((target - passed) / segment);
                break;
            }
            passed += segment;
            ++from;
        }
    }
    return points;
}

double nearest_on_loop(std::span<const Vec3> loop, const Vec3& query) {
    double best_sq = infinity, best = 0, passed = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3& a = loop[i];
        const Vec3 along = loop[(i + 1) % loop.size()] - a;
        const double length = along.norm();
        const double at =
            length > 0 ? std::clamp((query - a).dot(along) / (length * length), 0.0, 1.0) : 0;
        const double distance_sq = (a + at * along - query).squaredNorm();
        if (distance_sq < best_sq) {
            best_sq = distance_sq;
            best = passed + at * length;
        }
        passed += length;
    }
    return best;
}

}  // namespace agvd
