#include "remesh/relax/close_rim.h"

#include <algorithm>

namespace remesh::detail {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Triangle;

// Sites of a rim between two sites of a curve.
constexpr std::size_t longest_way = 8;

using DirectedEdges = std::vector<std::pair<Index, Index>>;

DirectedEdges directed_edges(std::span<const Triangle> triangles) {
    DirectedEdges edges;
    edges.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

// Those without a triangle on the other side.
DirectedEdges rim_edges(const DirectedEdges& edges) {
    DirectedEdges rim;
    for (const auto& [from, to] : edges) {
        if (!std::binary_search(edges.begin(), edges.end(), std::pair(to, from))) {
            rim.emplace_back(from, to);
        }
    }
    return rim;
}

// The site after another one on the rim; no_index if that is not one.
Index next_on(const DirectedEdges& rim, Index site) {
    const auto found = std::lower_bound(rim.begin(), rim.end(), std::pair(site, Index{0}));
    if (found == rim.end() || found->first != site) return no_index;
    const auto other = found + 1;
    return other != rim.end() && other->first == site ? no_index : found->second;
}

}  // namespace

Index close_rim(std::span<const ChainEdge> chain, std::vector<Triangle>& triangles) {
    const DirectedEdges edges = directed_edges(triangles);
    const DirectedEdges rim = rim_edges(edges);
    Index num_open = 0;
    for (const ChainEdge& edge : chain) {
        if (std::binary_search(rim.begin(), rim.end(), std::pair(edge.from, edge.to))) continue;
        std::vector<Index> way{edge.from};
        while (way.size() <= longest_way && way.back() != edge.to && way.back() != no_index) {
            way.push_back(next_on(rim, way.back()));
        }
        if (way.back() != edge.to || way.size() < 3) {
            ++num_open;
            continue;
        }
        for (std::size_t i = way.size() - 1; i > 1; --i) {
            triangles.push_back({edge.from, way[i], way[i - 1]});
        }
    }
    return num_open;
}

}  // namespace remesh::detail
