// Random points, and weighted sample elimination ([yuksel2015]) with the paper's names r_max,
// r_min, alpha, beta, gamma. Neighbours come from a uniform grid.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <unordered_set>

#include "agvd/core/parallel.h"
#include "agvd/core/random.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/curves/walk.h"
#include "remesh/sites/sampling.h"
#include "remesh/sites/size_field.h"

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
        : reach(spacing), floor(reach * (1 - keep / total * std::sqrt(keep / total)) * 0.65) {}

    [[nodiscard]] double operator()(double distance) const {
        const double x = 1 - std::min(1.0, std::max(distance, floor) / reach);
        const double x2 = x * x, x4 = x2 * x2;
        return x4 * x4;
    }
};

// The points in the order of a uniform grid's cells, so that neighbours are near in memory.
struct Grid {
    using Runs = std::array<std::pair<Index, Index>, 9>;

    std::vector<Index> order;            // Slot in this order -> point.
    std::vector<Vec3> position, normal;  // Per slot.
    std::vector<double> unit;            // Per slot; empty: 1.
    std::vector<Index> cell;             // Per slot, ascending.
    std::vector<Runs> around;            // Per cell: the slots in the 3 x 3 x 3 cells around.

    // In the mean of both units.
    [[nodiscard]] double distance(Index a, Index b) const {
        const double apart = (position[a] - position[b]).norm();
        return unit.empty() ? apart : 2 * apart / (unit[a] + unit[b]);
    }

    // Calls each(slot) for the neighbours of a slot.
    template <typename Each>
    void for_each_neighbour(Index slot, double reach, Ticker& ticker, const Each& each) const {
        for (const auto& [first, last] : around[cell[slot]]) {
            ticker.tick(1 + (last - first) / 8);
            for (Index other = first; other < last; ++other) {
                const Vec3 apart = position[slot] - position[other];
                const double most = unit.empty() ? reach : reach * (unit[slot] + unit[other]) / 2;
                if (other != slot && apart.squaredNorm() < most * most &&
                    normal[slot].dot(normal[other]) > least_crowd_cosine) {
                    each(other);
                }
            }
        }
    }
};

constexpr int bits_per_axis = 21;
constexpr std::uint64_t row = std::uint64_t{1} << bits_per_axis;

// The slots in the cells around a cell: nine ranges, as x runs fastest.
// \param keys  cell and point, ascending.
Grid::Runs runs_around(const std::vector<std::pair<std::uint64_t, Index>>& keys,
                       std::uint64_t cell) {
    Grid::Runs runs;
    auto run = runs.begin();
    for (const std::uint64_t z : {std::uint64_t{0}, row * row, 2 * row * row}) {
        for (const std::uint64_t y : {std::uint64_t{0}, row, 2 * row}) {
            const std::uint64_t first = cell - row * row - row - 1 + y + z;
            const auto begin =
                std::lower_bound(keys.begin(), keys.end(), std::pair(first, Index{0}));
            auto end = begin;
            while (end != keys.end() && end->first <= first + 2) ++end;
            *run++ = {static_cast<Index>(begin - keys.begin()),
                      static_cast<Index>(end - keys.begin())};
        }
    }
    return runs;
}

Grid build_grid(const Surface& surface, std::span<const SurfacePoint> points,
                std::span<const double> unit, double cell_size, Ticker ticker) {
    std::vector<Vec3> positions;
    positions.reserve(points.size());
    MeshBox box;
    for (const SurfacePoint& p : points) {
        positions.push_back(position(surface.mesh.view(), p));
        box.add(positions.back());
    }
    // Cells are at least as wide as the reach, and wider if an axis would run out of bits.
    cell_size = std::max(cell_size, (box.high - box.low).maxCoeff() / static_cast<double>(row) / 2);
    std::vector<std::pair<std::uint64_t, Index>> keys(points.size());
    for (Index i = 0; i < keys.size(); ++i) {
        const Vec3 at = (positions[i] - box.low) / cell_size;
        const auto along = [&](int axis) { return static_cast<std::uint64_t>(at[axis]) + 1; };
        keys[i] = {(along(2) * row + along(1)) * row + along(0), i};
    }
    sort_ticked(keys, ticker, std::less<>());

    Grid grid;
    for (Index slot = 0; slot < keys.size(); ++slot) {
        const auto [cell, i] = keys[slot];
        ticker.tick();
        if (!unit.empty()) grid.unit.push_back(unit[i]);
        grid.order.push_back(i);
        grid.position.push_back(positions[i]);
        grid.normal.push_back(facing_at(surface, points[i]));
        if (slot == 0 || cell != keys[slot - 1].first) {
            grid.around.push_back(runs_around(keys, cell));
        }
        grid.cell.push_back(static_cast<Index>(grid.around.size() - 1));
    }
    return grid;
}

