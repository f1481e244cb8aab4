#include "remesh/features/close_rim.h"

#include <algorithm>

namespace remesh {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Triangle;

// Sites of a rim between two sites of a curve.
constexpr std::size_t longest_way = 8;

// The site after another one on the rim; no_index if that is not one.
Index next_on(const std::vector<DirectedEdge>& rim, Index site) {
    const auto found = std::lower_bound(rim.begin(), rim.end(), DirectedEdge(site, 0));
    if (found == rim.end() || found->first != site) return no_index;
    const auto other = found + 1;
    return other != rim.end() && other->first == site ? no_index : found->second;
}

}  // namespace

std::vector<DirectedEdge> rim_of(std::span<const Triangle> triangles) {
    std::vector<DirectedEdge> edges, rim;
    edges.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
    }
    std::sort(edges.begin(), edges.end());
    for (const auto& [from, to] : edges) {
        const DirectedEdge back(to, from);
        if (!std::binary_search(edges.begin(), edges.end(), back)) rim.emplace_back(from, to);
    }
    return rim;
}

void close_rim(std::span<const DirectedEdge> chain, std::vector<Triangle>& triangles) {
    const std::vector<DirectedEdge> rim = rim_of(triangles);
    for (const auto& [from, to] : chain) {
        if (std::binary_search(rim.begin(), rim.end(), DirectedEdge(from, to))) continue;
        std::vector<Index> way{from};
        while (way.size() <= longest_way && way.back() != to && way.back() != no_index) {
            way.push_back(next_on(rim, way.back()));
        }
        if (way.back() != to) continue;
        for (std::size_t i = way.size() - 1; i > 1; --i) {
            triangles.push_back({from, way[i], way[i - 1]});
        }
    }
}

}  // namespace remesh
