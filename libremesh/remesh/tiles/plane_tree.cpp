#include "remesh/tiles/plane_tree.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace remesh {
namespace {

// A rotation by rational numbers. No direction is within 7 degrees of the plane of two axes.
const std::array<Vec3, 3> directions{Vec3(4, -20, 22) / 30, Vec3(28, 10, 4) / 30,
                                     Vec3(-10, 20, 20) / 30};

class PlaneTreeBuilder {
public:
    PlaneTreeBuilder(std::span<const Vec3> points, std::span<const double> weights, Ticker& ticker)
        : points_(points), weights_(weights), ticker_(ticker) {}

    PlaneTree run(Index num_cells) {
        std::vector<Index> all(points_.size());
        std::iota(all.begin(), all.end(), Index{0});
        tree_.num_cells = 0;
        (void)divide(all, num_cells);
        return std::move(tree_);
    }

private:
    // \param points  reordered.
    PlaneTree::Side divide(std::span<Index> points, Index num_cells) {
        const Index num_below = num_cells / 2;
        const std::size_t count =
            num_cells > 1 ? sort_to_share(points, static_cast<double>(num_below) / num_cells) : 0;
        if (count == 0) return {tree_.num_cells++, true};
        const Vec3& normal = directions[direction_];
        const double below = normal.dot(points_[points[count - 1]]),
                     above = normal.dot(points_[points[count]]);
        const auto node = static_cast<Index>(tree_.nodes.size());
        tree_.nodes.push_back({normal, (below + above) / 2, {}, {}});
        const PlaneTree::Side low = divide(points.first(count), num_below);
        const PlaneTree::Side high = divide(points.subspan(count), num_cells - num_below);
        tree_.nodes[node].below = low;
        tree_.nodes[node].above = high;
        return {node, false};
    }

    // Sorts the points in the direction in which they spread most, and sets that direction.
    // \return the number of those that have about this share of the weight; 0: they are at one place.
    std::size_t sort_to_share(std::span<Index> points, double share) {
        double total = 0;
        for_each_ticked(points, ticker_, [&](Index p) { total += weights_[p]; });
        std::array<double, 3> spread{};
        for (Index d = 0; d < 3; ++d) {
            double sum = 0, squares = 0, weight = 0;
            for_each_ticked(points, ticker_, [&](Index p) {
                const double at = directions[d].dot(points_[p] - points_[points[0]]);
                weight += weights_[p];
                sum += weights_[p] * at;
                squares += weights_[p] * at * at;
            });
            spread[d] = squares - sum * sum / weight;
        }
        direction_ = static_cast<std::size_t>(std::max_element(spread.begin(), spread.end()) -
                                              spread.begin());
        const Vec3& normal = directions[direction_];
        sort_ticked(points, ticker_, [&](Index a, Index b) {
            const double at_a = normal.dot(points_[a]), at_b = normal.dot(points_[b]);
            return at_a != at_b ? at_a < at_b : a < b;
        });
        double sum = 0;
        std::size_t count = 0;
        while (count < points.size() && sum < share * total) sum += weights_[points[count++]];
        const auto at = [&](std::size_t i) { return normal.dot(points_[points[i]]); };
        while (count > 0 && (count == points.size() || at(count) == at(count - 1))) --count;
        return count;
    }

    const std::span<const Vec3> points_;
    const std::span<const double> weights_;
    Ticker& ticker_;
    std::size_t direction_ = 0;
    PlaneTree tree_;
};

}  // namespace

PlaneTree divide_by_planes(std::span<const Vec3> points, std::span<const double> weights,
                           Index num_cells, Ticker ticker) {
    return PlaneTreeBuilder(points, weights, ticker).run(num_cells);
}

}  // namespace remesh
