#include "remesh/quality/segment_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace remesh::detail {
namespace {

using agvd::Index;
using agvd::Vec3;

// In reaches: side of a cell, and how far apart are the points of a segment whose cells hold it.
constexpr double cell_side = 2;
constexpr double point_spacing = 0.5;
// So far from a point is the cell that holds a segment within reach.
constexpr double search = 1 + point_spacing / 2;

// Beyond 2^20 cells from the origin cells share a key, which costs time only.
std::int64_t cell_of(double coordinate, double reach) {
    constexpr double most = 1 << 20;
    return std::llround(std::clamp(std::floor(coordinate / (cell_side * reach)), -most, most));
}

std::uint64_t key_of(const std::array<std::int64_t, 3>& cell) {
    std::uint64_t key = 0;
    for (const std::int64_t c : cell) key = key << 21 | (static_cast<std::uint64_t>(c) & 0x1fffff);
    return key;
}

double distance_to(const SegmentGrid::Segment& segment, const Vec3& point) {
    const Vec3 along = segment.second - segment.first, from = point - segment.first;
    const double square = along.squaredNorm();
    const double t = square > 0 ? std::clamp(from.dot(along) / square, 0., 1.) : 0;
    return (from - t * along).norm();
}

}  // namespace

SegmentGrid::SegmentGrid(std::vector<Segment> segments, double reach, agvd::Ticker& ticker)
    : segments_(std::move(segments)), reach_(reach) {
    for (Index i = 0; i < segments_.size(); ++i) {
        const auto& [a, b] = segments_[i];
        const auto steps =
            static_cast<Index>(std::ceil((b - a).norm() / (point_spacing * reach_))) + 1;
        for (Index k = 0; k <= steps; ++k) {
            ticker.tick();
            const Vec3 p = a + (static_cast<double>(k) / steps) * (b - a);
            const std::uint64_t key =
                key_of({cell_of(p.x(), reach), cell_of(p.y(), reach), cell_of(p.z(), reach)});
            if (k == 0 || entries_.back().first != key) entries_.emplace_back(key, i);
        }
    }
    ticker.poll();
    std::sort(entries_.begin(), entries_.end());
    for (Index i = 0; i < entries_.size(); ++i) {
        ticker.tick();
        const auto [it, is_new] = cells_.try_emplace(entries_[i].first, Cell{i, i});
        it->second.end = i + 1;
    }
}

double SegmentGrid::distance(const Vec3& point) const {
    std::array<std::int64_t, 3> low, high, c;
    for (int k = 0; k < 3; ++k) {
        low[k] = cell_of(point[k] - search * reach_, reach_);
        high[k] = cell_of(point[k] + search * reach_, reach_);
    }
    double best = std::numeric_limits<double>::infinity();
    for (c[0] = low[0]; c[0] <= high[0]; ++c[0]) {
        for (c[1] = low[1]; c[1] <= high[1]; ++c[1]) {
            for (c[2] = low[2]; c[2] <= high[2]; ++c[2]) {
                const auto found = cells_.find(key_of(c));
                if (found == cells_.end()) continue;
                for (Index i = found->second.begin; i < found->second.end; ++i) {
                    best = std::min(best, distance_to(segments_[entries_[i].second], point));
                }
            }
        }
    }
    return best <= reach_ ? best : std::numeric_limits<double>::infinity();
}

}  // namespace remesh::detail
