// Merges vertices at one place: along cracks, and at the ends of zero-length edges.
#include <algorithm>

#include "agvd/core/edge_key.h"
#include "agvd/core/union_find.h"
#include "remesh/clean/places.h"
#include "remesh/clean/soup.h"

namespace remesh::detail {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Vec3;

// Replaces the vertices of each set by one, and counts those that go.
// \param num_merged  how many unions there were.
bool apply(agvd::UnionFind& sets, Index num_merged, Soup& soup) {
    if (num_merged == 0) return false;
    for (agvd::Triangle& t : soup.triangles) {
        soup.ticker.tick();
        for (Index& v : t) v = sets.root(v);
    }
    soup.counts.welded_vertices += num_merged;
    return true;
}

// Vertices of a set that have other positions than its root get that of the root.
void keep_welded_positions(agvd::UnionFind& sets, Soup& soup) {
    for (Index v = 0; v < soup.positions.size(); ++v) {
        const Index root = sets.root(v);
        if (soup.positions[root] == soup.positions[v]) continue;
        if (soup.welded_positions.empty()) soup.welded_positions = soup.positions;
        soup.welded_positions[v] = soup.positions[root];
    }
}

}  // namespace

// Only edges are welded, and only boundary edges: parts that touch at a point, and closed parts
// that touch anywhere, are manifold as they are.
bool weld_cracks(Soup& soup, std::span<const EdgeSide> sides) {
    std::vector<EdgeSide> open;
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        soup.ticker.tick();
        if (edge.size() == 1) open.push_back(edge[0]);
    });
    if (open.empty()) return false;

    std::vector<bool> is_boundary(soup.positions.size(), false);
    for (const EdgeSide& side : open) is_boundary[side.low()] = is_boundary[side.high()] = true;
    const std::vector<Index> place =
        find_places({soup.positions, soup.triangles}, is_boundary, soup.ticker);
    for (EdgeSide& side : open) {
        side.ends = agvd::edge_key(place[side.low()], place[side.high()]);
    }
    open = sort_edge_sides(open, static_cast<Index>(soup.positions.size()), soup.ticker);

    agvd::UnionFind sets(soup.positions.size());
    Index num_merged = 0;
    for_each_edge(open, [&](std::span<const EdgeSide> edge) {
        soup.ticker.tick(edge.size());
        if (edge[0].low() == edge[0].high()) return;
        const auto end_at = [&](const EdgeSide& side, Index where) {
            const Index tail = soup.tail(side.half_edge);
            return place[tail] == where ? tail : soup.head(side.half_edge);
        };
        for (const EdgeSide& side : edge.subspan(1)) {
            for (const Index where : {side.low(), side.high()}) {
                num_merged += sets.unite(end_at(edge[0], where), end_at(side, where)) ? 1 : 0;
            }
        }
    });
    keep_welded_positions(sets, soup);
    return apply(sets, num_merged, soup);
}

bool collapse_zero_edges(Soup& soup) {
    agvd::UnionFind sets(soup.positions.size());
    Index num_merged = 0;
    for (Index h = 0; h < soup.num_half_edges(); ++h) {
        soup.ticker.tick();
        const Index a = soup.tail(h), b = soup.head(h);
        if (a == b || soup.positions[a] != soup.positions[b]) continue;
        num_merged += sets.unite(a, b) ? 1 : 0;
    }
    return apply(sets, num_merged, soup);
}

}  // namespace remesh::detail
