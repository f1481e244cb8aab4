
#include "agvd/mesh/any_mesh.h"

#include <algorithm>
#include <bit>

#include "agvd/core/bucket_sort.h"
#include "agvd/core/random.h"

namespace agvd {

std::vector<EdgeSide> sort_edge_sides(const std::vector<EdgeSide>& sides, Index num_vertices,
                                      Ticker ticker) {
    return sort_in_buckets(
        sides, num_vertices, [](const EdgeSide& side) { return side.low(); },
        [](const EdgeSide& a, const EdgeSide& b) {
            return a.ends != b.ends ? a.ends < b.ends : a.half_edge < b.half_edge;
        },
        ticker);
}

std::vector<EdgeSide> sorted_edge_sides(std::span<const Triangle> triangles, Ticker ticker) {
    std::vector<EdgeSide> sides;
    sides.reserve(3 * triangles.size());
    Index num_vertices = 0;
    for (Index f = 0; f < triangles.size(); ++f) {
        ticker.tick();
        for (Index k = 0; k < 3; ++k) {
            const Index a = triangles[f][k];
            const Index b = triangles[f][(k + 1) % 3];
            num_vertices = std::max(num_vertices, a + 1);
            sides.push_back({edge_key(a, b), 3 * f + k, a < b});
        }
    }
    return sort_edge_sides(sides, num_vertices, ticker);
}

std::vector<Index> first_at_position(std::span<const Vec3> positions, Ticker& ticker,
                                     const std::vector<bool>& is_wanted) {
    const auto num_wanted = is_wanted.empty()
                                ? std::ssize(positions)
                                : std::count(is_wanted.begin(), is_wanted.end(), true);
    std::vector<Index> slots(std::bit_ceil(2 * static_cast<std::size_t>(num_wanted) + 1), no_index);
    const std::size_t mask = slots.size() - 1;
    std::vector<Index> first(positions.size(), no_index);
    for (Index v = 0; v < positions.size(); ++v) {
        ticker.tick(2);
        if (!is_wanted.empty() && !is_wanted[v]) continue;
        std::size_t i = PositionHash{}(positions[v]) & mask;
        while (slots[i] != no_index && positions[slots[i]] != positions[v]) i = (i + 1) & mask;
        if (slots[i] == no_index) slots[i] = v;
        first[v] = slots[i];
    }
    return first;
}

std::vector<Triangle> rename_vertices(std::span<const Triangle> triangles,
                                      std::span<const Index> first) {
    std::vector<Triangle> result(triangles.begin(), triangles.end());
    for (Triangle& t : result) {
        for (Index& v : t) v = first[v];
    }
    return result;
}

std::vector<Index> drop_unused(Index num_vertices, std::vector<Triangle>& triangles) {
    std::vector<Index> number(num_vertices, no_index), used;
    for (const Triangle& t : triangles) {
        for (const Index v : t) number[v] = 0;
    }
    for (Index v = 0; v < num_vertices; ++v) {
        if (number[v] == no_index) continue;
        number[v] = static_cast<Index>(used.size());
        used.push_back(v);
    }
    triangles = rename_vertices(triangles, number);
    return used;
}

}  // namespace agvd