// \param sums  by face of the component: weight up to and with it.
SurfacePoint draw(const Component& component, const std::vector<double>& sums, double pick,
                  double u, double v) {
    const std::array<double, 3> uniform = uniform_barycentric(u, v);
    const auto inner = [](double b) { return interior_margin + (1 - 3 * interior_margin) * b; };
    const double b1 = inner(uniform[1]), b2 = inner(uniform[2]);
    return {FaceId(component.faces[pick_by_sums(sums, pick)]), {1 - b1 - b2, b1, b2}};
}

// Weights with the highest density in each face; fewer points are accepted where it is lower.
std::vector<double> highest_weights(const Surface& surface, const Component& component,
                                    const SizeField& sizes) {
    std::vector<double> sums;
    double sum = 0;
    for (const Index f : component.faces) {
        const double least = sizes.least_in_face()[f];
        sum += face_area(surface, f) / (least * least);
        sums.push_back(sum);
    }
    return sums;
}

}  // namespace

std::vector<SurfacePoint> scatter(const Surface& surface, const Component& component, Index count,
                                  std::uint64_t stream, const SamplingOptions& options) {
    const SizeField* const sizes = options.sizes;
    Poller poller(options.progress);
    Ticker ticker(poller);
    std::vector<SurfacePoint> points;
    points.reserve(count);
    std::unordered_set<Vec3, PositionHash> taken;
    taken.reserve(count);
    // Usually one each.
    const std::uint64_t most_draws = (sizes != nullptr ? 1000 : 4) * std::uint64_t{count} + 64;
    const std::vector<double> weights =
        sizes != nullptr ? highest_weights(surface, component, *sizes) : component.area_up_to;
    for (std::uint64_t i = 0; points.size() < count && i < most_draws; ++i) {
        ticker.tick(4);
        const auto unit = [&](std::uint64_t k) {
            return random_unit(options.seed, stream, 3 * i + k);
        };
        const SurfacePoint point = draw(component, weights, unit(0), unit(1), unit(2));
        if (sizes != nullptr) {
            const double share = sizes->least_in_face()[point.face.value()] / sizes->at(point);
            if (random_unit(options.seed, ~stream, i) > share * share) continue;
        }
        const Vec3 where = position(surface.mesh.view(), point);
        if (taken.insert(where).second) points.push_back(point);
    }
    return points;
}

std::vector<SurfacePoint> eliminate(const Surface& surface, std::span<const SurfacePoint> points,
                                    Index num_fixed, Index keep, double spacing, int num_threads,
                                    const Progress& progress, std::span<const double> unit) {
    Poller poller(progress);
    Ticker ticker(poller);
    const auto first_fixed = static_cast<Index>(points.size()) - num_fixed;
    const Weight weight(spacing, keep, static_cast<double>(first_fixed));
    const double longest = unit.empty() ? 1 : *std::max_element(unit.begin(), unit.end());
    const Grid grid = build_grid(surface, points, unit, longest * weight.reach, ticker);
    constexpr Index grain = 4096;
    const auto num_points = static_cast<Index>(points.size());
    std::vector<double> crowding(num_points, 0);
    const auto measure = [&](Index, Index begin, Index end) {
        Ticker own_ticker(poller);
        for (Index slot = begin; slot < end; ++slot) {
            grid.for_each_neighbour(slot, weight.reach, own_ticker, [&](Index other) {
                crowding[slot] += weight(grid.distance(slot, other));
            });
        }
    };
    parallel_chunks(num_points, grain, num_threads, measure, poller);
    std::vector<Index> candidates(first_fixed);
    std::iota(candidates.begin(), candidates.end(), Index{0});
    const std::vector<Index> slot_of = places_in(grid.order);
    FallingQueue queue([&](Index point) { return crowding[slot_of[point]]; }, candidates);
    std::vector<std::uint8_t> is_left(points.size(), 1);
    for (Index left = first_fixed; left > keep; --left) {
        const Index point = queue.pop();
        is_left[point] = 0;
        const Index slot = slot_of[point];
        grid.for_each_neighbour(slot, weight.reach, ticker, [&](Index other) {
            crowding[other] -= weight(grid.distance(slot, other));
        });
    }

    std::erase_if(candidates, [&](Index i) { return is_left[i] == 0; });
    return take(points, candidates);
}

}  // namespace remesh::detail
