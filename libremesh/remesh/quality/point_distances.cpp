#include "remesh/quality/point_distances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "agvd/mesh/closest_point.h"

namespace remesh::detail {
namespace {

// In reaches: side of a cell, and distance between the points of a segment at which cells are
// searched.
constexpr double cell_side = 2;
constexpr double spot_distance = 0.5;
// In reaches: largest distance between a point and the nearest such point of a segment within
// reach. A point is entered in all cells within this distance.
constexpr double margin = 1 + spot_distance / 2;

constexpr double nowhere = std::numeric_limits<double>::infinity();
constexpr std::uint64_t no_key = ~std::uint64_t{0};

// Beyond 2^20 cells from the origin cells share a key, which only costs time.
std::int64_t cell_of(double coordinate, double reach) {
    constexpr double most = 1 << 20;
    return std::llround(std::clamp(std::floor(coordinate / (cell_side * reach)), -most, most));
}

std::uint64_t key_of(const std::array<std::int64_t, 3>& cell) {
    std::uint64_t key = 0;
    for (const std::int64_t c : cell) key = key << 21 | (static_cast<std::uint64_t>(c) & 0x1fffff);
    return key;
}

// The part of a segment inside a box, as parameters; from > to if there is none.
std::pair<double, double> clip(const Vec3& a, const Vec3& b, const Vec3& low, const Vec3& high) {
    double from = 0, to = 1;
    for (int k = 0; k < 3; ++k) {
        const double step = b[k] - a[k];
        if (step != 0) {
            const double x = (low[k] - a[k]) / step, y = (high[k] - a[k]) / step;
            from = std::max(from, std::min(x, y));
            to = std::min(to, std::max(x, y));
        } else if (a[k] < low[k] || a[k] > high[k]) {
            to = -1;
        }
    }
    return {from, to};
}

}  // namespace

PointDistances::PointDistances(std::vector<Vec3> points, double reach, Ticker& ticker)
    : points_(std::move(points)),
      distances_(points_.size(), nowhere),
      reach_(reach),
      low_(Vec3::Constant(nowhere)),
      high_(Vec3::Constant(-nowhere)) {
    for (Index i = 0; i < points_.size(); ++i) {
        ticker.tick(16);
        const Vec3& p = points_[i];
        low_ = low_.cwiseMin(p - Vec3::Constant(reach));
        high_ = high_.cwiseMax(p + Vec3::Constant(reach));
        std::array<std::int64_t, 3> low, high, c;
        for (int k = 0; k < 3; ++k) {
            low[k] = cell_of(p[k] - margin * reach, reach);
            high[k] = cell_of(p[k] + margin * reach, reach);
        }
        for (c[0] = low[0]; c[0] <= high[0]; ++c[0]) {
            for (c[1] = low[1]; c[1] <= high[1]; ++c[1]) {
                for (c[2] = low[2]; c[2] <= high[2]; ++c[2]) entries_.emplace_back(key_of(c), i);
            }
        }
    }
    sort_ticked(entries_, ticker, std::less<>());
    for (Index i = 0; i < entries_.size(); ++i) {
        ticker.tick();
        const auto [it, is_new] = cells_.try_emplace(entries_[i].first, Cell{i, i});
        it->second.end = i + 1;
    }
}

void PointDistances::pass(const Vec3& a, const Vec3& b, Ticker& ticker) {
    const auto [from, to] = clip(a, b, low_, high_);
    if (!(from <= to)) return;
    const double length = (to - from) * (b - a).norm();
    const auto steps = static_cast<Index>(std::ceil(length / (spot_distance * reach_)));
    std::uint64_t last_key = no_key;
    for (Index k = 0; k <= steps; ++k) {
        ticker.tick();
        const double t = steps == 0 ? from : from + (to - from) * k / steps;
        look_around(a + t * (b - a), a, b, last_key);
    }
}

// Searches the cell of one point of the segment, unless it was the last one.
void PointDistances::look_around(const Vec3& at, const Vec3& a, const Vec3& b,
                                 std::uint64_t& last_key) {
    const std::uint64_t key =
        key_of({cell_of(at.x(), reach_), cell_of(at.y(), reach_), cell_of(at.z(), reach_)});
    if (key == last_key) return;
    last_key = key;
    const auto found = cells_.find(key);
    if (found == cells_.end()) return;
    for (Index i = found->second.begin; i < found->second.end; ++i) {
        const Index point = entries_[i].second;
        const double distance = distance_to_segment(points_[point], a, b);
        if (distance <= reach_) distances_[point] = std::min(distances_[point], distance);
    }
}

}  // namespace remesh::detail
