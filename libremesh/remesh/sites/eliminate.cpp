// Weighted sample elimination ([yuksel2015]): a heap holds the points by the weights of their
// neighbours, and the most crowded point is removed. Neighbours come from a uniform grid. The
// paper's r_max, r_min, alpha, beta and gamma have their names here.
#include "remesh/sites/eliminate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "agvd/core/parallel.h"

namespace remesh::detail {
namespace {

// Points on faces whose normals differ by more than 120 degrees do not crowd each other: the walls
// of a thin plate stay independent, while points on both sides of a right-angled edge keep apart.
constexpr double least_crowd_cosine = -0.5;

// alpha = 8, beta = 0.65, gamma = 1.5.
struct Weight {
    double reach;  // 2 r_max: the spacing of points in the densest packing.
    double floor;  // 2 r_min: nearer points weigh no more, so that clumps do not dominate.

    Weight(double spacing, double keep, double total)
        : reach(spacing), floor(reach * (1 - std::pow(keep / total, 1.5)) * 0.65) {}

    [[nodiscard]] double operator()(double distance) const {
        const double x = 1 - std::min(1.0, std::max(distance, floor) / reach);
        const double x2 = x * x, x4 = x2 * x2;
        return x4 * x4;
    }
};

// The points in the order of a uniform grid's cells, so that neighbours are near in memory.
struct Grid {
    std::vector<Index> order;            // Place in this order -> point.
    std::vector<std::uint64_t> cell;     // Per place, ascending; x runs fastest.
    std::vector<Vec3> position, normal;  // Per place.
    std::vector<double> unit;            // Per place; empty: 1.

    // In the mean of both units.
    [[nodiscard]] double distance(Index a, Index b) const {
        const double apart = (position[a] - position[b]).norm();
        return unit.empty() ? apart : 2 * apart / (unit[a] + unit[b]);
    }
};

constexpr int bits_per_axis = 21;
constexpr std::uint64_t row = std::uint64_t{1} << bits_per_axis;

Grid build_grid(const Surface& surface, std::span<const ScatteredPoint> points,
                std::span<const double> unit, double cell_size, Ticker ticker) {
    Vec3 low = points[0].position, high = low;
    for (const ScatteredPoint& p : points) {
        low = low.cwiseMin(p.position);
        high = high.cwiseMax(p.position);
    }
    // Cells are at least as wide as the reach, and wider if an axis would run out of bits.
    cell_size = std::max(cell_size, (high - low).maxCoeff() / static_cast<double>(row) / 2);
    std::vector<std::pair<std::uint64_t, Index>> keys(points.size());
    for (Index i = 0; i < keys.size(); ++i) {
        const Vec3 at = (points[i].position - low) / cell_size;
        const auto along = [&](int axis) { return static_cast<std::uint64_t>(at[axis]) + 1; };
        keys[i] = {(along(2) * row + along(1)) * row + along(0), i};
    }
    sort_ticked(keys, ticker, std::less<>());

    Grid grid;
    for (const auto& [cell, i] : keys) {
        ticker.tick();
        if (!unit.empty()) grid.unit.push_back(unit[i]);
        const Triangle& t = surface.mesh.triangles[points[i].point.face.value()];
        const auto& p = surface.mesh.positions;
        grid.order.push_back(i);
        grid.cell.push_back(cell);
        grid.position.push_back(points[i].position);
        grid.normal.push_back((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).normalized());
    }
    return grid;
}

// Offsets and data: the neighbours of place i are data[begin[i]] ... data[begin[i + 1] - 1].
struct Neighbours {
    std::vector<std::size_t> begin;
    std::vector<Index> data;
};

// The places in the 3 x 3 x 3 cells around a cell: nine ranges, as x runs fastest.
std::array<std::pair<Index, Index>, 9> runs_around(const Grid& grid, std::uint64_t cell) {
    std::array<std::pair<Index, Index>, 9> runs;
    auto run = runs.begin();
    for (const std::uint64_t z : {std::uint64_t{0}, row * row, 2 * row * row}) {
        for (const std::uint64_t y : {std::uint64_t{0}, row, 2 * row}) {
            const std::uint64_t first = cell - row * row - row - 1 + y + z;
            const auto begin = std::lower_bound(grid.cell.begin(), grid.cell.end(), first);
            auto end = begin;
            while (end != grid.cell.end() && *end <= first + 2) ++end;
            *run++ = {static_cast<Index>(begin - grid.cell.begin()),
                      static_cast<Index>(end - grid.cell.begin())};
        }
    }
    return runs;
}

Neighbours find_neighbours(const Grid& grid, double reach, int num_threads, Poller& poller) {
    constexpr Index grain = 4096;
    const auto count = static_cast<Index>(grid.order.size());
    Neighbours result{std::vector<std::size_t>(count + 1, 0), {}};
    std::vector<std::vector<Index>> found(num_chunks(count, grain));
    const auto find = [&](Index chunk, Index begin, Index end) {
        std::array<std::pair<Index, Index>, 9> runs;
        Ticker ticker(poller);
        for (Index place = begin; place < end; ++place) {
            if (place == begin || grid.cell[place] != grid.cell[place - 1]) {
                runs = runs_around(grid, grid.cell[place]);
            }
            const std::size_t before = found[chunk].size();
            for (const auto& [first, last] : runs) {
                ticker.tick(1 + (last - first) / 8);
                for (Index other = first; other < last; ++other) {
                    const Vec3 apart = grid.position[place] - grid.position[other];
                    const double most = grid.unit.empty()
                                            ? reach
                                            : reach * (grid.unit[place] + grid.unit[other]) / 2;
                    if (other != place && apart.squaredNorm() < most * most &&
                        grid.normal[place].dot(grid.normal[other]) > least_crowd_cosine) {
                        found[chunk].push_back(other);
                    }
                }
            }
            result.begin[place + 1] = found[chunk].size() - before;
        }
    };
    parallel_chunks(count, grain, num_threads, find, poller);
    std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
    result.data.reserve(result.begin.back());
    for (const std::vector<Index>& part : found) {
        result.data.insert(result.data.end(), part.begin(), part.end());
        poller.poll();
    }
    return result;
}

// A binary heap of places, the most crowded on top. Any place can sink.
class CrowdedFirst {
public:
    // The heap does not hold the points from `first_fixed` on.
    CrowdedFirst(std::vector<double> crowding, const std::vector<Index>& order, Index first_fixed)
        : crowding_(std::move(crowding)), order_(order), slot_(order.size(), no_index) {
        for (Index place = 0; place < order.size(); ++place) {
            if (order[place] >= first_fixed) continue;
            slot_[place] = static_cast<Index>(heap_.size());
            heap_.push_back(place);
        }
        for (auto i = static_cast<Index>(heap_.size() / 2); i-- > 0;) sink(i);
    }
    [[nodiscard]] bool contains(Index place) const { return slot_[place] != no_index; }
    [[nodiscard]] std::size_t size() const { return heap_.size(); }

