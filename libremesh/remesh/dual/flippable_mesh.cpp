#include "remesh/dual/flippable_mesh.h"

#include <algorithm>
#include <cassert>

#include "agvd/core/types.h"
#include "agvd/mesh/any_mesh.h"

namespace remesh {

FlippableMesh::FlippableMesh(std::span<const Triangle> triangles, Ticker ticker)
    : triangles_(triangles.begin(), triangles.end()), edge_(3 * triangles.size()) {
    Index num_vertices = 0;
    for (const Triangle& t : triangles_) {
        num_vertices = std::max({num_vertices, t[0] + 1, t[1] + 1, t[2] + 1});
    }
    valence_.assign(num_vertices, 0);
    is_boundary_.assign(num_vertices, false);
    const std::vector<EdgeSide> sides = sorted_edge_sides(triangles_, ticker);
    ends_.reserve(sides.size() / 2);
    sides_.reserve(sides.size() / 2);
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        ticker.tick();
        const bool is_inner = edge.size() == 2 && edge[0].forward != edge[1].forward;
        for (const EdgeSide& side : edge) edge_[side.half_edge] = num_edges();
        const bool is_swapped = is_inner && !edge[0].forward;
        sides_.push_back({edge[is_swapped ? 1 : 0].half_edge,
                          is_inner ? edge[is_swapped ? 0 : 1].half_edge : no_index});
        ends_.insert(edge[0].ends);
        for (const Index v : {edge[0].low(), edge[0].high()}) {
            ++valence_[v];
            if (!is_inner) is_boundary_[v] = true;
        }
    });
}

bool FlippableMesh::can_flip(Index edge) const {
    if (!is_inner(edge)) return false;
    const auto& [h, g] = sides_[edge];
    for (const Index v : {tail(h), tail(g)}) {
        if (valence_[v] <= (is_boundary_[v] ? 2U : 3U)) return false;
    }
    const Index c = tail(previous(h)), d = tail(previous(g));
    return c != d && !ends_.contains(edge_key(c, d));
}

void FlippableMesh::flip(Index edge) {
    assert(can_flip(edge));
    const auto [h, g] = sides_[edge];
    const Index a = tail(h), b = tail(g), c = tail(previous(h)), d = tail(previous(g));
    const Index first = h / 3, second = g / 3;
    const std::array<Index, 4> old = {previous(h), next(g), previous(g), next(h)};
    const std::array<Index, 4> now = {3 * first, 3 * first + 1, 3 * second, 3 * second + 1};
    std::array<Index, 4> rim{};  // c to a, a to d, d to b, b to c.
    for (std::size_t i = 0; i < 4; ++i) rim[i] = edge_[old[i]];
    std::array<std::size_t, 4> slot{};  // Found before any side is overwritten.
    for (std::size_t i = 0; i < 4; ++i) slot[i] = sides_[rim[i]][0] == old[i] ? 0 : 1;
    triangles_[first] = {c, a, d};
    triangles_[second] = {d, b, c};
    for (std::size_t i = 0; i < 4; ++i) {
        edge_[now[i]] = rim[i];
        // An edge that never flips may have more sides than are kept.
        if (slot[i] == 0 || is_inner(rim[i])) sides_[rim[i]][slot[i]] = now[i];
    }
    edge_[3 * first + 2] = edge_[3 * second + 2] = edge;
    sides_[edge] = {3 * second + 2, 3 * first + 2};
    ends_.erase(edge_key(a, b));
    ends_.insert(edge_key(c, d));
    --valence_[a];
    --valence_[b];
    ++valence_[c];
    ++valence_[d];
}

}  // namespace remesh
