// Equal positions are found by a hash table. The first of each set then goes into the cells of a
// grid, and is compared with those that went there before and lie within its reach.
#include "remesh/clean/soup.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "agvd/core/random.h"
#include "agvd/core/union_find.h"
#include "agvd/mesh/scale.h"
#include "remesh/clean/point_grid.h"

namespace remesh::detail {
namespace {

constexpr double share_of_size = 1e-6;
constexpr double share_of_edge = 1e-2;
// With a tolerance: below half, so that the ends of an edge are never at one position with a third
// vertex.
constexpr double share_with_tolerance = 0.49;
// Vertices with a smaller share of the median's reach have to be equal: a cell could hold any
// number of them.
constexpr double least_reach = 1.0 / 8;
// Of a grid's cell, in reaches: with 8 a vertex looks at two cells in the mean.
constexpr double cell_size = 8;

// For each wanted vertex, the first such vertex with the same position.
std::vector<Index> first_at_position(std::span<const Vec3> positions,
                                     const std::vector<bool>& is_wanted, Ticker& ticker) {
    const auto wanted =
        static_cast<std::size_t>(std::count(is_wanted.begin(), is_wanted.end(), true));
    std::vector<Index> table(std::bit_ceil(2 * wanted + 1), no_index);  // Open addressing.
    std::vector<Index> first(positions.size(), no_index);
    for (Index v = 0; v < positions.size(); ++v) {
        ticker.tick();
        if (!is_wanted[v]) continue;
        std::size_t slot = PositionHash{}(positions[v]) & (table.size() - 1);
        while (table[slot] != no_index && positions[table[slot]] != positions[v]) {
            slot = (slot + 1) & (table.size() - 1);
        }
        if (table[slot] == no_index) table[slot] = v;
        first[v] = table[slot];
    }
    return first;
}

// By first vertex: a share of the shortest edge at its position, zero-length ones apart.
std::vector<double> find_reaches(const MeshView& mesh, std::span<const Index> first, double share,
                                 Ticker& ticker) {
    std::vector<double> reach(first.size(), infinity);
    for (const Triangle& t : mesh.triangles) {
        ticker.tick();
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = first[t[k]], b = first[t[(k + 1) % 3]];
            if (a == no_index && b == no_index) continue;
            const double length = (mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]).norm();
            if (length == 0) continue;
            for (const Index end : {a, b}) {
                if (end != no_index) reach[end] = std::min(reach[end], share * length);
            }
        }
    }
    return reach;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

std::vector<Index> find_common_positions(const MeshView& mesh, const std::vector<bool>& is_wanted,
                                         Ticker& ticker, double tolerance) {
    std::vector<Index> first = first_at_position(mesh.positions, is_wanted, ticker);
    const std::vector<double> reach =
        find_reaches(mesh, first, tolerance > 0 ? share_with_tolerance : share_of_edge, ticker);
    std::vector<double> finite;
    for (const double r : reach) {
        if (r < infinity) finite.push_back(r);
    }
    if (finite.empty()) return first;
    const MeshBox box = box_of(mesh);
    const double limit = std::max(tolerance, share_of_size * box.longest_side());
    const double most = std::min(median(std::move(finite)), limit);
    if (!(most > 0)) return first;

    UnionFind sets(first.size());
    PointGrid grid(box.low, cell_size * most, first.size());
    for (Index v = 0; v < first.size(); ++v) {
        ticker.tick();
        if (first[v] != v || reach[v] < least_reach * most) continue;
        const Vec3& p = mesh.positions[v];
        grid.visit_near(p, most, [&](Index other) {
            const double radius = std::min({reach[v], reach[other], most});
            if ((mesh.positions[other] - p).norm() <= radius) (void)sets.unite(v, other);
        });
        grid.add(p, v);
    }
    for (Index& v : first) {
        if (v != no_index) v = sets.root(v);
    }
    return first;
}

}  // namespace remesh::detail