    Index pop() {
        const Index top = heap_.front();
        slot_[top] = no_index;
        const Index last = heap_.back();
        heap_.pop_back();
        if (!heap_.empty()) {
            heap_[0] = last;
            slot_[last] = 0;
            sink(0);
        }
        return top;
    }
    void relieve(Index place, double weight) {
        crowding_[place] -= weight;
        sink(slot_[place]);
    }

private:
    [[nodiscard]] bool goes_before(Index a, Index b) const {
        return crowding_[a] != crowding_[b] ? crowding_[a] > crowding_[b] : order_[a] > order_[b];
    }
    void sink(Index i) {
        const Index place = heap_[i];
        for (Index child = 2 * i + 1; child < heap_.size(); child = 2 * i + 1) {
            if (child + 1 < heap_.size() && goes_before(heap_[child + 1], heap_[child])) ++child;
            if (!goes_before(heap_[child], place)) break;
            heap_[i] = heap_[child];
            slot_[heap_[i]] = i;
            i = child;
        }
        heap_[i] = place;
        slot_[place] = i;
    }

    std::vector<double> crowding_;  // Per place: sum of the weights of its neighbours.
    const std::vector<Index>& order_;
    std::vector<Index> heap_, slot_;  // Places by rank; rank of each place, no_index if removed.
};

}  // namespace

std::vector<SurfacePoint> eliminate(const Surface& surface, std::span<const ScatteredPoint> points,
                                    Index num_fixed, Index keep, double spacing, int num_threads,
                                    const Progress& progress, std::span<const double> unit) {
    Poller poller(progress);
    Ticker ticker(poller);
    const auto first_fixed = static_cast<Index>(points.size()) - num_fixed;
    const Weight weight(spacing, keep, static_cast<double>(first_fixed));
    const double longest = unit.empty() ? 1 : *std::max_element(unit.begin(), unit.end());
    const Grid grid = build_grid(surface, points, unit, longest * weight.reach, ticker);
    const Neighbours neighbours = find_neighbours(grid, weight.reach, num_threads, poller);
    const auto for_each_neighbour = [&](Index place, const auto& body) {
        ticker.tick(1 + neighbours.begin[place + 1] - neighbours.begin[place]);
        for (std::size_t i = neighbours.begin[place]; i < neighbours.begin[place + 1]; ++i) {
            const Index other = neighbours.data[i];
            body(other, weight(grid.distance(place, other)));
        }
    };

    std::vector<double> crowding(points.size(), 0);
    for (Index place = 0; place < crowding.size(); ++place) {
        for_each_neighbour(place, [&](Index, double w) { crowding[place] += w; });
    }
    CrowdedFirst queue(std::move(crowding), grid.order, first_fixed);
    while (queue.size() > keep) {
        for_each_neighbour(queue.pop(), [&](Index other, double w) {
            if (queue.contains(other)) queue.relieve(other, w);
        });
    }

    std::vector<Index> kept;
    for (Index place = 0; place < points.size(); ++place) {
        if (queue.contains(place)) kept.push_back(grid.order[place]);
    }
    sort_ticked(kept, ticker, std::less<>());
    std::vector<SurfacePoint> result;
    result.reserve(kept.size());
    for (const Index i : kept) result.push_back(points[i].point);
    return result;
}

}  // namespace remesh::detail
